use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ploc::{PlocSearchDistance, SortPrecision};
use obvhs::{Boundable, BvhBuildParams};
use rayon::prelude::*;
use rayproof_scene::Kind;

mod balance;

use self::balance::balance;
use crate::node::{Child, EMPTY, Node};
use crate::pack::Packed;
use crate::{Bvh, Originals};

/// The most primitives a leaf holds: what two bits count.
const LEAF_SIZE: u32 = 4;

/// What a slot of the tree under construction stands for.
#[derive(Clone, Copy)]
enum Slot {
    /// A node of the binary tree.
    Binary(usize),
    /// The primitives of one kind in a leaf of the binary tree.
    Leaf(Child),
}

struct Builder {
    packed: Packed,
    binary: Bvh2,
    /// The exact box of every binary node.
    boxes: Vec<[Vec3; 2]>,
    bvh: Bvh,
}

/// Builds the binary tree, collapses it to four children a node, and puts primitives in leaf order.
pub(crate) fn build(packed: Packed) -> Bvh {
    let bvh = Bvh {
        nodes: Vec::new(),
        triangles: Vec::with_capacity(packed.triangles.len()),
        spheres: Vec::with_capacity(packed.spheres.len()),
        sphere_ids: Vec::with_capacity(packed.spheres.len()),
        scale_exponent: packed.scale_exponent,
        size: packed.size,
        stack_depth: 0,
        plain: packed.plain,
        roomy: packed.roomy,
        originals: packed.originals.as_ref().map(|_| Originals::default()),
    };
    if Kind::ALL.into_iter().all(|kind| packed.count(kind) == 0) {
        return Bvh { nodes: vec![Node::new(&[], [EMPTY; 4])], ..bvh };
    }
    let boxes: Vec<[Vec3; 2]> = Kind::ALL
        .into_iter()
        .flat_map(|kind| (0..packed.count(kind)).into_par_iter().map(|i| packed.bounds(kind, i)).collect::<Vec<_>>())
        .collect();
    let mut binary = binary_tree(&boxes, packed.size);
    balance(&mut binary, &boxes);
    let boxes = binary_boxes(&binary, &boxes);
    let mut builder = Builder { packed, binary, boxes, bvh };
    builder.collapse();
    builder.bvh
}

/// A box for `obvhs`, which wants numbers whose products it can form.
struct Bounded(Aabb);

impl Boundable for Bounded {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

fn binary_tree(boxes: &[[Vec3; 2]], size: f32) -> Bvh2 {
    // Topology alone is taken from this tree: rounding here cannot lose a hit.
    let unit = |v: Vec3| Vec3A::from(v) / size;
    let bounded: Vec<Bounded> = boxes.par_iter().map(|b| Bounded(Aabb::new(unit(b[0]), unit(b[1])))).collect();
    let parameters = BvhBuildParams {
        pre_split: false,
        ploc_search_distance: PlocSearchDistance::Medium,
        search_depth_threshold: 2,
        reinsertion_batch_ratio: 0.05,
        post_collapse_reinsertion_batch_ratio_multiplier: 1.0,
        sort_precision: SortPrecision::U64,
        max_prims_per_leaf: LEAF_SIZE,
        // Four triangles cost the CPU no more than one.
        collapse_traversal_cost: 3.0,
    };
    build_bvh2(&bounded, parameters, &mut std::time::Duration::default())
}

/// The exact box of every node of the binary tree, children before parents.
fn binary_boxes(binary: &Bvh2, primitives: &[[Vec3; 2]]) -> Vec<[Vec3; 2]> {
    let mut boxes = vec![[Vec3::ZERO; 2]; binary.nodes.len()];
    let mut stack = vec![(0, false)];
    while let Some((index, children_done)) = stack.pop() {
        let node = &binary.nodes[index];
        let first = node.first_index as usize;
        if node.is_leaf() {
            let ids = &binary.primitive_indices[first..first + node.prim_count as usize];
            boxes[index] = union(ids.iter().map(|&id| primitives[id as usize]));
        } else if children_done {
            boxes[index] = union([boxes[first], boxes[first + 1]].into_iter());
        } else {
            stack.extend([(index, true), (first, false), (first + 1, false)]);
        }
    }
    boxes
}

fn union(boxes: impl Iterator<Item = [Vec3; 2]>) -> [Vec3; 2] {
    boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([Vec3::ZERO; 2])
}

fn half_area(b: [Vec3; 2]) -> f64 {
    let d = (b[1].as_dvec3() - b[0].as_dvec3()).max(glam::DVec3::ZERO);
    d.x * d.y + d.y * d.z + d.z * d.x
}

impl Builder {
    /// Emits nodes depth first: a node, then the subtrees of its children.
    fn collapse(&mut self) {
        // A node to fill: its index, what it gathers, and how many stack entries its ancestors leave behind.
        let mut work = vec![(self.reserve(), self.gather(Slot::Binary(0)), 0)];
        while let Some((index, slots, depth)) = work.pop() {
            let depth = depth + slots.len() - 1;
            self.bvh.stack_depth = self.bvh.stack_depth.max(depth);
            let boxes: Vec<[Vec3; 2]> = slots.iter().map(|&(_, b)| b).collect();
            let mut children = [EMPTY; 4];
            for (word, (slot, _)) in children.iter_mut().zip(slots) {
                *word = match slot {
                    Slot::Leaf(leaf) => self.emit(leaf).word(),
                    Slot::Binary(_) => {
                        let child = self.reserve();
                        work.push((child, self.gather(slot), depth));
                        Child::Node(child).word()
                    }
                };
            }
            self.bvh.nodes[index] = Node::new(&boxes, children);
        }
    }

    fn reserve(&mut self) -> usize {
        self.bvh.nodes.push(Node::new(&[], [EMPTY; 4]));
        self.bvh.nodes.len() - 1
    }

    /// The up to four slots under one, smallest first: the largest that can be opened is, until there are four.
    fn gather(&mut self, slot: Slot) -> Vec<(Slot, [Vec3; 2])> {
        let mut slots = self.open(slot);
        while slots.len() < 4 {
            let widest = (0..slots.len())
                .filter(|&i| matches!(slots[i].0, Slot::Binary(_)))
                .max_by(|&i, &j| half_area(slots[i].1).total_cmp(&half_area(slots[j].1)));
            let Some(i) = widest else { break };
            let opened = self.open(slots[i].0);
            if slots.len() - 1 + opened.len() > 4 {
                break;
            }
            slots.splice(i..=i, opened);
        }
        // Slots decide between children entered at the same distance, as many are at a wall: the smaller is the likelier to
        // hold the hit. It halves the nodes visited in a hall.
        slots.sort_by(|a, b| half_area(a.1).total_cmp(&half_area(b.1)));
        slots
    }

    /// What lies directly under a slot: two binary nodes, or a leaf's triangles and spheres.
    fn open(&mut self, slot: Slot) -> Vec<(Slot, [Vec3; 2])> {
        let Slot::Binary(index) = slot else { return vec![] };
        let node = &self.binary.nodes[index];
        let first = node.first_index as usize;
        if !node.is_leaf() {
            return [first, first + 1].into_iter().map(|i| self.slot(i)).collect();
        }
        self.split_leaf(first, node.prim_count as usize)
    }

    /// A binary node as a slot; a leaf of one kind is named at once.
    fn slot(&mut self, index: usize) -> (Slot, [Vec3; 2]) {
        let node = &self.binary.nodes[index];
        if node.is_leaf() {
            let mut parts = self.split_leaf(node.first_index as usize, node.prim_count as usize);
            if parts.len() == 1 {
                return parts.remove(0);
            }
        }
        (Slot::Binary(index), self.boxes[index])
    }

    /// A binary leaf's primitives kind by kind, each with their box. `first` still counts in the binary tree's order.
    fn split_leaf(&mut self, first: usize, count: usize) -> Vec<(Slot, [Vec3; 2])> {
        // Kinds apart, each in the order of flat numbers.
        self.binary.primitive_indices[first..first + count].sort_unstable();
        let ids = &self.binary.primitive_indices[first..first + count];
        let mut parts = Vec::with_capacity(Kind::ALL.len());
        let mut at = 0;
        for kind in Kind::ALL {
            let start = self.packed.start(kind);
            let end = ids.partition_point(|&id| (id as usize) < start + self.packed.count(kind));
            if at < end {
                let b = union(ids[at..end].iter().map(|&id| self.packed.bounds(kind, id as usize - start)));
                parts.push((Slot::Leaf(Child::Leaf { kind, first: first + at, count: end - at }), b));
                at = end;
            }
        }
        parts
    }

    /// Puts a leaf's primitives next in order and names the leaf by where they went.
    fn emit(&mut self, leaf: Child) -> Child {
        let Child::Leaf { kind, first, count } = leaf else { return leaf };
        let (at, start) = (self.bvh.count(kind), self.packed.start(kind));
        for &id in &self.binary.primitive_indices[first..first + count] {
            self.packed.hand_over(kind, id as usize - start, &mut self.bvh);
        }
        Child::Leaf { kind, first: at, count }
    }
}

#[cfg(test)]
mod tests;
