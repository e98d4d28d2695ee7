//! Which files make a kernel: a precision, a query and what the scene holds are each a choice of files.

use rayproof_scene::Precision;

use crate::link::Linked;

macro_rules! shaders {
    ($linked:expr, $($path:literal),+ $(,)?) => {{
        $($linked.add(concat!("shaders/", $path), include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders/", $path)));)+
    }};
}
pub(crate) use shaders;

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
    /// How often the surface is crossed; only the precision `exact` counts.
    Count,
}

impl Query {
    /// Every choice.
    pub const ALL: [Self; 3] = [Self::Closest, Self::Any, Self::Count];

    /// Bytes of an answer.
    pub(crate) const fn answer_size(self) -> u64 {
        match self {
            Self::Closest => 16,
            Self::Any | Self::Count => 4,
        }
    }
}

/// The numbers that a kernel computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// `f32` that is IEEE.
    Single,
    /// `f32` by the written rules of Vulkan: bounds twice as wide.
    SingleByRule,
    /// `f64`.
    Double,
    /// Pairs of `f32`.
    PairOfF32,
    /// Pairs of `f64`.
    PairOfF64,
}

impl Width {
    /// Whether the device must have `f64`.
    #[must_use]
    pub const fn needs_f64(self) -> bool {
        matches!(self, Self::Double | Self::PairOfF64)
    }

    pub(crate) fn link(self, linked: &mut Linked) {
        match self {
            Self::Single => shaders!(
                linked,
                "exact/number/native.wgsl",
                "exact/number/single.wgsl",
                "exact/number/single_ieee.wgsl"
            ),
            Self::SingleByRule => shaders!(
                linked,
                "exact/number/native.wgsl",
                "exact/number/single.wgsl",
                "exact/number/single_by_rule.wgsl"
            ),
            Self::Double => shaders!(linked, "exact/number/native.wgsl", "exact/number/double.wgsl"),
            Self::PairOfF32 => shaders!(linked, "exact/number/pair.wgsl", "exact/number/pair_of_f32.wgsl"),
            Self::PairOfF64 => shaders!(linked, "exact/number/pair.wgsl", "exact/number/pair_of_f64.wgsl"),
        }
    }
}

/// A kernel's part in answering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// All of it, in a precision other than `exact`.
    Trace(Precision),
    /// The walk of every ray, with certificates.
    First(Width),
    /// The walk of the rays that were left open.
    Second(Width),
    /// The numbers of every hit.
    Round(Width),
    /// Those that were left open.
    RoundRest(Width),
}

impl Pass {
    /// Every pass of the precision `exact`, in every width.
    pub fn all_exact() -> impl Iterator<Item = Self> {
        let numbers = [Width::Double, Width::PairOfF32, Width::PairOfF64];
        let first = [Width::Single, Width::SingleByRule].map(Self::First);
        let rest = numbers.into_iter().flat_map(|w| [Self::Second(w), Self::Round(w), Self::RoundRest(w)]);
        first.into_iter().chain(rest)
    }

    /// Whether it takes only the rays that an earlier pass listed.
    pub(crate) const fn is_of_list(self) -> bool {
        matches!(self, Self::Second(_) | Self::RoundRest(_))
    }

    const fn rounds(self) -> bool {
        matches!(self, Self::Round(_) | Self::RoundRest(_))
    }
}

/// Which leaves a ray visits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Walk {
    /// Those whose boxes it meets.
    #[default]
    Tree,
    /// Every one: it tells what the formulas cost by themselves.
    Every,
}

/// One kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// Its part.
    pub pass: Pass,
    /// The question.
    pub query: Query,
    /// The scene's kinds of primitive.
    pub contents: Contents,
    /// The leaves that are visited.
    pub walk: Walk,
}

impl Kernel {
    /// Whether there is such a kernel: only the precision `exact` counts, and only closest hits have numbers to round.
    #[must_use]
    pub fn exists(&self) -> bool {
        match self.pass {
            Pass::Trace(precision) => precision != Precision::Exact && self.query != Query::Count,
            Pass::First(_) | Pass::Second(_) => true,
            Pass::Round(_) | Pass::RoundRest(_) => self.query == Query::Closest,
        }
    }

    /// The kernel's entry point.
    #[must_use]
    pub const fn entry(&self) -> &'static str {
        match (self.pass, self.query) {
            (Pass::Trace(_), Query::Closest) => "closest",
            (Pass::Trace(_), _) => "any_hit",
            (Pass::First(_), _) => "first",
            (Pass::Second(_), _) => "second",
            (Pass::Round(_), _) => "round_all",
            (Pass::RoundRest(_), _) => "round_rest",
        }
    }

    /// The kernel's text: its files, and `scene`, the accessors of the scene's lists and the size of the stack.
    #[must_use]
    pub fn link(&self, scene: &str) -> Linked {
        let mut linked = Linked::default();
        shaders!(linked, "math.wgsl", "batch.wgsl", "bvh/slab.wgsl", "leaf/word.wgsl");
        match self.pass {
            Pass::Trace(precision) => self.link_trace(&mut linked, precision),
            Pass::First(width) | Pass::Second(width) | Pass::Round(width) | Pass::RoundRest(width) => {
                width.link(&mut linked);
                self.link_exact(&mut linked);
            }
        }
        if !self.pass.rounds() {
            match self.walk {
                Walk::Tree => shaders!(linked, "bvh/traverse.wgsl"),
                Walk::Every => shaders!(linked, "bvh/every.wgsl"),
            }
            match self.contents {
                Contents::Triangles => shaders!(linked, "leaf/only_triangles.wgsl"),
                Contents::Spheres => shaders!(linked, "leaf/only_spheres.wgsl"),
                Contents::Both => shaders!(linked, "leaf/both.wgsl"),
            }
        }
        linked.add("(the host's accessors)", scene);
        linked
    }

    fn link_trace(&self, linked: &mut Linked, precision: Precision) {
        shaders!(linked, "leaf/single.wgsl");
        match self.query {
            Query::Closest => shaders!(linked, "query/closest.wgsl"),
            Query::Any | Query::Count => shaders!(linked, "query/any.wgsl"),
        }
        match precision {
            Precision::Textbook | Precision::Classic => shaders!(linked, "classic/ray.wgsl"),
            Precision::Fast | Precision::Pair | Precision::Double | Precision::Exact => {
                shaders!(linked, "fast/ray.wgsl")
            }
        }
        match precision {
            Precision::Pair => Width::PairOfF32.link(linked),
            Precision::Double => Width::Double.link(linked),
            Precision::Textbook | Precision::Classic | Precision::Fast | Precision::Exact => {}
        }
        if matches!(precision, Precision::Pair | Precision::Double) {
            shaders!(linked, "exact/vector.wgsl");
        }
        if self.contents.triangles() {
            shaders!(linked, "leaf/triangles.wgsl");
            match precision {
                Precision::Textbook | Precision::Classic => shaders!(linked, "classic/triangle.wgsl"),
                Precision::Pair | Precision::Double => shaders!(linked, "double/triangle.wgsl"),
                Precision::Fast | Precision::Exact => shaders!(linked, "fast/triangle.wgsl"),
            }
        }
        if self.contents.spheres() {
            shaders!(linked, "leaf/spheres.wgsl");
            match precision {
                Precision::Textbook => shaders!(linked, "textbook/sphere.wgsl"),
                Precision::Classic => shaders!(linked, "classic/sphere.wgsl"),
                Precision::Pair | Precision::Double => shaders!(linked, "double/sphere.wgsl"),
                Precision::Fast | Precision::Exact => shaders!(linked, "fast/sphere.wgsl"),
            }
        }
    }

    fn link_exact(&self, linked: &mut Linked) {
        shaders!(linked, "exact/vector.wgsl", "exact/line.wgsl", "exact/ray.wgsl", "exact/list.wgsl");
        if self.contents.triangles() {
            shaders!(linked, "exact/triangle.wgsl");
        }
        if self.contents.spheres() {
            shaders!(linked, "exact/sphere.wgsl");
        }
        if self.pass.rounds() {
            self.link_round(linked);
            return;
        }
        if self.contents.triangles() {
            shaders!(linked, "exact/leaf/triangles.wgsl");
        }
        if self.contents.spheres() {
            shaders!(linked, "exact/leaf/spheres.wgsl");
            if self.query == Query::Count {
                shaders!(linked, "exact/leaf/both_roots.wgsl");
            } else {
                shaders!(linked, "exact/leaf/first_root.wgsl");
            }
        }
        shaders!(linked, "exact/leaf/candidate.wgsl");
        match self.query {
            Query::Closest => shaders!(linked, "exact/query/closest.wgsl", "exact/leaf/nearest.wgsl"),
            Query::Any => shaders!(linked, "exact/query/any.wgsl", "exact/leaf/nearest.wgsl"),
            Query::Count => shaders!(linked, "exact/query/count.wgsl", "exact/leaf/crossings.wgsl"),
        }
        if matches!(self.pass, Pass::First(_)) {
            shaders!(linked, "exact/query/first.wgsl");
        } else {
            shaders!(linked, "exact/query/second.wgsl");
        }
    }

    fn link_round(&self, linked: &mut Linked) {
        shaders!(linked, "exact/round/value.wgsl", "exact/round/hit.wgsl");
        if self.contents.triangles() {
            shaders!(linked, "exact/round/triangle.wgsl");
        }
        if self.contents.spheres() {
            shaders!(linked, "exact/round/sphere.wgsl");
        }
        match self.contents {
            Contents::Triangles => shaders!(linked, "exact/round/only_triangles.wgsl"),
            Contents::Spheres => shaders!(linked, "exact/round/only_spheres.wgsl"),
            Contents::Both => shaders!(linked, "exact/round/both.wgsl"),
        }
        if matches!(self.pass, Pass::Round(_)) {
            shaders!(linked, "exact/round/all.wgsl");
        } else {
            shaders!(linked, "exact/round/rest.wgsl");
        }
    }
}
