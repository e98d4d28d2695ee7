//! Which primitives lie together: a tree of up to `N` children a node, for every engine.
//!
//! A node's children are found by cutting the one with the largest surface in two until there are `N`. Work is linear in the
//! primitives a level, and no leaf lies deeper than [`DEEPEST`] cuts: where primitives at one place, or one inside the other, leave
//! the surface area no say or would make a chain, they are halved.

mod item;
mod split;

use glam::Vec3;
use rayon::prelude::*;

pub(crate) use self::item::Item;
use self::item::{Bounds, Extents};

/// The most primitives a leaf holds: what two bits count.
pub(crate) const LEAF_SIZE: u32 = 4;

/// How many cuts a leaf may lie below the root. Those of a million triangles lie some 32 deep, and halves of 2^32 primitives no
/// deeper.
pub(crate) const DEEPEST: u32 = 48;

/// From this many on, the children of a node are built side by side.
const MANY: usize = 1 << 12;

/// What a slot of a node names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Below {
    Nothing,
    /// The node so many places after this one.
    Node(usize),
    /// `count` items from `first` on, of one kind.
    Leaf {
        first: usize,
        count: usize,
    },
}

/// A child, and the box of all below it, `[low, high]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot {
    pub(crate) bounds: [Vec3; 2],
    pub(crate) below: Below,
}

const NOTHING: Slot = Slot { bounds: [Vec3::ZERO; 2], below: Below::Nothing };

/// A node: its children, those of least volume first. Slots decide between children entered at the same distance, as many are at a
/// wall: the wall itself, flat, is the likeliest to hold the hit, and then the smaller.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide<const N: usize> {
    pub(crate) slots: [Slot; N],
}

impl<const N: usize> Wide<N> {
    pub(crate) fn children(&self) -> &[Slot] {
        let count = self.slots.iter().take_while(|slot| slot.below != Below::Nothing).count();
        &self.slots[..count]
    }
}

/// A few primitives are cut further where their parts have less than this of their surface: in a node that has room for both parts,
/// and where it takes another node.
const WITH_ROOM: f32 = 0.9;
const WITHOUT: f32 = 0.5;

/// A group of primitives under construction.
struct Group<'a> {
    items: &'a mut [Item],
    /// The place of the first among all.
    first: usize,
    extents: Extents,
    /// How many cuts may still lie below.
    cuts: u32,
    /// The surface of the parts that a few are cut into, at the least, of their own: what a cut saves. 0 where it must be cut.
    parts: f32,
}

/// Builds the tree over items, and puts them in the order of its leaves; `kind` tells a primitive's by its number. The root is the
/// first node, and children come after their parents.
pub(crate) fn build<const N: usize>(items: &mut [Item], kind: &(impl Fn(u32) -> usize + Sync)) -> Vec<Wide<N>> {
    let extents = split::all(items);
    let mut nodes = Vec::with_capacity(items.len() / 4 + 1);
    if items.is_empty() {
        nodes.push(Wide { slots: [NOTHING; N] });
    } else {
        grow(Group::new(items, 0, extents, DEEPEST, kind), kind, &mut nodes);
    }
    nodes
}

/// Appends the node of a group and all below it.
fn grow<const N: usize>(group: Group<'_>, kind: &(impl Fn(u32) -> usize + Sync), nodes: &mut Vec<Wide<N>>) {
    let is_large = group.items.len() >= MANY;
    let groups = open::<N>(group, kind);
    let at = nodes.len();
    let mut node = Wide { slots: [NOTHING; N] };
    nodes.push(node);
    let bounds: Vec<[Vec3; 2]> = groups.iter().map(|group| group.extents.bounds.corners()).collect();
    let mut add = |i: usize, below| node.slots[i] = Slot { bounds: bounds[i], below };
    if is_large {
        let below: Vec<Built<N>> = groups.into_par_iter().map(|group| alone(group, kind)).collect();
        for (i, below) in below.into_iter().enumerate() {
            match below {
                Built::Leaf(leaf) => add(i, leaf),
                Built::Nodes(below) => {
                    add(i, Below::Node(nodes.len() - at));
                    nodes.extend_from_slice(&below);
                }
            }
        }
    } else {
        for (i, group) in groups.into_iter().enumerate() {
            match group.leaf() {
                Some(leaf) => add(i, leaf),
                None => {
                    add(i, Below::Node(nodes.len() - at));
                    grow(group, kind, nodes);
                }
            }
        }
    }
    nodes[at] = node;
}

/// What was built beside others.
enum Built<const N: usize> {
    Leaf(Below),
    Nodes(Vec<Wide<N>>),
}

fn alone<const N: usize>(group: Group<'_>, kind: &(impl Fn(u32) -> usize + Sync)) -> Built<N> {
    if let Some(leaf) = group.leaf() {
        return Built::Leaf(leaf);
    }
    let mut nodes = Vec::with_capacity(group.items.len() / 4 + 1);
    grow(group, kind, &mut nodes);
    Built::Nodes(nodes)
}

/// The children of a group's node: the one with the largest surface is cut, until there are `N` or all are leaves.
fn open<'a, const N: usize>(group: Group<'a>, kind: &impl Fn(u32) -> usize) -> Vec<Group<'a>> {
    let mut groups = Vec::with_capacity(N);
    groups.push(group);
    while groups.len() < N {
        let area = |i: &usize| area(&groups[*i].extents.bounds);
        let can_be_cut = (0..groups.len()).filter(|&i| groups[i].parts < WITH_ROOM);
        let widest = can_be_cut.max_by(|i, j| area(i).total_cmp(&area(j)));
        let Some(i) = widest else { break };
        let [left, right] = groups.swap_remove(i).cut(kind);
        groups.extend([left, right]);
    }
    groups.sort_by(|a, b| {
        let [a, b] = [a, b].map(|group| group.extents.bounds);
        volume(&a).total_cmp(&volume(&b)).then(area(&a).total_cmp(&area(&b)))
    });
    groups
}

fn area(bounds: &Bounds) -> f64 {
    let [low, high] = bounds.corners().map(|corner| corner.as_dvec3());
    let d = high - low;
    d.x * d.y + d.y * d.z + d.z * d.x
}

fn volume(bounds: &Bounds) -> f64 {
    let d = bounds.extent().as_dvec3();
    d.x * d.y * d.z
}

impl<'a> Group<'a> {
    fn new(items: &'a mut [Item], first: usize, extents: Extents, cuts: u32, kind: &impl Fn(u32) -> usize) -> Self {
        let one_kind = || items.windows(2).all(|pair| kind(pair[0].number()) == kind(pair[1].number()));
        let parts = match items.len() {
            1 => 1.0,
            2..=4 if cuts > 0 && one_kind() => split::few(items, &extents).0,
            2..=4 if one_kind() => 1.0,
            _ => 0.0,
        };
        Self { items, first, extents, cuts, parts }
    }

    /// The leaf that it is, if a node of its own would be no gain.
    fn leaf(&self) -> Option<Below> {
        (self.parts >= WITHOUT).then_some(Below::Leaf { first: self.first, count: self.items.len() })
    }

    fn cut(self, kind: &impl Fn(u32) -> usize) -> [Self; 2] {
        let Self { items, first, extents, cuts, parts } = self;
        let (at, [left, right]) = if parts > 0.0 {
            let (_, left) = split::few(items, &extents);
            let at = split::gather(items, left);
            (at, split::sides(items, at))
        } else if items.len() <= LEAF_SIZE as usize {
            items.sort_unstable_by_key(|item| kind(item.number()));
            let at = items.partition_point(|item| kind(item.number()) == kind(items[0].number()));
            (at, split::sides(items, at))
        } else if cuts <= halvings(items.len()) {
            split::halve(items, &extents)
        } else {
            split::cut(items, &extents).unwrap_or_else(|| split::halve(items, &extents))
        };
        let (left_items, right_items) = items.split_at_mut(at);
        let cuts = cuts.saturating_sub(1);
        [Self::new(left_items, first, left, cuts, kind), Self::new(right_items, first + at, right, cuts, kind)]
    }
}

/// How often so many primitives are halved until each part is a leaf of one kind.
fn halvings(primitives: usize) -> u32 {
    primitives.div_ceil(LEAF_SIZE as usize).next_power_of_two().ilog2() + 1
}
