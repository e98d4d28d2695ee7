#![expect(clippy::unwrap_used, reason = "tests")]
#![expect(clippy::print_stdout, reason = "seeds and measured ratios are part of what a test says")]

mod bits;
mod count;
mod damage;
mod exact;
mod fast;
mod filter;
mod promise;
mod roots;

use glam::Vec3;
use rayproof_scene::{Geometry, Mesh, Ray, Scene, Sphere, Triangle, random};

/// The workspace's random numbers, and what these tests draw of them.
struct Random(random::Random);

impl Random {
    /// Prints the seed, so that a failing run can be told from its output.
    fn new(seed: u64) -> Self {
        println!("seed {seed:#x}");
        Self(random::Random::from_state(seed))
    }

    /// Below `n`.
    #[expect(clippy::cast_possible_truncation, reason = "the remainder of a u32")]
    fn below(&mut self, n: u32) -> u32 {
        self.0.below(u64::from(n)) as u32
    }

    /// Uniform in `[low, high)`.
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]
    fn uniform(&mut self, low: f32, high: f32) -> f32 {
        (f64::from(low) + self.0.unit() * (f64::from(high) - f64::from(low))) as f32
    }

    /// Log-uniform between powers of ten.
    fn scale(&mut self, low: f32, high: f32) -> f32 {
        10.0_f32.powf(self.uniform(low, high))
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::from_array([(); 3].map(|()| self.uniform(-1.0, 1.0)))
    }

    /// Small integers: products are exact, and ties happen.
    fn lattice(&mut self, n: u32) -> Vec3 {
        Vec3::from_array([(); 3].map(|()| self.below(2 * n + 1) as f32 - n as f32))
    }
}

fn mesh(triangles: &[Triangle]) -> Geometry {
    let vertices = triangles.iter().flat_map(|t| [t.a, t.b, t.c]).collect();
    let triangles = (0..u32::try_from(triangles.len()).unwrap()).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Geometry::Mesh(Mesh { vertices, triangles })
}

fn triangle_scene(triangles: &[Triangle]) -> Scene {
    Scene::new(vec![mesh(triangles)]).expect("a valid scene")
}

fn sphere_scene(spheres: &[Sphere]) -> Scene {
    Scene::new(vec![Geometry::Spheres(spheres.to_vec())]).expect("a valid scene")
}

/// A triangle and a ray aimed at it: at its inside, an edge, a vertex or past it; of any size, shape and distance.
fn hard_triangle(random: &mut Random) -> (Triangle, Ray) {
    if random.below(4) == 0 {
        let [a, b, c, e, d] = [(); 5].map(|()| random.lattice(3));
        return (Triangle { a, b, c }, ranged(random, Ray::new(e, if d == Vec3::ZERO { Vec3::X } else { d })));
    }
    let (size, offset) = (random.scale(-6.0, 6.0), random.scale(-3.0, 3.0));
    let center = random.vector() * size * offset;
    let [a, b, c] = [(); 3].map(|()| center + random.vector() * size);
    // A needle one time in four.
    let c = if random.below(4) == 0 {
        a.lerp(b, random.uniform(0.0, 1.0)) + random.vector() * size * random.scale(-7.0, -2.0)
    } else {
        c
    };
    let triangle = Triangle { a, b, c };
    let (u, v) = match random.below(4) {
        0 => (0.0, 0.0),
        1 => (random.uniform(0.0, 1.0), 0.0),
        2 => (random.uniform(0.0, 0.5), random.uniform(0.0, 0.5)),
        _ => (random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2)),
    };
    let e = center + random.vector() * size * random.scale(-2.0, 5.0);
    let mut d = (triangle.point(u, v) - e) * random.scale(-6.0, 6.0);
    if random.below(8) == 0 {
        // In the triangle's plane, up to rounding.
        d = b - a;
    }
    let d = if d == Vec3::ZERO { Vec3::X } else { d };
    (triangle, ranged(random, Ray::new(e, d)))
}

/// A sphere and a ray aimed at its inside, its silhouette or past it; of any size and distance.
fn hard_sphere(random: &mut Random) -> (Sphere, Ray) {
    if random.below(4) == 0 {
        let (center, e, d) = (random.lattice(3), random.lattice(5), random.lattice(2));
        let radius = random.below(5) as f32;
        return (Sphere { center, radius }, ranged(random, Ray::new(e, if d == Vec3::ZERO { Vec3::X } else { d })));
    }
    let radius = random.scale(-6.0, 6.0);
    let center = random.vector() * radius * random.scale(-3.0, 3.0);
    let distance = match random.below(3) {
        0 => 1.0 + random.scale(-7.0, 0.0) * random.uniform(-1.0, 1.0),
        1 => random.uniform(0.0, 1.0),
        _ => random.scale(0.0, 5.0),
    };
    let e = center + random.vector().normalize() * radius * distance;
    let impact = match random.below(3) {
        0 => 1.0 + random.scale(-8.0, -1.0) * random.uniform(-1.0, 1.0),
        1 => random.uniform(0.0, 1.0),
        _ => random.uniform(0.0, 2.0),
    };
    let to_center = (center - e).try_normalize().unwrap_or(Vec3::X);
    let side = to_center.any_orthonormal_vector();
    let sine = (impact / distance).clamp(-1.0, 1.0);
    let d = to_center * (1.0 - sine * sine).max(0.0).sqrt() + side * sine;
    let d = d * random.scale(-6.0, 6.0);
    (Sphere { center, radius }, ranged(random, Ray::new(e, if d == Vec3::ZERO { Vec3::X } else { d })))
}

/// The ray with a finite range, half of the times.
fn ranged(random: &mut Random, ray: Ray) -> Ray {
    match random.below(6) {
        0 => Ray { t_min: f32::NEG_INFINITY, ..ray },
        1 => Ray { t_min: -1.0, t_max: 1.0, ..ray },
        2 => Ray { t_max: random.scale(-6.0, 6.0), ..ray },
        _ => ray,
    }
}
