//! No tree is deeper than a stack may be: what a search for near neighbours makes a chain of is divided in halves.
//!
//! Among copies, or shapes one inside the other, each merge takes one more primitive, and the tree is as deep as they are many: five
//! hundred triangles at one place take a driver's compiler a minute for the stack that the kernel then declares.

use glam::Vec3;
use obvhs::bvh2::Bvh2;

use super::{LEAF_SIZE, union};

/// How deep a leaf may lie. Those of a million triangles lie some 32 deep, and halves of 2^32 primitives no deeper.
pub(super) const DEEPEST: u32 = 48;

/// How much lies under a node.
#[derive(Clone, Copy, Default)]
struct Under {
    height: u32,
    primitives: usize,
}

/// Divides anew what lies too deep: as far down as there is still room for halves, so that all above stays as it was.
pub(super) fn balance(binary: &mut Bvh2, boxes: &[[Vec3; 2]]) {
    let under = under(binary);
    if under.first().is_none_or(|root| root.height <= DEEPEST) {
        return;
    }
    let mut work = vec![(0, 0)];
    while let Some((index, depth)) = work.pop() {
        let Under { height, primitives } = under[index];
        if depth + height <= DEEPEST {
            continue;
        }
        let first = binary.nodes[index].first_index as usize;
        let room = DEEPEST - depth;
        // The children have a level less.
        let fits = |child: usize| halvings(under[child].primitives) < room;
        if fits(first) && fits(first + 1) {
            work.extend([(first, depth + 1), (first + 1, depth + 1)]);
        } else {
            debug_assert!(halvings(primitives) <= room, "{primitives} primitives in {room} levels");
            halve(binary, index, boxes);
        }
    }
}

/// How often so many primitives are halved until each part is a leaf.
const fn halvings(primitives: usize) -> u32 {
    primitives.div_ceil(LEAF_SIZE as usize).next_power_of_two().ilog2()
}

fn under(binary: &Bvh2) -> Vec<Under> {
    let mut under = vec![Under::default(); binary.nodes.len()];
    let mut work = vec![(0, false)];
    while let Some((index, children_done)) = work.pop() {
        let node = &binary.nodes[index];
        let first = node.first_index as usize;
        if node.is_leaf() {
            under[index].primitives = node.prim_count as usize;
        } else if children_done {
            let [a, b] = [under[first], under[first + 1]];
            under[index] = Under { height: 1 + a.height.max(b.height), primitives: a.primitives + b.primitives };
        } else {
            work.extend([(index, true), (first, false), (first + 1, false)]);
        }
    }
    under
}

/// The primitives under a node, in the order of its leaves.
fn primitives(binary: &Bvh2, index: usize) -> Vec<u32> {
    let (mut found, mut work) = (Vec::new(), vec![index]);
    while let Some(index) = work.pop() {
        let node = &binary.nodes[index];
        let first = node.first_index as usize;
        if node.is_leaf() {
            found.extend_from_slice(&binary.primitive_indices[first..first + node.prim_count as usize]);
        } else {
            work.extend([first + 1, first]);
        }
    }
    found
}

/// Replaces what is under a node by halves of halves, each cut across the longest side of its middles.
fn halve(binary: &mut Bvh2, index: usize, boxes: &[[Vec3; 2]]) {
    let middle = |id: u32| {
        let [low, high] = boxes[id as usize];
        low / 2.0 + high / 2.0
    };
    let all = primitives(binary, index);
    let start = binary.primitive_indices.len();
    binary.primitive_indices.extend(&all);
    let mut work = vec![(index, start, all.len())];
    while let Some((index, start, count)) = work.pop() {
        let word = |i: usize| u32::try_from(i).expect("the tree is numbered in 32 bits");
        let ids = &mut binary.primitive_indices[start..start + count];
        if count <= LEAF_SIZE as usize {
            (binary.nodes[index].prim_count, binary.nodes[index].first_index) = (word(count), word(start));
            continue;
        }
        let [low, high] = union(ids.iter().map(|&id| [middle(id); 2]));
        let axis = (high - low).max_position();
        // Whole leaves to the left, so that halving ends as early as it can.
        let left = (count / 2).next_multiple_of(LEAF_SIZE as usize).min(count - 1);
        ids.select_nth_unstable_by(left, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b)));
        let children = binary.nodes.len();
        let node = binary.nodes[index];
        binary.nodes.extend([node, node]);
        (binary.nodes[index].prim_count, binary.nodes[index].first_index) = (0, word(children));
        work.extend([(children, start, left), (children + 1, start + left, count - left)]);
    }
}
