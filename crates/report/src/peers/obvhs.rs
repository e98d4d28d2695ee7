//! obvhs: its two trees, with its triangle for CPUs.

use std::time::Duration;

use ::obvhs::BvhBuildParams;
use ::obvhs::bvh2::{Bvh2, builder::build_bvh2_from_tris};
use ::obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use ::obvhs::ray::{INVALID_ID, Ray as PeerRay, RayHit};
use ::obvhs::rt_triangle::RtTriangle;
use ::obvhs::triangle::Triangle;
use rayproof::scene::{FlatHit, Mesh, Ray};

use super::threads::Crate;

/// The build its examples take: the same primitive in one leaf only.
const BUILD: BvhBuildParams = BvhBuildParams::medium_build();

/// A kind of tree.
pub(super) trait Tree: Send + Sync + 'static {
    const NAME: &'static str;
    const HOW: &'static str;
    fn build(triangles: &[Triangle]) -> Self;
    /// The number of the triangle at each place of the tree's order.
    fn order(&self) -> &[u32];
    /// Traces over triangles in the tree's order.
    fn trace(&self, ray: PeerRay, hit: &mut RayHit, triangles: &[RtTriangle]);
}

impl Tree for CwBvh {
    const NAME: &'static str = "obvhs CwBvh";
    const HOW: &'static str = "CwBvh of medium_build, ray_traverse with RtTriangle::intersect over triangles in the \
                               tree's order; u and v by RtTriangle::compute_barycentric, not timed";

    fn build(triangles: &[Triangle]) -> Self {
        build_cwbvh_from_tris(triangles, BUILD, &mut Duration::default())
    }

    fn order(&self) -> &[u32] {
        &self.primitive_indices
    }

    fn trace(&self, ray: PeerRay, hit: &mut RayHit, triangles: &[RtTriangle]) {
        self.ray_traverse(ray, hit, |ray, i| triangles[i].intersect(ray));
    }
}

impl Tree for Bvh2 {
    const NAME: &'static str = "obvhs Bvh2";
    const HOW: &'static str = "Bvh2 of medium_build, ray_traverse with RtTriangle::intersect over triangles in the \
                               tree's order; u and v by RtTriangle::compute_barycentric, not timed";

    fn build(triangles: &[Triangle]) -> Self {
        build_bvh2_from_tris(triangles, BUILD, &mut Duration::default())
    }

    fn order(&self) -> &[u32] {
        &self.primitive_indices
    }

    fn trace(&self, ray: PeerRay, hit: &mut RayHit, triangles: &[RtTriangle]) {
        self.ray_traverse(ray, hit, |ray, i| triangles[i].intersect(ray));
    }
}

/// One of its trees over a mesh.
pub(super) struct Obvhs<T> {
    tree: T,
    /// In the tree's order, as its examples trace.
    ordered: Vec<RtTriangle>,
    /// In the mesh's.
    triangles: Vec<RtTriangle>,
}

impl<T: Tree> Crate for Obvhs<T> {
    const NAME: &'static str = T::NAME;
    const VERSION: &'static str = "0.4.0";
    const HOW: &'static str = T::HOW;

    fn build(mesh: &Mesh) -> Result<Self, String> {
        let corners = |i: &[u32; 3]| i.map(|i| mesh.vertices[i as usize].into());
        let given = mesh.triangles.iter().map(corners).map(|[v0, v1, v2]| Triangle { v0, v1, v2 });
        let given: Vec<Triangle> = given.collect();
        let tree = T::build(&given);
        let triangles: Vec<RtTriangle> = given.iter().map(RtTriangle::from).collect();
        let ordered = tree.order().iter().map(|&i| RtTriangle::from(&given[i as usize])).collect();
        Ok(Self { tree, ordered, triangles })
    }

    fn closest(&self, ray: &Ray) -> FlatHit {
        let mut hit = RayHit::none();
        self.tree.trace(peer_ray(ray), &mut hit, &self.ordered);
        if hit.primitive_id == INVALID_ID {
            return FlatHit::MISS;
        }
        let primitive = self.tree.order()[hit.primitive_id as usize];
        FlatHit { t: hit.t, u: 0.0, v: 0.0, primitive }
    }

    fn weigh(&self, ray: &Ray, hit: &mut FlatHit) {
        // Not Triangle::compute_barycentric: it divides by the unit normal, so its weights are off by twice the area.
        let weights = self.triangles[hit.primitive as usize].compute_barycentric(&peer_ray(ray));
        (hit.u, hit.v) = (weights.x, weights.y);
    }
}

fn peer_ray(ray: &Ray) -> PeerRay {
    PeerRay::new(ray.origin.into(), ray.direction.into(), ray.t_min, ray.t_max)
}
