use std::cmp::Ordering;

use dashu_ratio::RBig;
use rayon::prelude::*;
use rayproof_scene::{FlatHit, Geometry, Mesh, Primitive, Ray, Scene};

use crate::{
    filter::Filter,
    rational::Line,
    root::Root,
    sphere::Roots,
    triangle::{PlanePoint, crosses},
};

/// Where a ray meets a primitive, exactly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactHit {
    /// The parameter on the ray, in multiples of its direction.
    pub t: Root,
    /// The weight of the triangle's second vertex; 0 on a sphere.
    pub u: RBig,
    /// The weight of the triangle's third vertex; 0 on a sphere.
    pub v: RBig,
    /// The flat number of the primitive.
    pub primitive: u32,
}

impl ExactHit {
    /// This hit with `t`, `u`, `v` rounded to the nearest `f32`: what the precision `exact` promises, bit for bit.
    #[must_use]
    pub fn to_hit(&self) -> FlatHit {
        let weight = |x: &RBig| Root::from(x.clone()).to_f32();
        FlatHit { t: self.t.to_f32(), u: weight(&self.u), v: weight(&self.v), primitive: self.primitive }
    }

    /// By exact `t`, then by primitive: the order in which hits are closest.
    fn order(&self, other: &Self) -> Ordering {
        self.t.cmp(&other.t).then(self.primitive.cmp(&other.primitive))
    }
}

/// The exact answer to any ray, by brute force over all primitives of a scene in rational arithmetic.
///
/// A ray with a [fault](Ray::fault) hits nothing.
#[derive(Clone, Copy, Debug)]
pub struct Oracle<'s> {
    scene: &'s Scene,
    /// Whether certain misses are rejected in `f64` first. Changes no answer.
    filter: bool,
}

impl<'s> Oracle<'s> {
    /// The oracle of a scene.
    ///
    /// # Panics
    /// When a vertex or a sphere is not finite, or a radius is negative; loaders reject such scenes.
    #[must_use]
    pub fn new(scene: &'s Scene) -> Self {
        let sound = |geometry: &Geometry| match geometry {
            Geometry::Mesh(mesh) => mesh.vertices.iter().all(|v| v.is_finite()),
            Geometry::Spheres(spheres) => {
                spheres.iter().all(|s| s.center.is_finite() && s.radius.is_finite() && s.radius >= 0.0)
            }
        };
        assert!(scene.geometries().iter().all(sound), "a vertex or a sphere that is not a point or a sphere");
        Self { scene, filter: true }
    }

    /// This oracle with every primitive decided in rational arithmetic. Slow; to check the filter.
    #[must_use]
    pub fn without_filter(self) -> Self {
        Self { filter: false, ..self }
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &'s Scene {
        self.scene
    }

    /// The closest hit: the smallest exact `t` in range, and among equal ones the lowest primitive.
    #[must_use]
    pub fn closest(&self, ray: &Ray) -> Option<ExactHit> {
        let mut closest: Option<ExactHit> = None;
        self.each_hit(ray, |hit| {
            if closest.as_ref().is_none_or(|old| hit.order(old) == Ordering::Less) {
                closest = Some(hit);
            }
        });
        closest
    }

    /// The closest hit as an engine writes it: its numbers rounded to the nearest, or [`FlatHit::MISS`].
    #[must_use]
    pub fn hit(&self, ray: &Ray) -> FlatHit {
        self.closest(ray).map_or(FlatHit::MISS, |hit| hit.to_hit())
    }

    /// Whether the ray hits anything.
    #[must_use]
    pub fn any(&self, ray: &Ray) -> bool {
        self.closest(ray).is_some()
    }

    /// Every hit, closest first. A tangent point of a sphere is one of them.
    #[must_use]
    pub fn all(&self, ray: &Ray) -> Vec<ExactHit> {
        let mut hits = Vec::new();
        self.each_hit(ray, |hit| hits.push(hit));
        hits.sort_by(ExactHit::order);
        hits
    }

    /// How many times the ray crosses the surface in range: shared edges and vertices once, by the tie rule of the
    /// module `triangle`; a sphere's tangent twice.
    #[must_use]
    pub fn count(&self, ray: &Ray) -> u32 {
        let mut count = 0;
        self.each_candidate(ray, |line, _, primitive| match primitive {
            Primitive::Triangle(triangle) => {
                let crossed =
                    crosses(line, &triangle) && PlanePoint::new(line, &triangle).is_some_and(|p| holds(ray, &p.t()));
                count += u32::from(crossed);
            }
            Primitive::Sphere(sphere) => match Roots::new(line, &sphere) {
                Roots::None => {}
                Roots::Double(t) => count += 2 * u32::from(holds(ray, &t)),
                Roots::Two(roots) => count += roots.iter().map(|t| u32::from(holds(ray, t))).sum::<u32>(),
            },
        });
        count
    }

    /// One of the queries for many rays at once, on all cores, in the order of the rays.
    ///
    /// ```
    /// # use rayproof_oracle::Oracle;
    /// # use rayproof_scene::{Geometry, Ray, Scene, Sphere};
    /// # use glam::Vec3;
    /// let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])]).expect("a valid scene");
    /// let rays = [Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z), Ray::new(Vec3::ZERO, Vec3::X)];
    /// assert_eq!(Oracle::new(&scene).batch(&rays, Oracle::count), [2, 1]);
    /// ```
    pub fn batch<T: Send>(&self, rays: &[Ray], query: impl Fn(&Self, &Ray) -> T + Sync) -> Vec<T> {
        rays.par_iter().map(|ray| query(self, ray)).collect()
    }

    /// Calls `found` with every hit, in no order.
    fn each_hit(&self, ray: &Ray, mut found: impl FnMut(ExactHit)) {
        self.each_candidate(ray, |line, flat, primitive| match primitive {
            Primitive::Triangle(triangle) => {
                let Some(point) = PlanePoint::new(line, &triangle).filter(PlanePoint::is_inside) else { return };
                let t = point.t();
                if holds(ray, &t) {
                    let [u, v] = point.uv();
                    found(ExactHit { t, u, v, primitive: flat });
                }
            }
            Primitive::Sphere(sphere) => {
                let roots = match Roots::new(line, &sphere) {
                    Roots::None => vec![],
                    Roots::Double(t) => vec![t],
                    Roots::Two(roots) => roots.into(),
                };
                for t in roots.into_iter().filter(|t| holds(ray, t)) {
                    found(ExactHit { t, u: RBig::ZERO, v: RBig::ZERO, primitive: flat });
                }
            }
        });
    }

    /// Calls `found` with the flat number of every primitive that the line does not surely miss.
    fn each_candidate(&self, ray: &Ray, mut found: impl FnMut(&Line, u32, Primitive)) {
        if ray.fault().is_some() {
            return;
        }
        let (line, filter) = (Line::new(ray), self.filter.then(|| Filter::new(ray)));
        for (index, geometry) in self.scene.geometries().iter().enumerate() {
            let start = self.scene.start(index);
            let flat = |i: usize| u32::try_from(start + i).expect("brute force asks no 2^32 primitives");
            match geometry {
                Geometry::Mesh(mesh) => {
                    for i in mesh_candidates(mesh, filter.as_ref()) {
                        found(&line, flat(i), Primitive::Triangle(mesh.triangle(i)));
                    }
                }
                Geometry::Spheres(spheres) => {
                    for (i, sphere) in spheres.iter().enumerate() {
                        if !filter.as_ref().is_some_and(|f| f.misses_sphere(sphere)) {
                            found(&line, flat(i), Primitive::Sphere(*sphere));
                        }
                    }
                }
            }
        }
    }
}

/// The triangles that the line does not surely miss.
fn mesh_candidates(mesh: &Mesh, filter: Option<&Filter>) -> Vec<usize> {
    let Some(filter) = filter else { return (0..mesh.triangles.len()).collect() };
    let codes: Vec<u8> = mesh.vertices.iter().map(|&v| filter.outcode(v)).collect();
    let apart = |[a, b, c]: [u32; 3]| codes[a as usize] & codes[b as usize] & codes[c as usize] != 0;
    let near = mesh.triangles.iter().enumerate().filter(|&(_, &corners)| !apart(corners)).map(|(i, _)| i);
    near.filter(|&i| !filter.misses_triangle(&mesh.triangle(i))).collect()
}

/// Whether the ray's range holds `t`, its ends included.
fn holds(ray: &Ray, t: &Root) -> bool {
    cmp_end(t, ray.t_min) != Ordering::Less && cmp_end(t, ray.t_max) != Ordering::Greater
}

/// How `t` compares with an end of a range.
pub(crate) fn cmp_end(t: &Root, end: f32) -> Ordering {
    // An infinite end has no rational; it holds every `t` on one side and none on the other.
    match RBig::try_from(end) {
        Ok(end) => t.cmp_rational(&end),
        Err(_) if end > 0.0 => Ordering::Less,
        Err(_) => Ordering::Greater,
    }
}
