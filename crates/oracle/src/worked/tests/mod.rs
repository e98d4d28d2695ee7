#![expect(clippy::unwrap_used, reason = "tests")]
#![expect(clippy::print_stdout, reason = "each comparison says how much it compared")]

mod values;

use dashu_ratio::RBig;
use glam::Vec3;
use rayproof_scene::{FlatHit, Geometry, Mesh, Primitive, Ray, Scene, Sphere, Triangle};

use super::{COLUMNS, Conclusion, Value, Worked, work};
use crate::{Oracle, Root, families};

fn sphere(center: [f32; 3], radius: f32) -> Primitive {
    Primitive::Sphere(Sphere { center: center.into(), radius })
}

fn triangle(corners: [[f32; 3]; 3]) -> Primitive {
    let [a, b, c] = corners.map(Vec3::from);
    Primitive::Triangle(Triangle { a, b, c })
}

fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray::new(origin, direction)
}

fn values<'w>(worked: &'w Worked, name: &str) -> &'w [Value; 5] {
    &worked.rows.iter().find(|row| row.name == name).unwrap().values
}

/// The rows of these names hold these numbers, the same in every precision that has them; of the exact one there is one.
fn holds(worked: &Worked, expected: &[(&str, f64)]) {
    for &(name, number) in expected {
        let right = Value::Exact(RBig::try_from(number).unwrap().into());
        let row = values(worked, name);
        assert_eq!(row[4], right, "{name}");
        for (value, precision) in row.iter().zip(COLUMNS).filter(|(value, _)| **value != Value::Absent) {
            assert_eq!(value.decimal(30), right.decimal(30), "{name} by {}", precision.name());
        }
    }
}

/// What each precision concludes, in words: the reason of a miss, or `t u v` to five digits.
fn conclusions(worked: &Worked) -> [String; 5] {
    worked.answers.each_ref().map(|answer| match answer {
        Conclusion::Absent => "absent".to_owned(),
        Conclusion::Miss(why) => (*why).to_owned(),
        Conclusion::Hit { t, u, v } => [t, u, v].map(|x| x.decimal(5)).join(" "),
    })
}

#[test]
fn a_sphere_is_worked_out_as_by_hand() {
    let worked = work(&ray([3.0, 0.0, -10.0], [0.0, 0.0, 2.0]), &sphere([0.0; 3], 5.0));
    let o = [("o.x", 3.0), ("o.y", 0.0), ("o.z", -10.0), ("l.x", 3.0), ("l.y", 0.0), ("l.z", 0.0)];
    let rest = [("A", 4.0), ("B", -40.0), ("C", 84.0), ("r^2 - l.l", 16.0), ("D", 256.0)];
    holds(&worked, &o);
    holds(&worked, &rest);
    holds(&worked, &[("q", 28.0), ("t1", 7.0), ("t2", 3.0)]);
    assert_eq!(conclusions(&worked), ["3.0000e0 0 0"; 5]);
    assert!(worked.systems.is_none());
    let absent = |name: &str| values(&worked, name).each_ref().map(|value| *value == Value::Absent);
    assert_eq!(absent("l.x"), [true, true, false, false, false]);
    assert_eq!(absent("q"), [true, false, false, false, false]);
    assert!(matches!(values(&worked, "t1"), [Value::F32(_), Value::F32(_), Value::F32(_), Value::F64(_), _]));

    // From behind, B > 0 and t1 is the far one backwards; B = 0 counts as positive.
    let behind = work(&ray([3.0, 0.0, 10.0], [0.0, 0.0, 2.0]), &sphere([0.0; 3], 5.0));
    holds(&behind, &[("B", 40.0), ("q", -28.0), ("t1", -7.0), ("t2", -3.0)]);
    assert_eq!(conclusions(&behind), ["t < t_min"; 5]);
    let beside = work(&ray([3.0, 0.0, 0.0], [0.0, 0.0, 2.0]), &sphere([0.0; 3], 5.0));
    holds(&beside, &[("B", 0.0), ("q", -8.0), ("t1", -2.0), ("t2", 2.0)]);
    assert_eq!(conclusions(&beside), ["2.0000e0 0 0"; 5]);
}

#[test]
fn irrational_roots_are_exact() {
    // t = 2 -+ sqrt(1/2), q = 2 + sqrt(1/2).
    let worked = work(&ray([0.5, 0.5, -2.0], [0.0, 0.0, 1.0]), &sphere([0.0; 3], 1.0));
    let digits = |name: &str| values(&worked, name)[4].decimal(20);
    assert_eq!(digits("q"), "2.7071067811865475244e0");
    assert_eq!(digits("t1"), "2.7071067811865475244e0");
    assert_eq!(digits("t2"), "1.2928932188134524756e0");
    let Conclusion::Hit { t: Value::F32(t), .. } = worked.answers[3] else { panic!("a hit in f32") };
    assert_eq!(t, 1.292_893_2, "rounded to f32");
}

#[test]
fn a_tangent_is_one_root() {
    let worked = work(&ray([5.0, 0.0, -10.0], [0.0, 0.0, 2.0]), &sphere([0.0; 3], 5.0));
    holds(&worked, &[("D", 0.0), ("q", 20.0), ("t1", 5.0), ("t2", 5.0)]);
    assert_eq!(conclusions(&worked), ["5.0000e0 0 0"; 5]);
    // A double root at zero: q = 0.
    let at = work(&ray([5.0, 0.0, 0.0], [0.0, 0.0, 2.0]), &sphere([0.0; 3], 5.0));
    holds(&at, &[("B", 0.0), ("C", 0.0), ("D", 0.0), ("q", 0.0), ("t1", 0.0), ("t2", 0.0)]);
    assert_eq!(conclusions(&at), ["0 0 0"; 5]);
}

#[test]
fn a_far_sphere_costs_the_textbook_its_digits() {
    // The way to the centre is 1e6 long and not along an axis, so every product rounds.
    let target = Vec3::new(0.3, -0.2, 0.1);
    let origin = Vec3::new(6e5, 0.0, 8e5);
    let worked = work(&Ray::new(origin, (target - origin) * 0.7), &sphere([0.0; 3], 1.0));
    let d = values(&worked, "D");
    let same = d.each_ref().map(|value| value.same_digits(&d[4], 12));
    println!("digits of D that are right: {same:?} of {:?}", d.each_ref().map(|value| value.decimal(12)));
    assert!(same[0] < same[2] && same[2] < same[3] && same[3] < same[4], "{same:?}");
    assert_eq!(same[0], 0, "not a digit is left");
    let errors = values(&worked, "t2").each_ref().map(|t| t.ulps_from(&values(&worked, "t2")[4]));
    println!("ULP of t2: {errors:?}");
    let [Conclusion::Hit { t: Value::F32(t), .. }, Conclusion::Hit { t: exact, .. }] = &worked.answers[3..] else {
        panic!("hits")
    };
    assert_eq!(Value::F32(*t).ulps_from(exact).map(|error| error <= 0.5), Some(true));
}

#[test]
fn a_triangle_is_worked_out_as_by_hand() {
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    // From above det > 0, from below det < 0.
    for sign in [1.0, -1.0] {
        let from = [1.0, 2.0, 8.0 * sign];
        let worked = work(&ray(from, [0.0, 0.0, -2.0 * sign]), &triangle(corners));
        let s = f64::from(sign);
        holds(&worked, &[("det", 32.0 * s), ("det u", 8.0 * s), ("det v", 16.0 * s), ("det t", 128.0 * s)]);
        holds(&worked, &[("u", 0.25), ("v", 0.5), ("t", 4.0)]);
        let hit = "4.0000e0 2.5000e-1 5.0000e-1";
        assert_eq!(conclusions(&worked), ["absent", hit, hit, hit, hit]);
        let expected = [[4.0, 0.0, 0.0, 1.0], [0.0, 4.0, 0.0, 2.0], [0.0, 0.0, 2.0 * s, 8.0 * s]];
        for (system, precision) in worked.systems.as_ref().unwrap().iter().zip(COLUMNS).skip(1) {
            let shown = system.each_ref().map(|row| row.each_ref().map(|x| x.decimal(9)));
            assert_eq!(shown, expected.map(|row| row.map(|x| Value::F64(x).decimal(9))), "{}", precision.name());
        }
        let [absent, ..] = worked.systems.as_ref().unwrap();
        assert!(absent.iter().flatten().all(|x| *x == Value::Absent));
    }
}

#[test]
fn a_miss_says_why() {
    let ball = sphere([0.0; 3], 5.0);
    let along = ray([3.0, 0.0, -10.0], [0.0, 0.0, 2.0]);
    let range = |t_min, t_max| Ray { t_min, t_max, ..along };
    assert_eq!(conclusions(&work(&ray([6.0, 0.0, -10.0], [0.0, 0.0, 2.0]), &ball)), ["D < 0"; 5]);
    assert_eq!(conclusions(&work(&range(8.0, 9.0), &ball)), ["t < t_min"; 5]);
    assert_eq!(conclusions(&work(&range(0.0, 2.5), &ball)), ["t > t_max"; 5]);
    assert_eq!(conclusions(&work(&range(4.0, 6.0), &ball)), ["one t < t_min, the other > t_max"; 5]);
    // Both ends are in range.
    assert_eq!(conclusions(&work(&range(3.0, 3.0), &ball)), ["3.0000e0 0 0"; 5]);
    assert_eq!(conclusions(&work(&range(7.0, 7.0), &ball)), ["7.0000e0 0 0"; 5]);

    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let down = |x, y| work(&ray([x, y, 8.0], [0.0, 0.0, -2.0]), &triangle(corners));
    let reasons = |classic, other| ["absent", classic, other, other, other];
    assert_eq!(conclusions(&down(-1.0, 1.0)), reasons("u < 0", "u < 0"));
    assert_eq!(conclusions(&down(1.0, -1.0)), reasons("v < 0", "v < 0"));
    assert_eq!(conclusions(&down(1.0, 5.0)), reasons("v > 1", "u + v > 1"));
    assert_eq!(conclusions(&down(3.0, 2.0)), reasons("u > 1 - v", "u + v > 1"));
    let flat = work(&ray([1.0, 1.0, 0.0], [1.0, 0.0, 0.0]), &triangle(corners));
    assert_eq!(conclusions(&flat), reasons("det = 0", "det = 0"));
    assert_eq!(values(&flat, "t"), &[const { Value::Absent }; 5]);
    let short = Ray { t_max: 3.5, ..ray([1.0, 2.0, 8.0], [0.0, 0.0, -2.0]) };
    assert_eq!(conclusions(&work(&short, &triangle(corners))), reasons("t > t_max", "t > t_max"));
}

#[test]
fn what_is_not_valid_has_no_exact_column() {
    let nan = work(&ray([f32::NAN, 0.0, 0.0], [0.0, 0.0, 1.0]), &sphere([0.0; 3], 1.0));
    let why = "D is not a number";
    assert_eq!(conclusions(&nan), [why, why, why, why, "the ray or the primitive is not valid"]);
    let infinite = work(&ray([0.0; 3], [0.0, 0.0, 1.0]), &triangle([[f32::INFINITY; 3], [0.0; 3], [1.0; 3]]));
    assert_eq!(conclusions(&infinite)[4], "the ray or the primitive is not valid");
    assert!(infinite.rows.iter().all(|row| row.values[4] == Value::Absent));
    // Valid, but A underflows in f32.
    let short = work(&ray([0.0; 3], [0.0, 0.0, 1e-30]), &sphere([0.0; 3], 1.0));
    assert_eq!(conclusions(&short), ["A = 0", "A = 0", why, "1.0000e30 0 0", "1.0000e30 0 0"]);
}

/// A scene of the primitive alone.
fn alone(primitive: &Primitive) -> Scene {
    Scene::new(vec![match *primitive {
        Primitive::Sphere(sphere) => Geometry::Spheres(vec![sphere]),
        Primitive::Triangle(Triangle { a, b, c }) => {
            Geometry::Mesh(Mesh { vertices: vec![a, b, c], triangles: vec![[0, 1, 2]] })
        }
    }])
    .expect("a valid scene")
}

#[test]
fn the_exact_column_is_the_oracles_over_all_families() {
    let rational = |value: &Value| match value {
        Value::Exact(x) => x.parts().0.clone(),
        other => panic!("{other:?} is not exact"),
    };
    let (mut rays, mut hits) = (0, 0);
    for family in families::all() {
        for case in family.cases(20_261_125, 200) {
            let whole = Oracle::new(&case.scene);
            for (i, ray) in case.rays.iter().enumerate().filter(|_| !case.scene.is_empty()) {
                let nearest = whole.closest(ray).map(|hit| hit.primitive as usize);
                let primitive = case.scene.primitive(nearest.unwrap_or(i % case.scene.len()));
                let worked = work(ray, &primitive);
                let expected = Oracle::new(&alone(&primitive)).closest(ray);
                let what = || format!("family {} ({}): {ray:?} {primitive:?}", family.number, family.name);
                match (&worked.answers[4], expected) {
                    (Conclusion::Miss(_), None) => {}
                    (Conclusion::Hit { t, u, v }, Some(hit)) => {
                        let [t, u, v] = [t, u, v].map(|x| if let Value::Exact(x) = x { x.clone() } else { panic!() });
                        assert_eq!((&t, &u, &v), (&hit.t, &Root::from(hit.u.clone()), &Root::from(hit.v.clone())));
                        let rounded = FlatHit { t: t.to_f32(), u: u.to_f32(), v: v.to_f32(), primitive: 0 };
                        assert!(rounded.same_bits(&hit.to_hit()), "{}", what());
                        hits += 1;
                    }
                    (answer, expected) => panic!("{answer:?}, not {expected:?}: {}", what()),
                }
                if matches!(primitive, Primitive::Sphere(_)) {
                    let [a, rest, d] = ["A", "r^2 - l.l", "D"].map(|name| rational(&values(&worked, name)[4]));
                    assert_eq!(d, RBig::from(4) * a * rest, "{}", what());
                }
                rays += 1;
            }
        }
    }
    println!("{rays} rays, {hits} hits, 0 differ");
    assert!(rays > 8_000 && hits > 3_000);
}
