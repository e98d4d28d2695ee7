use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// The ray `p(t) = origin + t direction` for `t_min <= t <= t_max`, both ends included. 32 bytes, as on the device.
///
/// `direction` has any non-zero length and `t` is in multiples of it. `t_min` and `t_max` may be infinite; nothing
/// else may.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Ray {
    /// Where the ray starts, `e`.
    pub origin: Vec3,
    /// The smallest `t` that counts.
    pub t_min: f32,
    /// Where the ray goes, `d`.
    pub direction: Vec3,
    /// The largest `t` that counts.
    pub t_max: f32,
}

impl Ray {
    /// The ray from `origin` along `direction` over `0 <= t <= inf`.
    #[must_use]
    pub fn new(origin: impl Into<Vec3>, direction: impl Into<Vec3>) -> Self {
        Self { origin: origin.into(), t_min: 0.0, direction: direction.into(), t_max: f32::INFINITY }
    }

    /// The point `p(t) = e + t d`, rounded.
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }

    /// Why this ray is not one, or `None` where it is.
    #[must_use]
    #[inline]
    pub fn fault(&self) -> Option<RayFault> {
        if self.is_sound() { None } else { Some(self.first_fault()) }
    }

    /// Whether it has no fault, without a branch: every ray of every batch is asked, and nearly all have none.
    #[inline(always)]
    fn is_sound(&self) -> bool {
        let Self { origin: o, direction: d, t_min, t_max } = self;
        let finite =
            o.x.is_finite() & o.y.is_finite() & o.z.is_finite() & d.x.is_finite() & d.y.is_finite() & d.z.is_finite();
        // A NaN is in no order.
        finite & ((d.x != 0.0) | (d.y != 0.0) | (d.z != 0.0)) & (t_min <= t_max)
    }

    /// The first fault of a ray that has one.
    #[cold]
    fn first_fault(&self) -> RayFault {
        if !self.origin.is_finite() {
            RayFault::Origin
        } else if !self.direction.is_finite() {
            RayFault::Direction
        } else if self.direction == Vec3::ZERO {
            RayFault::ZeroDirection
        } else {
            RayFault::Range
        }
    }
}

/// What can be wrong with a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RayFault {
    /// A NaN or an infinity in the origin.
    #[error("the origin is not finite; give three finite numbers")]
    Origin,
    /// A NaN or an infinity in the direction.
    #[error("the direction is not finite; give three finite numbers")]
    Direction,
    /// All three components of the direction are zero.
    #[error("the direction is zero; give it any length but zero")]
    ZeroDirection,
    /// A NaN in the range, or `t_min > t_max`.
    #[error("the range is empty or not a number; give t_min <= t_max (either may be infinite)")]
    Range,
}

/// What becomes of a ray that is none (see [`Ray::fault`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InvalidRays {
    /// An error, which says which is the first and how many there are.
    #[default]
    Error,
    /// It hits nothing, and is counted.
    Miss,
}

/// What stands in for a bad ray: finite, and with an empty range, so that nothing can be hit.
pub const INVALID_RAY: Ray = Ray { origin: Vec3::ZERO, t_min: 1.0, direction: Vec3::X, t_max: 0.0 };

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_fault_is_named_and_nothing_else_is_one() {
        let good = Ray { origin: Vec3::ZERO, t_min: 0.0, direction: Vec3::ONE, t_max: 1.0 };
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for axis in 0..3 {
                let mut ray = good;
                ray.origin[axis] = bad;
                assert_eq!(ray.fault(), Some(RayFault::Origin), "{ray:?}");
                let mut ray = good;
                ray.direction[axis] = bad;
                assert_eq!(ray.fault(), Some(RayFault::Direction), "{ray:?}");
            }
        }
        assert_eq!(Ray { direction: Vec3::new(0.0, -0.0, 0.0), ..good }.fault(), Some(RayFault::ZeroDirection));
        for (t_min, t_max) in [(f32::NAN, 1.0), (0.0, f32::NAN), (1.0, 0.0), (f32::INFINITY, 1.0)] {
            assert_eq!(Ray { t_min, t_max, ..good }.fault(), Some(RayFault::Range), "{t_min} {t_max}");
        }
        let tiny = f32::from_bits(1);
        for direction in [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * tiny) {
            assert_eq!(Ray { direction, ..good }.fault(), None, "{direction:?}");
        }
        for (t_min, t_max) in [(1.0, 1.0), (f32::NEG_INFINITY, f32::INFINITY), (f32::INFINITY, f32::INFINITY)] {
            assert_eq!(Ray { t_min, t_max, ..good }.fault(), None, "{t_min} {t_max}");
        }
    }
}
