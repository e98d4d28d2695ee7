//! The primitives in the order of the tree's leaves, as each precision takes them.

use rayon::prelude::*;
use rayproof_scene::{FlatHit, Kind, Kinds, Ray, Sphere};
use rayproof_tree::{Bvh, Child, Originals, PackedTriangle};

use crate::branch::Branch;
use crate::exact::resolve::Shape;
use crate::exact::round;
use crate::exact::second::SecondRay;
use crate::lanes::Triangles4;
use crate::pages::in_large_pages;
use crate::twin::exact::line::takes_chords;
use crate::twin::leaf::word::{place_index, place_kind};

/// All primitives. The index in the place of a triangle is `4 leaf + lane`.
#[derive(Clone, Debug)]
pub(crate) struct Primitives {
    /// The scaled triangles, a leaf each.
    pub(crate) leaves: Vec<Triangles4>,
    /// The scaled spheres.
    pub(crate) spheres: Vec<Sphere>,
    pub(crate) sphere_ids: Vec<u32>,
    /// The kinds that there are.
    pub(crate) kinds: Kinds,
    /// Both as they were, where scaling cost a bit.
    originals: Option<(Vec<Triangles4>, Vec<Sphere>)>,
    pub(crate) scale_exponent: i32,
    /// Two to that.
    pub(crate) scale: f64,
}

impl Primitives {
    /// The primitives of a tree, and its nodes with words that name leaves of four lanes.
    pub(crate) fn new<N: Branch>(bvh: Bvh<N::Packed>) -> (Self, Vec<N>) {
        let mut nodes = in_large_pages(bvh.nodes.par_iter().map(N::unpacked));
        let mut ranges = Vec::with_capacity(bvh.triangles.len() / 2);
        for node in &mut nodes {
            for k in 0..N::WIDTH {
                let Child::Leaf { kind, first, count } = Child::from_word(node.child(k)) else { continue };
                match kind {
                    Kind::Triangle => {
                        node.set_child(k, Child::Leaf { kind, first: ranges.len(), count }.word());
                        ranges.push(first..first + count);
                    }
                    Kind::Sphere => {}
                }
            }
        }
        let lanes = |triangles: &[PackedTriangle]| {
            in_large_pages(ranges.par_iter().map(|range| Triangles4::new(&triangles[range.clone()])))
        };
        let kinds = bvh.kinds();
        let Bvh { triangles, spheres, sphere_ids, originals, scale_exponent, .. } = bvh;
        let leaves = lanes(&triangles);
        let originals = originals.map(|Originals { triangles: corners, spheres }| {
            let at = |([a, b, c], packed): ([_; 3], &PackedTriangle)| PackedTriangle { a, b, c, ..*packed };
            let triangles: Vec<PackedTriangle> = corners.into_iter().zip(&triangles).map(at).collect();
            (lanes(&triangles), spheres)
        });
        let scale = 2.0_f64.powi(scale_exponent);
        (Self { leaves, spheres, sphere_ids, kinds, originals, scale_exponent, scale }, nodes)
    }

    /// The flat number of the primitive in a place.
    #[inline(always)]
    pub(crate) fn id(&self, place: u32) -> u32 {
        let index = place_index(place);
        match place_kind(place) {
            Kind::Triangle => self.leaves[index >> 2].ids[index & 3],
            Kind::Sphere => self.sphere_ids[index],
        }
    }

    /// The hit of a ray and the primitive in a place, which is hit in range; `doubts` counts what only exact arithmetic could round.
    #[inline(always)]
    pub(crate) fn hit(&self, ray: &Ray, place: u32, doubts: &mut u32) -> FlatHit {
        let ray = SecondRay::new(ray, self.scale, takes_chords(place_kind(place)));
        let [t, u, v] = round(&ray, &self.shape(place), self.scale_exponent, doubts);
        FlatHit { t, u, v, primitive: self.id(place) }
    }

    /// The primitive in a place, scaled, exactly.
    #[inline(always)]
    pub(crate) fn shape(&self, place: u32) -> Shape {
        let (leaves, spheres, scale) = match &self.originals {
            None => (&self.leaves, &self.spheres, 1.0),
            Some((leaves, spheres)) => (leaves, spheres, self.scale),
        };
        let index = place_index(place);
        match place_kind(place) {
            Kind::Triangle => {
                let corners = leaves[index >> 2].corners(index & 3);
                Shape::Triangle(corners.map(|p| p.map(|x| f64::from(x) * scale)))
            }
            Kind::Sphere => {
                let Sphere { center, radius } = spheres[index];
                let center = (center.as_dvec3() * scale).to_array();
                Shape::Sphere { center, radius: f64::from(radius) * scale }
            }
        }
    }
}
