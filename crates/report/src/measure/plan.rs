//! How much is measured.

/// How many rays each part takes, and how often times are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The word in the report.
    pub mode: &'static str,
    /// What random numbers start from.
    pub seed: u64,
    /// Rays a family.
    pub family: usize,
    /// Rays a panel: both timed and judged.
    pub panel: usize,
    /// Rays a distance.
    pub distance: usize,
    /// Rays a primitive kind for the margins.
    pub margin: usize,
    /// Rays a mesh and target.
    pub leak: usize,
    /// Rays for each invariant.
    pub invariant: usize,
    /// Rays a scene and kind of rays, timed.
    pub scene: usize,
    /// Of those, rays judged.
    pub sample: usize,
    /// Triangles and spheres of the made scenes, about.
    pub primitives: u32,
    /// How often each time is taken.
    pub runs: u32,
}

impl Plan {
    /// About a minute on two cores.
    pub const QUICK: Self = Self {
        mode: "quick",
        seed: 20_261_125,
        family: 260,
        panel: 8192,
        distance: 256,
        margin: 8192,
        leak: 1000,
        invariant: 512,
        scene: 1 << 14,
        sample: 256,
        primitives: 20_000,
        runs: 20,
    };

    /// Some seven minutes on two cores, with peers.
    pub const FULL: Self = Self {
        mode: "full",
        family: 2_500,
        panel: 1 << 15,
        distance: 4096,
        margin: 1 << 17,
        leak: 20_000,
        invariant: 4096,
        scene: 1 << 17,
        sample: 1024,
        primitives: 70_000,
        runs: 40,
        ..Self::QUICK
    };
}

/// Where a report tells how far it is.
pub trait Progress {
    /// So many steps of that follow.
    fn stage(&mut self, name: &str, steps: usize);
    /// One is done.
    fn step(&mut self);
}

/// No one listens.
impl Progress for () {
    fn stage(&mut self, _: &str, _: usize) {}
    fn step(&mut self) {}
}
