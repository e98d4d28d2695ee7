use glam::Vec3;

/// The part `u >= 0`, `v >= 0`, `u + v <= 1` of the parametric plane `f(u, v) = a + u (b - a) + v (c - a)`.
///
/// Edges and vertices belong to it, and both faces can be hit. One without area is never hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The vertex at `(u, v) = (0, 0)`.
    pub a: Vec3,
    /// The vertex at `(1, 0)`.
    pub b: Vec3,
    /// The vertex at `(0, 1)`.
    pub c: Vec3,
}

impl Triangle {
    /// The point `f(u, v) = a + u (b - a) + v (c - a)`, rounded.
    #[must_use]
    pub fn point(&self, u: f32, v: f32) -> Vec3 {
        self.a + (self.b - self.a) * u + (self.c - self.a) * v
    }

    /// The geometric normal `(b - a) x (c - a)`, not normalised; zero where there is no area.
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        (self.b - self.a).cross(self.c - self.a)
    }
}
