//! The hard-case families: scenes and rays made to break an intersector, each in one way that it can name.
//!
//! A [`Family`] turns a seed into [`Case`]s; [`all`] lists the 42 of them. A share of every batch is aimed at
//! vertices, edges and tangents, exactly so where f32 allows it: random rays never find a leak. No answers are kept
//! here; the oracle gives them. Every scene and ray is valid by the contract, [`invalid_rays`], [`invalid_spheres`]
//! and [`invalid_triangles`] apart.

mod aim;
mod batches;
mod bisect;
mod draw;
mod field;
pub mod meshes;
mod special;
mod sphere_exact;
mod sphere_near;
mod sphere_range;
mod sphere_tangent;
mod table;
#[cfg(test)]
mod tests;
mod traversal;
mod triangle_order;
mod triangle_ray;
mod triangle_shape;
mod triangle_shared;

use rayproof_scene::{Ray, Scene};

pub use draw::Draw;

pub use batches::{BATCH_SIZES, batch, batch_answer};
pub use special::{invalid_rays, invalid_spheres, invalid_triangles};

/// A small scene and the rays aimed at it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The scene: at most some 2,000 primitives, so that brute force over it stays possible.
    pub scene: Scene,
    /// The rays, all valid.
    pub rays: Vec<Ray>,
}

/// Hard cases that stress one thing.
#[derive(Debug)]
pub struct Family {
    /// 1 to 42.
    pub number: u32,
    /// Two or three words.
    pub name: &'static str,
    /// What goes wrong here, in one sentence.
    pub stresses: &'static str,
    plan: Plan,
}

/// Makes one scene of a variant (below the plan's number of them) and exactly so many rays.
type Make = fn(&mut Draw, usize, usize) -> Case;

#[derive(Debug)]
enum Plan {
    /// Scenes drawn one by one, the variants in turn.
    Each { variants: usize, make: Make },
    /// All variants of a round from the same draws: they differ in the variant alone.
    Twins { variants: usize, make: Make },
    /// Each variant in one scene, however many rays: they hold recorded ones, which must fit.
    Once { variants: usize, make: Make },
    /// Batches of given sizes.
    Batches,
}

/// How many rays a scene gets before there are more scenes.
const RAYS_A_SCENE: usize = 256;
/// How many scenes one call makes at most.
const MOST_SCENES: usize = 40;

impl Family {
    /// About `rays` rays over at most 40 scenes, the same for the same seed; never more than `rays`.
    ///
    /// Scenes take the family's variants (the nominal magnitudes) in turn, and each variant has a scene as soon as
    /// there are rays enough. The six cases of a round of family 36 hold the same rays, in the same order. From 8,424
    /// rays on, family 41 holds every recorded ray.
    #[must_use]
    pub fn cases(&self, seed: u64, rays: usize) -> Vec<Case> {
        let (variants, make) = match self.plan {
            Plan::Each { variants, make } | Plan::Once { variants, make } | Plan::Twins { variants, make } => {
                (variants, make)
            }
            Plan::Batches => return batches::cases(rays),
        };
        let twins = matches!(self.plan, Plan::Twins { .. });
        let most = if matches!(self.plan, Plan::Once { .. }) { 1 } else { MOST_SCENES / variants };
        let rounds = (rays / (RAYS_A_SCENE * variants)).clamp(1, most);
        let scenes = (rounds * variants).min(rays);
        let scene = |i: usize| {
            let stream = if twins { i / variants } else { i };
            let more = usize::from(!twins && i < rays % scenes);
            make(&mut Draw::new(seed, self.number, stream as u64), i % variants, rays / scenes + more)
        };
        (0..scenes).map(scene).collect()
    }
}

/// The 42 families, in the order of their numbers.
#[must_use]
pub fn all() -> &'static [Family] {
    &table::ALL
}
