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

/// Groups of fewer than this are each built by one core.
const MANY: usize = 1 << 12;

/// What a slot of a node names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Below {
    Nothing,
    /// The node so many places after this one.
    Node(u32),
    /// `count` items from `first` on, of one kind.
    Leaf {
        first: u32,
        count: u32,
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
    if items.is_empty() {
        return vec![Wide { slots: [NOTHING; N] }];
    }
    let extents = split::all(items);
    let mut nodes: Vec<Wide<N>> = Vec::new();
    // Level by level while groups are large; the others wait, each with the slot that it is for.
    let mut level = vec![(Group::new(items, 0, extents, DEEPEST, kind), None)];
    let mut waiting: Vec<(Group<'_>, (usize, usize))> = Vec::new();
    while !level.is_empty() {
        let opened: Vec<_> = level.into_par_iter().map(|(group, slot)| (open::<N>(group, kind), slot)).collect();
        level = Vec::new();
        for (groups, slot) in opened {
            let at = nodes.len();
            nodes.push(node_of(&groups));
            link(&mut nodes, slot, at);
            for (i, group) in groups.into_iter().enumerate().filter(|(_, group)| group.leaf().is_none()) {
                if group.items.len() < MANY {
                    waiting.push((group, (at, i)));
                } else {
                    level.push((group, Some((at, i))));
                }
            }
        }
    }
    let alone = |(group, slot): (Group<'_>, _)| {
        let mut below = Vec::new();
        grow(group, kind, &mut below);
        (below, slot)
    };
    let built: Vec<_> = waiting.into_par_iter().map(alone).collect();
    nodes.reserve_exact(built.iter().map(|(below, _)| below.len()).sum());
    for (below, slot) in built {
        let at = nodes.len();
        link(&mut nodes, Some(slot), at);
        nodes.extend_from_slice(&below);
    }
    nodes
}

/// The node of groups, of which the leaves are named.
fn node_of<const N: usize>(groups: &[Group<'_>]) -> Wide<N> {
    let mut slots = [NOTHING; N];
    for (slot, group) in slots.iter_mut().zip(groups) {
        // What is no leaf is linked once its place is known.
        let below = group.leaf().unwrap_or(Below::Node(0));
        *slot = Slot { bounds: group.extents.bounds.corners(), below };
    }
    Wide { slots }
}

/// Names the node at a place as what is below a slot of a node before it.
fn link<const N: usize>(nodes: &mut [Wide<N>], slot: Option<(usize, usize)>, at: usize) {
    if let Some((node, slot)) = slot {
        nodes[node].slots[slot].below = Below::Node(number(at - node));
    }
}

fn number(place: usize) -> u32 {
    u32::try_from(place).expect("there are fewer nodes than primitives, and those are numbered in 32 bits")
}

/// Appends the node of a group and all below it.
fn grow<const N: usize>(group: Group<'_>, kind: &impl Fn(u32) -> usize, nodes: &mut Vec<Wide<N>>) {
    let groups = open::<N>(group, kind);
    let at = nodes.len();
    nodes.push(node_of(&groups));
    for (i, group) in groups.into_iter().enumerate().filter(|(_, group)| group.leaf().is_none()) {
        let below = nodes.len();
        link(nodes, Some((at, i)), below);
        grow(group, kind, nodes);
    }
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
        (self.parts >= WITHOUT).then(|| Below::Leaf { first: number(self.first), count: number(self.items.len()) })
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
