//! Where a group of primitives is cut in two.
//!
//! By the surface area heuristic: a ray that meets a box meets a part of it about as often as the part's surface is of the box's,
//! so a cut costs `area(left) blocks(left) + area(right) blocks(right)`, in blocks of as many primitives as a leaf holds. The cuts
//! tried lie between bins of equal width on each axis (I. Wald, "On fast construction of SAH-based bounding volume hierarchies",
//! 2007), or between those that are large and those that are small.

use glam::Vec4;
use rayon::prelude::*;

use super::LEAF_SIZE;
use super::item::{Bounds, Extents, Item};

/// The most bins an axis is divided into; few primitives have fewer.
const BINS: usize = 32;

/// From this many on, the cores share the work of one cut.
const MANY: usize = 1 << 16;

/// Parts that the cores take.
const CHUNK: usize = 1 << 14;

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: u32,
}

const EMPTY: Bin = Bin { bounds: Bounds::EMPTY, count: 0 };

/// How items are told apart: by the places of their middles on each axis, and by their size.
const WAYS: usize = 4;
const BY_SIZE: usize = 3;

/// What is left when large ones are taken out can be cut by place as it could not before, to about this: a floor among what stands
/// on it has the box of all. Without it the incoherent rays of the hall are 7 % slower.
const SMALL_ONES: f32 = 0.75;

/// Which bin an item lies in, each way.
struct Grid {
    low: Vec4,
    scale: Vec4,
    bins: usize,
    /// One over the longest side of all, and the bits of half the surface of all.
    inverse: f32,
    area: u32,
}

impl Grid {
    fn new(Extents { bounds, middles }: &Extents, count: usize) -> Self {
        let bins = (count / 8 + 4).clamp(8, BINS);
        let extent = middles.high - middles.low;
        // On an axis without extent all lie in the first bin: there is no cut.
        #[expect(clippy::cast_precision_loss, reason = "at most 32")]
        let scale = (Vec4::splat(bins as f32 * 0.999_999) / extent).to_array();
        let finite = scale.map(|scale| if scale.is_finite() { scale } else { 0.0 });
        let inverse = 1.0 / bounds.extent().max_element();
        let inverse = if inverse.is_finite() { inverse } else { 1.0 };
        let area = bounds.half_area(inverse).to_bits();
        Self { low: middles.low, scale: Vec4::from_array(finite), bins, inverse, area }
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to below the number of bins")]
    fn place(&self, item: &Item) -> [usize; 3] {
        let at = ((item.middle() - self.low) * self.scale).to_array();
        [0, 1, 2].map(|axis| (at[axis] as i32 as usize).min(self.bins - 1))
    }

    /// By how many powers of two its surface is less than that of all.
    #[inline(always)]
    fn size(&self, item: &Item) -> usize {
        let area = item.bounds().half_area(self.inverse).to_bits();
        ((self.area.saturating_sub(area) >> 23) as usize).min(self.bins - 1)
    }

    #[inline(always)]
    fn ways(&self, item: &Item) -> [usize; WAYS] {
        let [x, y, z] = self.place(item);
        [x, y, z, self.size(item)]
    }
}

type Bins = [[Bin; BINS]; WAYS];

fn fill(items: &[Item], grid: &Grid) -> Bins {
    let mut bins = [[EMPTY; BINS]; WAYS];
    for item in items {
        for (way, bin) in grid.ways(item).into_iter().enumerate() {
            let bin = &mut bins[way][bin];
            item.joins(&mut bin.bounds);
            bin.count += 1;
        }
    }
    bins
}

fn both(mut a: Bins, b: &Bins) -> Bins {
    for (a, b) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        a.bounds = a.bounds.with(&b.bounds);
        a.count += b.count;
    }
    a
}

/// The cheapest cut: a way, and the last bin on the left.
fn cheapest(bins: &Bins, grid: &Grid) -> Option<(usize, usize)> {
    #[expect(clippy::cast_precision_loss, reason = "an estimate")]
    let cost = |b: &Bounds, count: u32| b.half_area(grid.inverse) * count.div_ceil(LEAF_SIZE) as f32;
    let mut best = (f32::INFINITY, None);
    for (way, bins) in bins.iter().enumerate() {
        let mut right = [(0.0, 0); BINS];
        let (mut sum, mut count) = (Bounds::EMPTY, 0);
        for i in (1..grid.bins).rev() {
            sum = sum.with(&bins[i].bounds);
            count += bins[i].count;
            right[i] = (cost(&sum, count), count);
        }
        let (mut sum, mut count) = (Bounds::EMPTY, 0);
        for i in 0..grid.bins - 1 {
            sum = sum.with(&bins[i].bounds);
            count += bins[i].count;
            let (cost_right, count_right) = right[i + 1];
            if count > 0 && count_right > 0 {
                let both = cost(&sum, count) + if way == BY_SIZE { SMALL_ONES * cost_right } else { cost_right };
                if both < best.0 {
                    best = (both, Some((way, i)));
                }
            }
        }
    }
    best.1
}

/// Cuts where it costs least, the left before the right; returned are where the right begins and the extents of both. None where no
/// cut divides them.
pub(super) fn cut(items: &mut [Item], extents: &Extents) -> Option<(usize, [Extents; 2])> {
    let grid = Grid::new(extents, items.len());
    let bins = if items.len() < MANY {
        fill(items, &grid)
    } else {
        let parts = items.par_chunks(CHUNK).map(|part| fill(part, &grid));
        parts.reduce(|| [[EMPTY; BINS]; WAYS], |a, b| both(a, &b))
    };
    let (way, last) = cheapest(&bins, &grid)?;
    let is_left = |item: &Item| if way == BY_SIZE { grid.size(item) <= last } else { grid.place(item)[way] <= last };
    let (mut left, mut right) = (Extents::EMPTY, Extents::EMPTY);
    let (mut start, mut end) = (0, items.len());
    while start < end {
        let item = items[start];
        if is_left(&item) {
            left.join(&item);
            start += 1;
        } else {
            right.join(&item);
            end -= 1;
            items.swap(start, end);
        }
    }
    Some((start, [left, right]))
}

/// Of all ways to cut two to four items: the least surface of both parts, of the whole's, and a mask of those on the left.
pub(super) fn few(items: &[Item], extents: &Extents) -> (f32, u32) {
    let inverse = 1.0 / extents.bounds.extent().max_element();
    let whole = extents.bounds.half_area(inverse);
    // A line, a point, or what is too small to tell.
    if !(inverse.is_finite() && whole > 0.0) {
        return (1.0, 1);
    }
    let mut best = (f32::INFINITY, 1);
    // The last item is always on the right, so that each way is tried once.
    for left in 1..1_u32 << (items.len() - 1) {
        let mut sides = [Bounds::EMPTY; 2];
        items.iter().enumerate().for_each(|(i, item)| item.joins(&mut sides[usize::from(left >> i & 1 == 0)]));
        let parts = (sides[0].half_area(inverse) + sides[1].half_area(inverse)) / whole;
        if parts < best.0 {
            best = (parts, left);
        }
    }
    // 0 stands for a cut that must be.
    (best.0.max(f32::MIN_POSITIVE), best.1)
}

/// Brings those of a mask to the left; returned is how many they are.
pub(super) fn gather(items: &mut [Item], mask: u32) -> usize {
    let mut at = 0;
    for i in 0..items.len() {
        if mask >> i & 1 == 1 {
            items.swap(i, at);
            at += 1;
        }
    }
    at
}

/// Halves across the longest side of the middles; whole leaves to the left, so that halving ends as early as it can.
pub(super) fn halve(items: &mut [Item], extents: &Extents) -> (usize, [Extents; 2]) {
    let left = (items.len() / 2).next_multiple_of(LEAF_SIZE as usize).min(items.len() - 1);
    let extent = extents.middles.extent();
    if extent.max_element() > 0.0 {
        let axis = extent.max_position();
        items.select_nth_unstable_by(left, |a, b| {
            a.middle()[axis].total_cmp(&b.middle()[axis]).then(a.number().cmp(&b.number()))
        });
    }
    (left, sides(items, left))
}

/// The extents of what lies before a place, and of the rest.
pub(super) fn sides(items: &[Item], at: usize) -> [Extents; 2] {
    let of = |items: &[Item]| {
        if items.len() < MANY {
            return Extents::of(items);
        }
        items.par_chunks(CHUNK).map(Extents::of).reduce(|| Extents::EMPTY, |a, b| a.with(&b))
    };
    let (left, right) = items.split_at(at);
    [of(left), of(right)]
}

pub(super) fn all(items: &[Item]) -> Extents {
    sides(items, items.len())[0]
}
