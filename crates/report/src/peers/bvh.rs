//! bvh: its traversal, and its ray's test of a triangle.

use ::bvh::aabb::{Aabb, Bounded};
use ::bvh::bounding_hierarchy::{BHShape, BoundingHierarchy};
use ::bvh::bvh::Bvh as PeerBvh;
use ::bvh::ray::{Intersection, Ray as PeerRay};
use nalgebra::{Point3, Vector3};
use rayproof::scene::{FlatHit, Mesh, Ray};

use super::threads::Crate;

/// A triangle as the crate wants shapes.
struct Face {
    corners: [Point3<f32>; 3],
    number: u32,
    node: usize,
}

impl Bounded<f32, 3> for Face {
    fn aabb(&self) -> Aabb<f32, 3> {
        self.corners.iter().fold(Aabb::empty(), |bounds, corner| bounds.grow(corner))
    }
}

impl BHShape<f32, 3> for Face {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

pub(super) struct Bvh {
    tree: PeerBvh<f32, 3>,
    faces: Vec<Face>,
}

impl Crate for Bvh {
    const NAME: &'static str = "bvh";
    const VERSION: &'static str = "0.13.0";
    const HOW: &'static str = "Bvh::build_par, Bvh::traverse, and Ray::intersects_triangle with every triangle that it \
                               returns; that test culls back faces, so both windings are tried; its rays have unit \
                               directions, so t is its distance over the direction's length";

    fn build(mesh: &Mesh) -> Result<Self, String> {
        let numbered = (0_u32..).zip(&mesh.triangles);
        let face = |(number, indices): (u32, &[u32; 3])| Face {
            corners: indices.map(|i| Point3::from(mesh.vertices[i as usize].to_array())),
            number,
            node: 0,
        };
        let mut faces: Vec<Face> = numbered.map(face).collect();
        let tree = PeerBvh::build_par(&mut faces);
        Ok(Self { tree, faces })
    }

    fn closest(&self, ray: &Ray) -> FlatHit {
        let length = ray.direction.length();
        let direction = Vector3::from(ray.direction.to_array());
        let peer_ray = PeerRay::new(Point3::from(ray.origin.to_array()), direction);
        let mut closest = FlatHit::MISS;
        for face in self.tree.traverse(&peer_ray, &self.faces) {
            let Intersection { distance, u, v } = two_sided(&peer_ray, face);
            let t = distance / length;
            if t < closest.t && ray.t_min <= t && t <= ray.t_max {
                closest = FlatHit { t, u, v, primitive: face.number };
            }
        }
        closest
    }
}

fn two_sided(ray: &PeerRay<f32, 3>, face: &Face) -> Intersection<f32> {
    let [a, b, c] = &face.corners;
    let front = ray.intersects_triangle(a, b, c);
    if front.distance < f32::INFINITY {
        return front;
    }
    let back = ray.intersects_triangle(a, c, b);
    Intersection::new(back.distance, back.v, back.u)
}
