use rayproof_scene::{Kind, Kinds, Precision, Scene, Sphere};

use crate::{EightBoxes, Node, Originals, PackedTriangle, build, node, pack};

/// A scene made ready for traversal: the tree, and its primitives in leaf order.
///
/// Coordinates are those of the scene times `2^scale_exponent` (exact; see [`Bvh::new`]). Its nodes have four children, as every
/// device walks them, or [eight](EightBoxes).
#[derive(Clone, Debug)]
pub struct Bvh<N = Node> {
    /// The nodes; the root is the first. A scene without primitives has a root of empty children.
    pub nodes: Vec<N>,
    /// The triangles that leaves name, with their flat numbers.
    pub triangles: Vec<PackedTriangle>,
    /// The spheres that leaves name.
    pub spheres: Vec<Sphere>,
    /// The flat number of each of `spheres`.
    pub sphere_ids: Vec<u32>,
    /// The scene was multiplied by two to this.
    pub scale_exponent: i32,
    /// A power of two that no coordinate of a box exceeds in magnitude, after scaling.
    pub size: f32,
    /// How many entries a traversal's stack can come to hold.
    pub stack_depth: usize,
    /// Whether scaling cost no bit and every number but zero is in the range for which the precision `exact` has bounds in
    /// `f32`: from `2^-100` up, boxes within `2^25`.
    pub plain: bool,
    /// Whether it is plain and every triangle and sphere is of no extent or of at least `2^-33`: then single precision does not
    /// miss the subnormals where a device takes them for 0.
    pub roomy: bool,
    /// The primitives as they were, in the order of `triangles` and `spheres`, where scaling cost a bit.
    pub originals: Option<Originals>,
}

/// Whether a scene's coordinates are scaled before they are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scaling {
    /// As they are, for the formulas by the book; but down to `2^100`, beyond which boxes could not be decoded.
    None,
    /// By a power of two that brings the largest coordinate between `2^-20` and `2^20`, so that products of three
    /// lengths neither overflow nor underflow; less where a small coordinate would lose bits or a small primitive its
    /// square. Exact up to coordinates of `2^100`.
    PowerOfTwo,
}

impl Scaling {
    /// How a tree for a precision is scaled.
    #[must_use]
    pub const fn of(precision: Precision) -> Self {
        match precision {
            Precision::Textbook | Precision::Classic => Self::None,
            Precision::Fast | Precision::Pair | Precision::Double | Precision::Exact => Self::PowerOfTwo,
        }
    }
}

impl Bvh {
    /// Builds the tree over all primitives, triangles and spheres together, on all cores.
    ///
    /// # Errors
    /// When the scene has more than 2^28 - 2 primitives of a kind, or 2^32 - 2 in all: what a child can name.
    pub fn new(scene: &Scene, scaling: Scaling) -> Result<Self, TooLarge> {
        Ok(build::tree(packed(scene, scaling)?, Node::new))
    }
}

impl Bvh<EightBoxes> {
    /// As [`Bvh::new`], with eight children a node.
    ///
    /// # Errors
    /// Where [`Bvh::new`] fails.
    pub fn eight(scene: &Scene, scaling: Scaling) -> Result<Self, TooLarge> {
        Ok(build::tree(packed(scene, scaling)?, EightBoxes::new))
    }
}

fn packed(scene: &Scene, scaling: Scaling) -> Result<pack::Packed, TooLarge> {
    let primitives = scene.len();
    let too_many = |kind| scene.count(kind) >= node::MAX_FIRST;
    if primitives >= u32::MAX as usize || Kind::ALL.into_iter().any(too_many) {
        return Err(TooLarge { primitives });
    }
    Ok(pack::Packed::new(scene, scaling))
}

impl<N> Bvh<N> {
    /// How many primitives of a kind the leaves hold.
    #[must_use]
    pub const fn count(&self, kind: Kind) -> usize {
        match kind {
            Kind::Triangle => self.triangles.len(),
            Kind::Sphere => self.spheres.len(),
        }
    }

    /// The kinds of primitive that the leaves hold; triangles where there is nothing at all.
    #[must_use]
    pub fn kinds(&self) -> Kinds {
        let held: Kinds = Kind::ALL.into_iter().filter(|&kind| self.count(kind) > 0).collect();
        if held == Kinds::default() { [Kind::Triangle].into_iter().collect() } else { held }
    }
}

/// A scene with more primitives than a tree can number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene has {primitives} primitives; a tree can hold up to 268,435,454 of a kind")]
pub struct TooLarge {
    /// How many primitives the scene has.
    pub primitives: usize,
}
