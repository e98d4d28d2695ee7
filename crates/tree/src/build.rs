//! A tree of so many children a node, with its primitives in the order of the leaves.

use glam::Vec3;
use rayon::prelude::*;
use rayproof_scene::Kind;

use crate::node::{Child, EMPTY};
use crate::pack::Packed;
use crate::topology::{Below, Item, Slot, Wide, build};
use crate::{Bvh, Originals};

/// Builds the tree, and puts primitives in leaf order; `make` makes a node of its children's boxes and words.
pub(crate) fn tree<const N: usize, Node: Send>(
    packed: Packed,
    make: impl Fn(&[[Vec3; 2]], [u32; N]) -> Node + Sync,
) -> Bvh<Node> {
    let mut items = items(&packed);
    let kind = |number: u32| packed.kind(number as usize) as usize;
    let wide: Vec<Wide<N>> = build(&mut items, &kind);
    let stack_depth = stack_depth(&wide);
    let places = Places::of(&items, &packed);
    let node = |(at, node): (usize, &Wide<N>)| {
        let (boxes, words) = named(at, node, &items, &places, &packed);
        make(&boxes[..node.children().len()], words)
    };
    let nodes = wide.par_iter().enumerate().map(node).collect();
    let order = |kind: Kind| -> Vec<usize> {
        let start = packed.start(kind);
        let of_kind = |item: &&Item| packed.kind(item.number() as usize) == kind;
        items.iter().filter(of_kind).map(|item| item.number() as usize - start).collect()
    };
    let (triangles, spheres) = (order(Kind::Triangle), order(Kind::Sphere));
    Bvh {
        nodes,
        triangles: triangles.par_iter().map(|&i| packed.triangles[i]).collect(),
        spheres: spheres.iter().map(|&i| packed.spheres[i]).collect(),
        sphere_ids: spheres.iter().map(|&i| packed.sphere_ids[i]).collect(),
        scale_exponent: packed.scale_exponent,
        size: packed.size,
        stack_depth,
        plain: packed.plain,
        roomy: packed.roomy,
        originals: packed.originals.as_ref().map(|all| Originals {
            triangles: triangles.iter().map(|&i| all.triangles[i]).collect(),
            spheres: spheres.iter().map(|&i| all.spheres[i]).collect(),
        }),
    }
}

/// The primitives' boxes, numbered kind after kind.
fn items(packed: &Packed) -> Vec<Item> {
    let count: usize = Kind::ALL.into_iter().map(|kind| packed.count(kind)).sum();
    let item = |number: usize| {
        let kind = packed.kind(number);
        let bounds = packed.bounds(kind, number - packed.start(kind));
        Item::new(bounds, u32::try_from(number).expect("Bvh::new bounds the number of primitives"))
    };
    (0..count).into_par_iter().with_min_len(1 << 12).map(item).collect()
}

/// How many primitives of its kind lie before each place.
enum Places {
    /// There is one kind: as many as the place says.
    OneKind,
    Mixed(Vec<u32>),
}

impl Places {
    fn of(items: &[Item], packed: &Packed) -> Self {
        if Kind::ALL.into_iter().filter(|&kind| packed.count(kind) > 0).count() < 2 {
            return Self::OneKind;
        }
        let mut counts = [0; Kind::ALL.len()];
        let next = |item: &Item| {
            let count = &mut counts[packed.kind(item.number() as usize) as usize];
            *count += 1;
            *count - 1
        };
        Self::Mixed(items.iter().map(next).collect())
    }

    fn at(&self, place: usize) -> usize {
        match self {
            Self::OneKind => place,
            Self::Mixed(places) => places[place] as usize,
        }
    }
}

/// The boxes and the words of a node's children.
fn named<const N: usize>(
    at: usize,
    node: &Wide<N>,
    items: &[Item],
    places: &Places,
    packed: &Packed,
) -> ([[Vec3; 2]; N], [u32; N]) {
    let word = |slot: &Slot| match slot.below {
        Below::Nothing => EMPTY,
        Below::Node(after) => Child::Node(at + after as usize).word(),
        Below::Leaf { first, count } => {
            let kind = packed.kind(items[first as usize].number() as usize);
            Child::Leaf { kind, first: places.at(first as usize), count: count as usize }.word()
        }
    };
    (node.slots.map(|slot| slot.bounds), node.slots.each_ref().map(word))
}

/// How many entries a walk leaves behind at most: of each node above, all children but the one that it goes to.
fn stack_depth<const N: usize>(nodes: &[Wide<N>]) -> usize {
    let mut above = vec![0; nodes.len()];
    let mut deepest = 0;
    for (at, node) in nodes.iter().enumerate() {
        let left = above[at] + node.children().len().saturating_sub(1);
        deepest = deepest.max(left);
        for slot in node.children() {
            if let Below::Node(after) = slot.below {
                above[at + after as usize] = left;
            }
        }
    }
    deepest
}

#[cfg(test)]
mod tests;
