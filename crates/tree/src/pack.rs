use std::ops::BitOr as _;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use rayproof_scene::{Geometry, Kind, Mesh, Scene, Sphere};

use crate::Scaling;

/// A triangle by value, with its flat number. 48 bytes, as on the device.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PackedTriangle {
    /// The first vertex.
    pub a: Vec3,
    /// The flat number.
    pub id: u32,
    /// The second vertex.
    pub b: Vec3,
    /// The largest component of `b - a` and `c - a` in magnitude, rounded up.
    pub edge: f32,
    /// The third vertex.
    pub c: Vec3,
    /// Zero: it fills the record to three times 16 bytes.
    pub pad: u32,
}

impl PackedTriangle {
    fn new([a, b, c]: [Vec3; 3], id: u32) -> Self {
        let size = |v: Vec3| (v.as_dvec3() - a.as_dvec3()).abs().max_element();
        #[expect(clippy::cast_possible_truncation, reason = "rounded, then one step up")]
        let edge = (size(b).max(size(c)) as f32).next_up().min(f32::MAX);
        Self { a, id, b, edge, c, pad: 0 }
    }
}

/// The primitives as they were, in the order of the packed ones, where scaling cost a bit.
#[derive(Clone, Debug, Default)]
pub struct Originals {
    /// The corners of each triangle.
    pub triangles: Vec<[Vec3; 3]>,
    /// The spheres.
    pub spheres: Vec<Sphere>,
}

/// The primitives of a scene, scaled, in the order of their flat numbers, kind by kind.
pub(crate) struct Packed {
    pub(crate) triangles: Vec<PackedTriangle>,
    pub(crate) spheres: Vec<Sphere>,
    pub(crate) sphere_ids: Vec<u32>,
    pub(crate) scale_exponent: i32,
    pub(crate) size: f32,
    pub(crate) plain: bool,
    pub(crate) roomy: bool,
    pub(crate) originals: Option<Originals>,
}

impl Packed {
    pub(crate) fn new(scene: &Scene, scaling: Scaling) -> Self {
        let scale_exponent = match scaling {
            Scaling::None => scale_exponent(scene, FAR),
            Scaling::PowerOfTwo => scale_exponent(scene, NEAR),
        };
        let mut packed = Self {
            triangles: Vec::with_capacity(scene.count(Kind::Triangle)),
            spheres: Vec::with_capacity(scene.count(Kind::Sphere)),
            sphere_ids: Vec::with_capacity(scene.count(Kind::Sphere)),
            scale_exponent,
            size: 0.0,
            plain: false,
            roomy: false,
            originals: None,
        };
        for (index, geometry) in scene.geometries().iter().enumerate() {
            packed.add(scene.start(index), geometry);
        }
        packed.size = power_of_two_above(packed.largest());
        let (exact, large) = packed.compare(scene);
        packed.plain = exact && large && packed.size <= PLAIN[1];
        packed.roomy = packed.plain && packed.has_cubes();
        packed.originals = (!exact).then(|| originals(scene));
        packed
    }

    /// Whether products of three extents are clear of subnormals, for every primitive that has one.
    fn has_cubes(&self) -> bool {
        // The edge of a triangle without extent is the least step above 0.
        let nothing = f32::from_bits(1);
        let extents = self.triangles.iter().map(|t| t.edge).chain(self.spheres.iter().map(|s| s.radius));
        extents.into_iter().all(|extent| extent <= nothing || extent >= ROOMY)
    }

    /// Whether scaling cost no bit, and whether every number but zero is large enough to be plain.
    fn compare(&self, scene: &Scene) -> (bool, bool) {
        let factor = 2.0_f64.powi(self.scale_exponent);
        let (mut exact, mut large) = (true, true);
        let mut see = |given: Vec3, scaled: Vec3| {
            exact &= given.as_dvec3() * factor == scaled.as_dvec3();
            large &= scaled.abs().cmpge(Vec3::splat(PLAIN[0])).bitor(scaled.cmpeq(Vec3::ZERO)).all();
        };
        let mut triangles = self.triangles.iter();
        let mut spheres = self.spheres.iter();
        for geometry in scene.geometries() {
            match geometry {
                Geometry::Mesh(mesh) => {
                    solid(mesh).zip(&mut triangles).for_each(|((_, corners), packed)| {
                        corners.into_iter().zip([packed.a, packed.b, packed.c]).for_each(|(x, y)| see(x, y));
                    });
                }
                Geometry::Spheres(all) => all.iter().zip(&mut spheres).for_each(|(s, packed)| {
                    see(s.center, packed.center);
                    see(Vec3::splat(s.radius), Vec3::splat(packed.radius));
                }),
            }
        }
        (exact, large)
    }

    #[expect(clippy::cast_possible_truncation, reason = "Bvh::new bounds the number of primitives")]
    fn add(&mut self, start: usize, geometry: &Geometry) {
        let (first, second) = power_factors(self.scale_exponent);
        let scaled = |v: Vec3| v * first * second;
        match geometry {
            Geometry::Mesh(mesh) => self
                .triangles
                .extend(solid(mesh).map(|(i, corners)| PackedTriangle::new(corners.map(scaled), (start + i) as u32))),
            Geometry::Spheres(spheres) => {
                self.spheres.extend(
                    spheres.iter().map(|s| Sphere { center: scaled(s.center), radius: s.radius * first * second }),
                );
                self.sphere_ids.extend((0..spheres.len()).map(|i| (start + i) as u32));
            }
        }
    }

    /// The largest magnitude a box can reach.
    fn largest(&self) -> f64 {
        let of_kind = |kind| (0..self.count(kind)).map(move |i| self.reach(kind, i)).fold(0.0, f64::max);
        Kind::ALL.into_iter().map(of_kind).fold(0.0, f64::max)
    }

    /// The largest magnitude that the box of primitive `i` of a kind can reach.
    fn reach(&self, kind: Kind, i: usize) -> f64 {
        match kind {
            Kind::Triangle => {
                let t = &self.triangles[i];
                f64::from(largest(t.a).max(largest(t.b)).max(largest(t.c)))
            }
            Kind::Sphere => {
                let s = &self.spheres[i];
                f64::from(largest(s.center)) + f64::from(s.radius)
            }
        }
    }

    /// How many primitives of a kind there are.
    pub(crate) const fn count(&self, kind: Kind) -> usize {
        match kind {
            Kind::Triangle => self.triangles.len(),
            Kind::Sphere => self.spheres.len(),
        }
    }

    /// The number of a kind's first primitive where the kinds are counted one after the other.
    pub(crate) fn start(&self, kind: Kind) -> usize {
        Kind::ALL.into_iter().take_while(|&before| before != kind).map(|before| self.count(before)).sum()
    }

    /// The box of primitive `i` of a kind: nothing of it is outside.
    pub(crate) fn bounds(&self, kind: Kind, i: usize) -> [Vec3; 2] {
        match kind {
            Kind::Triangle => {
                let t = &self.triangles[i];
                [t.a.min(t.b).min(t.c), t.a.max(t.b).max(t.c)]
            }
            Kind::Sphere => {
                // One step outward of the nearest, so that no rounding shrinks it.
                let s = &self.spheres[i];
                let low = (s.center - s.radius).to_array().map(f32::next_down);
                let high = (s.center + s.radius).to_array().map(f32::next_up);
                [Vec3::from(low).max(Vec3::MIN), Vec3::from(high).min(Vec3::MAX)]
            }
        }
    }

    /// The kind of a primitive by its number where the kinds are counted one after the other.
    #[inline(always)]
    pub(crate) fn kind(&self, number: usize) -> Kind {
        let ends_after = |kind: &Kind| number < self.start(*kind) + self.count(*kind);
        Kind::ALL.into_iter().find(ends_after).unwrap_or(Kind::Triangle)
    }
}

/// The triangles that can be hit, with their places in the mesh: one with two equal corners has no inside.
fn solid(mesh: &Mesh) -> impl Iterator<Item = (usize, [Vec3; 3])> {
    let corners = (0..mesh.triangles.len()).map(|i| mesh.triangle(i)).map(|t| [t.a, t.b, t.c]);
    corners.enumerate().filter(|(_, [a, b, c])| a != b && b != c && c != a)
}

fn originals(scene: &Scene) -> Originals {
    let mut all = Originals::default();
    for geometry in scene.geometries() {
        match geometry {
            Geometry::Mesh(mesh) => all.triangles.extend(solid(mesh).map(|(_, corners)| corners)),
            Geometry::Spheres(spheres) => all.spheres.extend(spheres),
        }
    }
    all
}

fn largest(v: Vec3) -> f32 {
    v.abs().max_element()
}

/// `2^exponent` as two factors that are each an `f32`: multiplying by one, then the other, is exact where the result is
/// no subnormal.
pub(crate) fn power_factors(exponent: i32) -> (f32, f32) {
    let half = exponent / 2;
    (power_of_two(half), power_of_two(exponent - half))
}

fn power_of_two(exponent: i32) -> f32 {
    2.0_f32.powi(exponent)
}

/// Within these powers of two, products of three lengths are in range.
const NEAR: [i32; 2] = [-20, 20];

/// Beyond 2^100 boxes cannot be decoded and products of two lengths overflow, whatever the formula.
const FAR: [i32; 2] = [-149, 100];

/// Scaled coordinates and radii of a plain scene are zero or between these: no bound of the precision `exact` meets a subnormal.
const PLAIN: [f32; 2] = [f32::from_bits((127 - 100) << 23), f32::from_bits((127 + 25) << 23)];

/// Products of three extents of at least this are `2^-99`, of which what underflows is less than a rounding, flushed or not.
const ROOMY: f32 = f32::from_bits((127 - 33) << 23);

/// The magnitudes that decide how a scene is scaled.
struct Magnitudes {
    /// The largest coordinate or radius.
    largest: f64,
    /// The smallest coordinate or radius but zero.
    smallest: f64,
    /// The extent of the smallest primitive that has one.
    finest: f64,
}

impl Magnitudes {
    fn of(scene: &Scene) -> Self {
        let mut all = Self { largest: 0.0, smallest: f64::INFINITY, finest: f64::INFINITY };
        for geometry in scene.geometries() {
            match geometry {
                Geometry::Mesh(mesh) => {
                    mesh.vertices.iter().for_each(|v| all.see(*v));
                    for i in 0..mesh.triangles.len() {
                        let t = mesh.triangle(i);
                        all.see_extent(largest((t.b.as_dvec3() - t.a.as_dvec3()).as_vec3()));
                    }
                }
                Geometry::Spheres(spheres) => spheres.iter().for_each(|s| {
                    all.see(s.center);
                    all.see(Vec3::splat(s.radius));
                    all.see_extent(s.radius);
                }),
            }
        }
        all
    }

    fn see(&mut self, v: Vec3) {
        for x in v.to_array().map(|x| f64::from(x).abs()) {
            self.largest = self.largest.max(x);
            if x > 0.0 {
                self.smallest = self.smallest.min(x);
            }
        }
    }

    fn see_extent(&mut self, extent: f32) {
        if extent > 0.0 {
            self.finest = self.finest.min(f64::from(extent));
        }
    }
}

/// The power of two that brings the scene's largest coordinate within `range`, or as near to it as no coordinate loses a
/// bit and the square of no extent underflows; but always to 2^100.
fn scale_exponent(scene: &Scene, range: [i32; 2]) -> i32 {
    let Magnitudes { largest, smallest, finest } = Magnitudes::of(scene);
    if largest == 0.0 {
        return 0;
    }
    let exponent = exponent_of(largest);
    if exponent > range[1] {
        // Exact while the smallest coordinate stays at or above 2^-126; squares are normal from 2^-60 on.
        let room = (exponent_of(smallest) + 126).min(exponent_of(finest).saturating_add(60)).max(0);
        -(exponent - range[1]).min(room).max(exponent - FAR[1])
    } else {
        (range[0] - exponent).max(0)
    }
}

/// `floor(log2 x)` for a normal, positive `f64`.
fn exponent_of(x: f64) -> i32 {
    (x.to_bits() >> 52) as i32 - 1023
}

/// The smallest power of two above `x`, within `2^-100` and `2^127`.
fn power_of_two_above(x: f64) -> f32 {
    let exponent = if x == 0.0 { -100 } else { exponent_of(x) + 1 };
    power_of_two(exponent.clamp(-100, 127))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene_of(coordinates: &[f32]) -> Scene {
        let vertices = coordinates.iter().map(|&x| Vec3::new(x, 0.0, 0.0)).collect();
        Scene::new(vec![Geometry::Mesh(Mesh { vertices, triangles: vec![] })]).expect("a valid scene")
    }

    #[test]
    fn ordinary_scenes_are_left_alone() {
        assert_eq!(scale_exponent(&scene_of(&[1.0, -1000.0]), NEAR), 0);
        assert_eq!(scale_exponent(&scene_of(&[0.0]), NEAR), 0);
        assert_eq!(scale_exponent(&scene_of(&[]), NEAR), 0);
    }

    #[test]
    fn extremes_are_brought_in_exactly() {
        for x in [1e30_f32, 1e-30, 1e15, 1e-15, f32::MAX, 1e-45, 1.5e-42] {
            let exponent = scale_exponent(&scene_of(&[x]), NEAR);
            let (first, second) = power_factors(exponent);
            let y = x * first * second;
            assert!((-20..=20).contains(&exponent_of(f64::from(y))), "{x:e} becomes {y:e}");
            assert_eq!(f64::from(y), f64::from(x) * 2.0_f64.powi(exponent), "{x:e} is not exact");
        }
    }

    #[test]
    fn small_coordinates_keep_their_bits() {
        // 2^100 wants 2^-80, but 2^-60 has room for 66 only.
        let small = f32::from_bits(((127 - 60) << 23) | 1);
        assert_eq!(scale_exponent(&scene_of(&[2.0_f32.powi(100), small]), NEAR), -66);
        assert_eq!(scale_exponent(&scene_of(&[2.0_f32.powi(100), 1e-45]), NEAR), 0);
        assert_eq!(scale_exponent(&scene_of(&[f32::MAX, 1e-45]), NEAR), -27, "boxes must be decodable");
        assert_eq!(scale_exponent(&scene_of(&[1e30, 1e-30]), FAR), 0);
    }

    #[test]
    fn small_primitives_keep_their_squares() {
        let ball = |x: f32, radius: f32| Sphere { center: Vec3::new(x, 0.0, 0.0), radius };
        let scene = |spheres: Vec<Sphere>| Scene::new(vec![Geometry::Spheres(spheres)]).expect("a valid scene");
        // 2^100 wants 2^-80; a ball of 2^-10 has room for 50.
        let large = ball(2.0_f32.powi(100), 2.0_f32.powi(90));
        assert_eq!(scale_exponent(&scene(vec![large]), NEAR), -80);
        assert_eq!(scale_exponent(&scene(vec![large, ball(0.0, 2.0_f32.powi(-10))]), NEAR), -50);
    }
}
