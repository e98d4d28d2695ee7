use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// The implicit surface `f(p) = (p - c).(p - c) - r^2 = 0`, with `radius >= 0`. 16 bytes, as on the device.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Sphere {
    /// The centre `c`.
    pub center: Vec3,
    /// The radius `r`, zero or more.
    pub radius: f32,
}

impl Sphere {
    /// The sphere of a centre and a radius.
    #[must_use]
    pub fn new(center: impl Into<Vec3>, radius: f32) -> Self {
        Self { center: center.into(), radius }
    }

    /// The implicit function `f(p) = (p - c).(p - c) - r^2`: negative inside, zero on the surface, positive outside.
    #[must_use]
    pub fn f(&self, p: Vec3) -> f32 {
        let o = p - self.center;
        o.dot(o) - self.radius * self.radius
    }

    /// The outward unit normal at a point `p` of the surface; not a number at the centre.
    #[must_use]
    pub fn normal(&self, p: Vec3) -> Vec3 {
        (p - self.center).normalize()
    }
}
