//! Twins of `shaders/leaf/`: what a leaf's word names, and the closer of two hits.

use rayproof_scene::bvh::{Bvh, Child, Node};
use rayproof_scene::{Hit, Sphere};

use crate::batch::{Candidate, TierRay};
use crate::bvh::slab::WideNode;
use crate::lanes::{Candidates, Triangles4};

/// Bit 30 of a leaf's word: it holds spheres.
pub(crate) const SPHERES: u32 = 1 << 30;

#[inline(always)]
fn closer(found: Candidate, id: u32, hit: Hit) -> Hit {
    if found.hit && (found.t < hit.t || (found.t == hit.t && id < hit.primitive)) {
        return Hit { t: found.t, u: found.u, v: found.v, primitive: id };
    }
    hit
}

#[inline(always)]
const fn leaf_range(word: u32) -> std::ops::Range<usize> {
    let first = (word & 0x0fff_ffff) as usize;
    first..first + ((word >> 28) & 3) as usize + 1
}

/// Twin of `shaders/leaf/triangles.wgsl`; here a leaf's word names its four lanes.
#[inline(always)]
pub(crate) fn intersect_triangles(
    leaves: &[Triangles4],
    ray: &TierRay,
    word: u32,
    before: Hit,
    intersect_triangle: impl Fn(&TierRay, &Triangles4) -> Candidates,
) -> Hit {
    let leaf = &leaves[leaf_range(word).start];
    let found = intersect_triangle(ray, leaf);
    let mut hit = before;
    let mut left = found.hits;
    while left != 0 {
        let k = left.trailing_zeros() as usize;
        left &= left - 1;
        let candidate = Candidate { hit: true, t: found.t[k], u: found.u[k], v: found.v[k] };
        hit = closer(candidate, leaf.ids[k], hit);
    }
    hit
}

/// The lanes of every triangle leaf of a tree, and its nodes with words that name them.
pub(crate) fn lanes(bvh: &Bvh) -> (Vec<Triangles4>, Vec<WideNode>) {
    let mut leaves = Vec::with_capacity(bvh.triangles.len() / 2);
    let mut node = |node: &Node| {
        let mut wide = WideNode::new(node);
        let mut children = wide.children();
        for word in &mut children {
            if let Child::Triangles { first, count } = Child::from_word(*word) {
                *word = Child::Triangles { first: leaves.len(), count }.word();
                leaves.push(Triangles4::new(&bvh.triangles[first..first + count]));
            }
        }
        wide.set_children(children);
        wide
    };
    let nodes = bvh.nodes.iter().map(&mut node).collect();
    (leaves, nodes)
}

/// Twin of `shaders/leaf/spheres.wgsl`.
#[inline(always)]
pub(crate) fn intersect_spheres(
    spheres: &[Sphere],
    ids: &[u32],
    ray: &TierRay,
    word: u32,
    before: Hit,
    intersect_sphere: impl Fn(&TierRay, &Sphere) -> Candidate,
) -> Hit {
    let mut hit = before;
    for i in leaf_range(word) {
        hit = closer(intersect_sphere(ray, &spheres[i]), ids[i], hit);
    }
    hit
}
