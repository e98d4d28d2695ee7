//! parry3d: the ray cast of its triangle mesh, in `f32`.

use parry3d::math::Vector;
use parry3d::query::details::local_ray_intersection_with_triangle;
use parry3d::query::{Ray as PeerRay, RayCast};
use parry3d::shape::TriMesh;
use rayproof::scene::{FlatHit, Mesh, Ray};

use super::from_zero;
use super::threads::Crate;

pub(super) struct Parry(TriMesh);

impl Crate for Parry {
    const NAME: &'static str = "parry3d";
    const VERSION: &'static str = "0.31.1";
    const HOW: &'static str = "TriMesh::cast_local_ray_and_get_normal, f32; u and v by \
                               local_ray_intersection_with_triangle with the triangle hit, not timed";

    fn build(mesh: &Mesh) -> Result<Self, String> {
        let vertices = mesh.vertices.iter().map(|v| Vector::from_array(v.to_array())).collect();
        TriMesh::new(vertices, mesh.triangles.clone()).map(Self).map_err(|error| error.to_string())
    }

    fn fits(rays: &[Ray]) -> Result<(), String> {
        from_zero(rays)
    }

    fn closest(&self, ray: &Ray) -> FlatHit {
        // Its unbounded ray is one that ends at the largest number.
        let hit = self.0.cast_local_ray_and_get_normal(&peer_ray(ray), ray.t_max.min(f32::MAX), false);
        hit.map_or(FlatHit::MISS, |hit| FlatHit { t: hit.time_of_impact, u: 0.0, v: 0.0, primitive: hit.subshape })
    }

    fn weigh(&self, ray: &Ray, hit: &mut FlatHit) {
        let triangle = self.0.triangle(hit.primitive);
        let found = local_ray_intersection_with_triangle(triangle.a, triangle.b, triangle.c, &peer_ray(ray));
        if let Some((_, weights)) = found {
            (hit.u, hit.v) = (weights.y, weights.z);
        }
    }
}

fn peer_ray(ray: &Ray) -> PeerRay {
    PeerRay::new(Vector::from_array(ray.origin.to_array()), Vector::from_array(ray.direction.to_array()))
}
