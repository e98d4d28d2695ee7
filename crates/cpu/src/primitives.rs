//! The primitives in the order of the tree's leaves, as each precision takes them.

use rayproof_scene::Sphere;
use rayproof_tree::{Bvh, Child, Originals, PackedTriangle};

use crate::bvh::slab::UnpackedNode;
use crate::exact::resolve::Shape;
use crate::lanes::Triangles4;
use crate::leaf::SPHERES;

/// All primitives. A place is `4 leaf + lane` of a triangle, or the index of a sphere with [`SPHERES`] set.
#[derive(Clone, Debug)]
pub(crate) struct Primitives {
    /// The scaled triangles, a leaf each.
    pub(crate) leaves: Vec<Triangles4>,
    /// The scaled spheres.
    pub(crate) spheres: Vec<Sphere>,
    pub(crate) sphere_ids: Vec<u32>,
    /// Both as they were, where scaling cost a bit.
    originals: Option<(Vec<Triangles4>, Vec<Sphere>)>,
    pub(crate) scale_exponent: i32,
    /// Two to that.
    pub(crate) scale: f64,
}

impl Primitives {
    /// The primitives of a tree, and its nodes with words that name leaves of four lanes.
    pub(crate) fn new(bvh: Bvh) -> (Self, Vec<UnpackedNode>) {
        let mut nodes: Vec<UnpackedNode> = bvh.nodes.iter().map(UnpackedNode::new).collect();
        let mut ranges = Vec::with_capacity(bvh.triangles.len() / 2);
        for node in &mut nodes {
            let mut children = node.children();
            for word in &mut children {
                if let Child::Triangles { first, count } = Child::from_word(*word) {
                    *word = Child::Triangles { first: ranges.len(), count }.word();
                    ranges.push(first..first + count);
                }
            }
            node.set_children(children);
        }
        let lanes = |triangles: &[PackedTriangle]| {
            ranges.iter().map(|range| Triangles4::new(&triangles[range.clone()])).collect::<Vec<_>>()
        };
        let Bvh { triangles, spheres, sphere_ids, originals, scale_exponent, .. } = bvh;
        let leaves = lanes(&triangles);
        let originals = originals.map(|Originals { triangles: corners, spheres }| {
            let at = |([a, b, c], packed): ([_; 3], &PackedTriangle)| PackedTriangle { a, b, c, ..*packed };
            let triangles: Vec<PackedTriangle> = corners.into_iter().zip(&triangles).map(at).collect();
            (lanes(&triangles), spheres)
        });
        let scale = 2.0_f64.powi(scale_exponent);
        (Self { leaves, spheres, sphere_ids, originals, scale_exponent, scale }, nodes)
    }

    /// The flat number of the primitive in a place.
    #[inline(always)]
    pub(crate) fn id(&self, slot: u32) -> u32 {
        if slot & SPHERES == 0 {
            self.leaves[slot as usize >> 2].ids[slot as usize & 3]
        } else {
            self.sphere_ids[(slot & !SPHERES) as usize]
        }
    }

    /// The primitive in a place, scaled, exactly.
    #[inline(always)]
    pub(crate) fn shape(&self, slot: u32) -> Shape {
        let (leaves, spheres, scale) = match &self.originals {
            None => (&self.leaves, &self.spheres, 1.0),
            Some((leaves, spheres)) => (leaves, spheres, self.scale),
        };
        if slot & SPHERES == 0 {
            let corners = leaves[slot as usize >> 2].corners(slot as usize & 3);
            Shape::Triangle(corners.map(|p| p.map(|x| f64::from(x) * scale)))
        } else {
            let Sphere { center, radius } = spheres[(slot & !SPHERES) as usize];
            let center = (center.as_dvec3() * scale).to_array();
            Shape::Sphere { center, radius: f64::from(radius) * scale }
        }
    }
}
