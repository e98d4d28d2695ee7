//! Which files make a kernel: a precision, a query and what the scene holds are each a choice of files.

use std::fmt;

use rayproof_scene::{Kind, Kinds, Precision};

use crate::kinds;
use crate::link::Linked;

/// Adds files of `shaders/`.
fn link(linked: &mut Linked, paths: &[&'static str]) {
    paths.iter().for_each(|path| linked.add(path, rayproof_shaders::source(path)));
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
    /// `f32` that rounds to the nearest, whatever it makes of subnormals.
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

impl fmt::Display for Width {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Single | Self::SingleByRule => "f32",
            Self::Double => "f64",
            Self::PairOfF32 => "pairs of f32",
            Self::PairOfF64 => "pairs of f64",
        })
    }
}

impl Width {
    /// Whether the device must have `f64`.
    #[must_use]
    pub const fn needs_f64(self) -> bool {
        matches!(self, Self::Double | Self::PairOfF64)
    }

    pub(crate) fn link(self, linked: &mut Linked) {
        match self {
            Self::Single => {
                link(linked, &["exact/number/native.wgsl", "exact/number/single.wgsl", "exact/number/single_ieee.wgsl"])
            }
            Self::SingleByRule => link(
                linked,
                &["exact/number/native.wgsl", "exact/number/single.wgsl", "exact/number/single_by_rule.wgsl"],
            ),
            Self::Double => {
                link(linked, &["exact/number/native.wgsl", "exact/number/double.wgsl", "exact/number/narrow.wgsl"])
            }
            Self::PairOfF32 => link(linked, &["exact/number/pair.wgsl", "exact/number/pair_of_f32.wgsl"]),
            Self::PairOfF64 => {
                link(linked, &["exact/number/pair.wgsl", "exact/number/pair_of_f64.wgsl", "exact/number/narrow.wgsl"])
            }
        }
    }
}

/// A list of rays in `shaders/exact/list.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Listed {
    /// Those that the first stage left open.
    Opened,
    /// Those whose numbers the second could not round.
    Unrounded,
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

    /// The list that an earlier pass left it, where it does not take every ray.
    pub(crate) const fn list(self) -> Option<Listed> {
        match self {
            Self::Trace(_) | Self::First(_) | Self::Round(_) => None,
            Self::Second(_) => Some(Listed::Opened),
            Self::RoundRest(_) => Some(Listed::Unrounded),
        }
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
    /// The kinds of primitive in the scene: a kernel knows of no other.
    pub kinds: Kinds,
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

    /// The kernel's text: its files, what hands on to each kind, and `scene`, the accessors of the scene's lists and the size of
    /// the stack.
    #[must_use]
    pub fn link(&self, scene: &str) -> Linked {
        let mut linked = Linked::default();
        link(&mut linked, &["math.wgsl", "batch.wgsl", "bvh/slab.wgsl", "leaf/word.wgsl"]);
        match self.pass {
            Pass::Trace(precision) => self.link_trace(&mut linked, precision),
            Pass::First(width) | Pass::Second(width) | Pass::Round(width) | Pass::RoundRest(width) => {
                width.link(&mut linked);
                self.link_exact(&mut linked, width);
            }
        }
        linked.add("(the host's bits of words)", &kinds::words(self.kinds));
        if self.pass.rounds() {
            linked.add("(the host's choice of a kind)", &kinds::rounding(self.kinds));
        } else {
            match self.walk {
                Walk::Tree => link(&mut linked, &["bvh/traverse.wgsl"]),
                Walk::Every => link(&mut linked, &["bvh/every.wgsl"]),
            }
            linked.add("(the host's choice of a kind)", &kinds::leaves(self.kinds));
        }
        linked.add("(the host's accessors)", scene);
        linked
    }

    fn link_trace(&self, linked: &mut Linked, precision: Precision) {
        link(linked, &["leaf/single.wgsl"]);
        match self.query {
            Query::Closest => link(linked, &["query/closest.wgsl"]),
            Query::Any | Query::Count => link(linked, &["query/any.wgsl"]),
        }
        match precision {
            Precision::Textbook | Precision::Classic => link(linked, &["classic/ray.wgsl"]),
            Precision::Fast | Precision::Pair | Precision::Double | Precision::Exact => {
                link(linked, &["fast/ray.wgsl"])
            }
        }
        match precision {
            Precision::Pair => Width::PairOfF32.link(linked),
            Precision::Double => Width::Double.link(linked),
            Precision::Textbook | Precision::Classic | Precision::Fast | Precision::Exact => {}
        }
        if matches!(precision, Precision::Pair | Precision::Double) {
            link(linked, &["exact/vector.wgsl"]);
        }
        for kind in self.kinds.iter() {
            link(linked, traced(kind, precision));
        }
    }

    fn link_exact(&self, linked: &mut Linked, width: Width) {
        link(linked, &["exact/vector.wgsl", "exact/line.wgsl", "exact/ray.wgsl", "exact/list.wgsl"]);
        if self.pass.rounds() {
            link(linked, &["exact/round/value.wgsl", "exact/round/hit.wgsl"]);
            self.kinds.iter().for_each(|kind| link(linked, rounded(kind, width)));
            let pass =
                if matches!(self.pass, Pass::Round(_)) { "exact/round/all.wgsl" } else { "exact/round/rest.wgsl" };
            return link(linked, &[pass]);
        }
        self.kinds.iter().for_each(|kind| link(linked, certified(kind, self.query)));
        link(linked, &["exact/leaf/candidate.wgsl"]);
        match self.query {
            Query::Closest => link(linked, &["exact/query/closest.wgsl", "exact/leaf/nearest.wgsl"]),
            Query::Any => link(linked, &["exact/query/any.wgsl", "exact/leaf/nearest.wgsl"]),
            Query::Count => link(linked, &["exact/query/count.wgsl", "exact/leaf/crossings.wgsl"]),
        }
        let pass =
            if matches!(self.pass, Pass::First(_)) { "exact/query/first.wgsl" } else { "exact/query/second.wgsl" };
        link(linked, &[pass]);
    }
}

/// What a precision other than `exact` makes of a kind.
const fn traced(kind: Kind, precision: Precision) -> &'static [&'static str] {
    match (kind, precision) {
        (Kind::Triangle, Precision::Textbook | Precision::Classic) => &["leaf/triangles.wgsl", "classic/triangle.wgsl"],
        (Kind::Triangle, Precision::Pair | Precision::Double) => &["leaf/triangles.wgsl", "double/triangle.wgsl"],
        (Kind::Triangle, Precision::Fast | Precision::Exact) => &["leaf/triangles.wgsl", "fast/triangle.wgsl"],
        (Kind::Sphere, Precision::Textbook) => &["leaf/spheres.wgsl", "textbook/sphere.wgsl"],
        (Kind::Sphere, Precision::Classic) => &["leaf/spheres.wgsl", "classic/sphere.wgsl"],
        (Kind::Sphere, Precision::Pair | Precision::Double) => &["leaf/spheres.wgsl", "double/sphere.wgsl"],
        (Kind::Sphere, Precision::Fast | Precision::Exact) => &["leaf/spheres.wgsl", "fast/sphere.wgsl"],
    }
}

/// What is certain of a kind.
const fn certified(kind: Kind, query: Query) -> &'static [&'static str] {
    match (kind, query) {
        (Kind::Triangle, _) => &["exact/triangle.wgsl", "exact/leaf/triangles.wgsl"],
        (Kind::Sphere, Query::Count) => &["exact/sphere.wgsl", "exact/leaf/spheres.wgsl", "exact/leaf/both_roots.wgsl"],
        (Kind::Sphere, Query::Closest | Query::Any) => {
            &["exact/sphere.wgsl", "exact/leaf/spheres.wgsl", "exact/leaf/first_root.wgsl"]
        }
    }
}

/// The numbers of a kind's hit.
const fn rounded(kind: Kind, width: Width) -> &'static [&'static str] {
    match (kind, width) {
        (Kind::Triangle, Width::PairOfF32) => {
            &["exact/round/triangle_id.wgsl", "exact/round/words.wgsl", "exact/round/refined_triangle.wgsl"]
        }
        (Kind::Triangle, _) => &["exact/round/triangle_id.wgsl", "exact/triangle.wgsl", "exact/round/triangle.wgsl"],
        (Kind::Sphere, Width::PairOfF32) => {
            &["exact/round/root.wgsl", "exact/sphere.wgsl", "exact/round/refined_sphere.wgsl"]
        }
        (Kind::Sphere, _) => &["exact/round/root.wgsl", "exact/sphere.wgsl", "exact/round/sphere.wgsl"],
    }
}
