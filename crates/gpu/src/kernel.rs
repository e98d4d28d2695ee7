//! Which files make a kernel: a tier, a query and what the scene holds are each a choice of files.

use rayproof_scene::bvh::Tier;

use crate::link::Linked;

/// What a scene holds: a kernel knows of nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contents {
    /// Triangles only.
    Triangles,
    /// Spheres only.
    Spheres,
    /// Both.
    Both,
}

impl Contents {
    /// Every choice.
    pub const ALL: [Self; 3] = [Self::Triangles, Self::Spheres, Self::Both];

    pub(crate) const fn triangles(self) -> bool {
        matches!(self, Self::Triangles | Self::Both)
    }

    pub(crate) const fn spheres(self) -> bool {
        matches!(self, Self::Spheres | Self::Both)
    }
}

/// What is asked of each ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Query {
    /// The closest hit.
    Closest,
    /// Whether there is one.
    Any,
}

impl Query {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Closest, Self::Any];

    /// The kernel's entry point.
    #[must_use]
    pub const fn entry(self) -> &'static str {
        match self {
            Self::Closest => "closest",
            Self::Any => "any_hit",
        }
    }

    /// Bytes of an answer.
    pub(crate) const fn answer_size(self) -> u64 {
        match self {
            Self::Closest => 16,
            Self::Any => 4,
        }
    }
}

/// One kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// The formulas.
    pub tier: Tier,
    /// The question.
    pub query: Query,
    /// The scene's kinds of primitive.
    pub contents: Contents,
}

macro_rules! shaders {
    ($linked:expr, $($path:literal),+ $(,)?) => {{
        $($linked.add(concat!("shaders/", $path), include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders/", $path)));)+
    }};
}
pub(crate) use shaders;

impl Kernel {
    /// The kernel's text: its files, and `scene`, the accessors of the scene's lists and the size of the stack.
    #[must_use]
    pub fn link(&self, scene: &str) -> Linked {
        let mut linked = Linked::default();
        shaders!(linked, "math.wgsl", "batch.wgsl", "bvh/slab.wgsl", "bvh/traverse.wgsl", "leaf/merge.wgsl");
        match self.query {
            Query::Closest => shaders!(linked, "query/closest.wgsl"),
            Query::Any => shaders!(linked, "query/any.wgsl"),
        }
        match self.tier {
            Tier::Classic => shaders!(linked, "classic/ray.wgsl"),
            Tier::Fast | Tier::Exact => shaders!(linked, "fast/ray.wgsl"),
        }
        if self.contents.triangles() {
            shaders!(linked, "leaf/triangles.wgsl");
            match self.tier {
                Tier::Classic => shaders!(linked, "classic/triangle.wgsl"),
                Tier::Fast | Tier::Exact => shaders!(linked, "fast/triangle.wgsl"),
            }
        }
        if self.contents.spheres() {
            shaders!(linked, "leaf/spheres.wgsl");
            match self.tier {
                Tier::Classic => shaders!(linked, "classic/sphere.wgsl"),
                Tier::Fast | Tier::Exact => shaders!(linked, "fast/sphere.wgsl"),
            }
        }
        match self.contents {
            Contents::Triangles => shaders!(linked, "leaf/only_triangles.wgsl"),
            Contents::Spheres => shaders!(linked, "leaf/only_spheres.wgsl"),
            Contents::Both => shaders!(linked, "leaf/both.wgsl"),
        }
        linked.add("(the host's accessors)", scene);
        linked
    }
}
