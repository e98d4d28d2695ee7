//! What a tree is built over: boxes, and the places of their middles.

use glam::{Vec3, Vec4, Vec4Swizzles as _};

/// A primitive's box, with its number where a fourth coordinate would be. Twice 16 bytes: the tree is built by moving these.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item {
    low: Vec4,
    high: Vec4,
}

impl Item {
    pub(crate) fn new([low, high]: [Vec3; 2], number: u32) -> Self {
        Self { low: low.extend(f32::from_bits(number)), high: high.extend(0.0) }
    }

    #[inline(always)]
    pub(crate) fn number(&self) -> u32 {
        self.low.w.to_bits()
    }

    /// Twice the middle of the box.
    #[inline(always)]
    pub(super) fn middle(&self) -> Vec4 {
        self.low + self.high
    }
}

/// The box of many; the fourth coordinates mean nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: Vec4,
    pub(super) high: Vec4,
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { low: Vec4::INFINITY, high: Vec4::NEG_INFINITY };

    #[inline(always)]
    pub(super) fn join(&mut self, low: Vec4, high: Vec4) {
        // What is new comes first: where a fourth coordinate is no number, the processor's minimum takes the second.
        self.low = low.min(self.low);
        self.high = high.max(self.high);
    }

    #[inline(always)]
    pub(super) fn with(mut self, other: &Self) -> Self {
        self.join(other.low, other.high);
        self
    }

    pub(super) fn corners(&self) -> [Vec3; 2] {
        [self.low.xyz(), self.high.xyz()]
    }

    pub(super) fn extent(&self) -> Vec3 {
        (self.high - self.low).xyz()
    }

    /// Half the surface, in units of `1 / inverse`; 0 of nothing.
    #[inline(always)]
    pub(super) fn half_area(&self, inverse: f32) -> f32 {
        let d = (self.high - self.low).max(Vec4::ZERO) * inverse;
        let faces = d * d.yzxw();
        faces.x + faces.y + faces.z
    }
}

/// The box of items, and the box of twice their middles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extents {
    pub(super) bounds: Bounds,
    pub(super) middles: Bounds,
}

impl Extents {
    pub(super) const EMPTY: Self = Self { bounds: Bounds::EMPTY, middles: Bounds::EMPTY };

    pub(super) fn of(items: &[Item]) -> Self {
        let mut extents = Self::EMPTY;
        items.iter().for_each(|item| extents.join(item));
        extents
    }

    #[inline(always)]
    pub(super) fn join(&mut self, item: &Item) {
        let middle = item.middle();
        self.bounds.join(item.low, item.high);
        self.middles.join(middle, middle);
    }

    pub(super) fn with(self, other: &Self) -> Self {
        Self { bounds: self.bounds.with(&other.bounds), middles: self.middles.with(&other.middles) }
    }
}

impl Item {
    #[inline(always)]
    pub(super) fn joins(&self, bounds: &mut Bounds) {
        bounds.join(self.low, self.high);
    }

    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        Bounds { low: self.low, high: self.high }
    }
}
