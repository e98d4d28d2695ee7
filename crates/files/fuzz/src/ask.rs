//! The second stage: a tree of what was read, rays of every kind through it, and `exact` against itself without a tree.

use rayproof::scene::{Geometry, Hit, Mesh, Ray, Scene};
use rayproof::{DeviceChoice, Intersector, Options, Precision};

/// Rays a scene is asked.
const RAYS: usize = 24;
/// Beyond so many primitives each is not asked by itself.
const FEW: usize = 12;
/// Beyond so many nothing is asked: building is measured elsewhere.
const MANY: usize = 20_000;

/// Asks every question in every precision; `bytes` tell which rays.
pub(crate) fn all(scene: &Scene, bytes: &[u8]) {
    let primitives: usize = scene.geometries().iter().map(Geometry::len).sum();
    if primitives > MANY {
        return;
    }
    let rays = rays(scene, bytes);
    for precision in Precision::ALL {
        let engine = engine(scene, precision);
        let (mut hits, mut any, mut counts) = ([Hit::MISS; RAYS], [0; RAYS], [0; RAYS]);
        engine.closest(&rays, &mut hits).expect("closest");
        engine.any(&rays, &mut any).expect("any");
        for ((ray, hit), any) in rays.iter().zip(&hits).zip(any) {
            if hit.is_hit() {
                assert!(!hit.t.is_nan() && !hit.u.is_nan() && !hit.v.is_nan(), "{precision:?}: {ray:?}: {hit:?}");
            }
            if precision == Precision::Exact {
                assert_eq!(any != 0, hit.is_hit(), "{ray:?}: any and closest");
            }
        }
        if precision == Precision::Exact {
            engine.count(&rays, &mut counts).expect("count");
            if primitives <= FEW {
                one_by_one(scene, &rays, &hits, &any);
            }
        }
    }
}

/// Asks each primitive by itself, where there is no tree to be wrong.
fn one_by_one(scene: &Scene, rays: &[Ray; RAYS], hits: &[Hit; RAYS], any: &[u8; RAYS]) {
    let mut alone = [(); RAYS].map(|()| Vec::new());
    for (geometry, part) in scene.geometries().iter().enumerate() {
        for primitive in 0..part.len() {
            let one = match part {
                Geometry::Mesh(Mesh { vertices, triangles }) => {
                    let corners = triangles[primitive].map(|corner| vertices[corner as usize]);
                    Geometry::Mesh(Mesh::new(corners, vec![[0, 1, 2]]))
                }
                Geometry::Spheres(spheres) => Geometry::Spheres(vec![spheres[primitive]]),
            };
            let mut found = [Hit::MISS; RAYS];
            engine(&Scene::new(vec![one]).expect("a scene"), Precision::Exact).closest(rays, &mut found).expect("closest");
            for (list, hit) in alone.iter_mut().zip(found).filter(|(_, hit)| hit.is_hit()) {
                list.push((hit.t, geometry, primitive));
            }
        }
    }
    for (((ray, hit), any), alone) in rays.iter().zip(hits).zip(any).zip(alone) {
        assert_eq!(*any != 0, !alone.is_empty(), "{ray:?}: any, and {alone:?}");
        let first = alone.iter().map(|&(t, ..)| t).min_by(f32::total_cmp);
        // Among equal t the exact ones decide, which are not seen here.
        let is_one = alone.iter().any(|&(t, geometry, primitive)| {
            (t, geometry, primitive) == (hit.t, hit.geometry as usize, hit.primitive as usize)
        });
        assert!(hit.is_hit() == is_one && first.is_none_or(|t| t == hit.t), "{ray:?}: {hit:?}, and {alone:?}");
    }
}

fn engine(scene: &Scene, precision: Precision) -> Intersector {
    let options = Options { precision, device: DeviceChoice::Cpu, ..Options::default() };
    Intersector::new(scene, &options).expect("the CPU engine")
}

/// Rays at and around the scene, with ranges of every sign and size.
fn rays(scene: &Scene, bytes: &[u8]) -> [Ray; RAYS] {
    let mut random = Random(bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    }));
    let points: Vec<_> = scene
        .geometries()
        .iter()
        .flat_map(|geometry| match geometry {
            Geometry::Mesh(mesh) => mesh.vertices.iter().copied().take(64).collect::<Vec<_>>(),
            Geometry::Spheres(spheres) => spheres.iter().map(|sphere| sphere.center).take(64).collect(),
        })
        .collect();
    [(); RAYS].map(|()| loop {
        let mut point = || {
            let by = [random.number(), random.number(), random.number()];
            let scale = [0.0, 1.0, 1e-3, 1e6, 1e30, 1e-38][random.below(6)];
            let at = points.get(random.below(points.len().max(1))).copied().unwrap_or_default();
            at + rayproof::glam::Vec3::from(by) * scale
        };
        let (origin, target) = (point(), point());
        let direction = match random.below(4) {
            0 => rayproof::glam::Vec3::AXES[random.below(3)] * random.number(),
            1 => target,
            _ => target - origin,
        };
        let ends = [f32::NEG_INFINITY, f32::MIN, -1e5, -1.0, -0.0, 0.0, 1e-40, 1.0, 1e5, f32::MAX, f32::INFINITY];
        let (t_min, t_max) = match random.below(3) {
            0 => (0.0, f32::INFINITY),
            _ => (ends[random.below(ends.len())], ends[random.below(ends.len())]),
        };
        let ray = Ray { origin, t_min, direction, t_max };
        if ray.fault().is_none() {
            return ray;
        }
    })
}

struct Random(u64);

impl Random {
    /// The next of a xorshift sequence.
    fn next(&mut self) -> u64 {
        self.0 = self.0.max(1);
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() >> 33) as usize % end
    }

    /// From -2 to 2, in quarters half of the time.
    fn number(&mut self) -> f32 {
        let fine = (self.next() >> 40) as f32 / (1 << 22) as f32 - 2.0;
        if self.below(2) == 0 { (fine * 4.0).round() / 4.0 } else { fine }
    }
}
