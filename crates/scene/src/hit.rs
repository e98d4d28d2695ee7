use bytemuck::{Pod, Zeroable};

/// The `geometry` and the `primitive` of a ray that hits nothing.
pub const MISS: u32 = u32::MAX;

/// Where a ray first meets the scene: 20 bytes, a row of a file of hits.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Hit {
    /// The parameter on the ray, in multiples of its direction; infinite for a miss.
    pub t: f32,
    /// The weight of the triangle's second vertex; 0 on a sphere.
    pub u: f32,
    /// The weight of the triangle's third vertex; 0 on a sphere.
    pub v: f32,
    /// The index of the geometry in its scene, or [`MISS`].
    pub geometry: u32,
    /// The index of the primitive in its geometry, or [`MISS`].
    pub primitive: u32,
}

impl Hit {
    /// The answer to a ray that hits nothing.
    pub const MISS: Self = Self { t: f32::INFINITY, u: 0.0, v: 0.0, geometry: MISS, primitive: MISS };

    /// Whether the ray hit something. (A hit too has an infinite `t` where the exact one is beyond `f32`.)
    #[must_use]
    pub const fn is_hit(&self) -> bool {
        self.geometry != MISS
    }

    /// Whether two answers are the same in every bit.
    #[must_use]
    pub fn same_bits(&self, other: &Self) -> bool {
        bytemuck::bytes_of(self) == bytemuck::bytes_of(other)
    }
}

/// A hit by the flat number of its primitive, as engines and judges pass it on: 16 bytes, as on the device.
/// [`Scene::hit`](crate::Scene::hit) makes a [`Hit`] of it, for people.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct FlatHit {
    /// The parameter on the ray, in multiples of its direction; infinite for a miss.
    pub t: f32,
    /// The weight of the triangle's second vertex; 0 on a sphere.
    pub u: f32,
    /// The weight of the triangle's third vertex; 0 on a sphere.
    pub v: f32,
    /// The flat number of the primitive (see [`Scene::locate`](crate::Scene::locate)), or [`MISS`].
    pub primitive: u32,
}

impl FlatHit {
    /// The answer to a ray that hits nothing.
    pub const MISS: Self = Self { t: f32::INFINITY, u: 0.0, v: 0.0, primitive: MISS };

    /// Whether the ray hit something.
    #[must_use]
    pub const fn is_hit(&self) -> bool {
        self.primitive != MISS
    }

    /// Whether two answers are the same in every bit.
    #[must_use]
    pub fn same_bits(&self, other: &Self) -> bool {
        bytemuck::bytes_of(self) == bytemuck::bytes_of(other)
    }
}

/// How many rays each stage of the cascade `exact` left open; all 0 in the other precisions, which leave nothing open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Undecided {
    /// Rays whose answer the certificates in `f32` did not settle.
    pub first_stage: u64,
    /// Rays of which double width left something open: the answer, or how a number rounds.
    pub after_refine: u64,
    /// Rays for which exact arithmetic ran, on the CPU.
    pub resolved_on_cpu: u64,
}

impl std::ops::AddAssign for Undecided {
    fn add_assign(&mut self, other: Self) {
        self.first_stage += other.first_stage;
        self.after_refine += other.after_refine;
        self.resolved_on_cpu += other.resolved_on_cpu;
    }
}

impl std::iter::Sum for Undecided {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |mut sum, one| {
            sum += one;
            sum
        })
    }
}
