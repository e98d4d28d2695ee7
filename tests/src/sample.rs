//! The sample scene that ships in `tests/data`: is its mesh the one made here, and is it answered rightly?
#![expect(clippy::unwrap_used, reason = "a test")]

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use glam::DVec3;
use rayproof::files::load;
use rayproof::scene::{Camera, FlatHit, Geometry, Kind, Ray};
use rayproof::{DeviceChoice, Intersector, Options};
use rayproof_oracle::families::meshes::open_edges;
use rayproof_oracle::{Oracle, judge::judge_closest};

/// Quads along the knot and across its tube.
const AROUND: u32 = 320;
const ACROSS: u32 = 20;

/// The folder of the workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn data(name: &str) -> PathBuf {
    root().join("tests/data").join(name)
}

/// A trefoil knot as OBJ text: a tube whose section has four lobes that wind around it six times.
///
/// Three decimals: a sine or cosine that is off by a rounding on another platform leaves the same text.
fn knot() -> String {
    let mut text = String::from("# A trefoil knot, made by tests/src/sample.rs.\n");
    for i in 0..AROUND {
        // The shares of a step keep all coordinates away from zero and from halves of the last decimal.
        let s = TAU * (f64::from(i) + 0.3) / f64::from(AROUND);
        let ((sin2, cos2), (sin3, cos3)) = ((2.0 * s).sin_cos(), (3.0 * s).sin_cos());
        // The curve lies on a torus: its tangent, the torus' normal, and the third of the frame.
        let out = 1.0 + 0.42 * cos3;
        let center = DVec3::new(out * cos2, out * sin2, 0.42 * sin3);
        let tangent =
            DVec3::new(-1.26 * sin3 * cos2 - 2.0 * out * sin2, -1.26 * sin3 * sin2 + 2.0 * out * cos2, 1.26 * cos3);
        let normal = DVec3::new(cos3 * cos2, cos3 * sin2, sin3);
        let side = tangent.normalize().cross(normal);
        for j in 0..ACROSS {
            let angle = TAU * (f64::from(j) + 0.2) / f64::from(ACROSS);
            let radius = 0.25 * (1.0 + 0.16 * (4.0 * angle + 6.0 * s).cos());
            let p = center + radius * (angle.cos() * normal + angle.sin() * side);
            // Stood up: its axis is y.
            writeln!(text, "v {:.3} {:.3} {:.3}", p.x, p.z, p.y).unwrap();
        }
    }
    let number = |i: u32, j: u32| (i % AROUND) * ACROSS + j % ACROSS + 1;
    for (i, j) in (0..AROUND).flat_map(|i| (0..ACROSS).map(move |j| (i, j))) {
        let quad = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        writeln!(text, "f {} {} {} {}", quad[0], quad[1], quad[2], quad[3]).unwrap();
    }
    text
}

#[test]
fn the_knot_is_the_one_made_here() {
    let made = knot();
    if fs::read_to_string(data("knot.obj")).ok().as_ref() != Some(&made) {
        let fresh = Path::new(env!("CARGO_TARGET_TMPDIR")).join("knot.obj");
        fs::write(&fresh, made).unwrap();
        panic!("tests/data/knot.obj is another mesh; the one made here is {}", fresh.display());
    }
    let loaded = load(&data("knot.obj")).unwrap();
    let [Geometry::Mesh(mesh)] = loaded.scene.geometries() else { panic!("not one mesh") };
    assert_eq!(mesh.triangles.len(), 2 * (AROUND * ACROSS) as usize);
    assert_eq!(open_edges(mesh), 0);
    let volume: f64 = (0..mesh.triangles.len())
        .map(|i| mesh.triangle(i))
        .map(|t| t.a.as_dvec3().dot(t.b.as_dvec3().cross(t.c.as_dvec3())) / 6.0)
        .sum();
    // A tube holds its section's area times the length of its curve (Pappus), 14.994 here; flat quads cut off some of
    // it, and the wrong winding turns the sign.
    let smooth = std::f64::consts::PI * 0.25_f64.powi(2) * (1.0 + 0.16_f64.powi(2) / 2.0) * 14.994;
    println!("the knot holds {volume:.3}, a smooth one {smooth:.3}");
    assert!((0.95..1.0).contains(&(volume / smooth)));
}

#[test]
fn the_sample_is_answered_rightly() {
    let sample = load(&data("sample.toml")).unwrap();
    let (scene, camera) = (sample.scene, sample.camera.unwrap());
    assert_eq!((scene.count(Kind::Triangle), scene.count(Kind::Sphere)), (12_800, 8));
    let rays = rays(&camera);
    let mut hits = vec![FlatHit::MISS; rays.len()];
    let options = Options { device: DeviceChoice::Cpu, ..Options::default() };
    Intersector::new(&scene, &options).unwrap().closest_flat(&rays, &mut hits).unwrap();

    let oracle = Oracle::new(&scene);
    let mut seen = vec![0_usize; scene.count(Kind::Sphere) + 1];
    for (ray, hit) in rays.iter().zip(&hits) {
        let verdict = judge_closest(&oracle, ray, hit);
        assert!(verdict.is_nearest(), "{verdict}");
        if hit.is_hit() {
            let (geometry, primitive) = scene.locate(hit.primitive as usize);
            seen[if geometry == 0 { 0 } else { 1 + primitive }] += 1;
        }
    }
    let misses = rays.len() - seen.iter().sum::<usize>();
    println!("{} rays: {misses} miss, {} hit the knot, {:?} the spheres", rays.len(), seen[0], &seen[1..]);
    assert!(misses > 0 && seen.iter().all(|&rays| rays > 0), "the camera does not see everything");
}

fn rays(camera: &Camera) -> Vec<Ray> {
    camera.rays(80, 60, 0..60).collect()
}
