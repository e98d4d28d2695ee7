//! From answers to pixels, and to figures about them.

use rayon::prelude::*;
use rayproof::scene::{FlatHit, Pixels, Scene};
use rayproof_oracle::judge::ulp_distance;
use rayproof_picture::color::{BACKGROUND, Rgb};
use rayproof_picture::shade::{self, Verdict};

use super::layer::{Answers, Layer};
use super::look::Mode;

/// A pixel that hits something, in the mask.
pub(crate) const HIT: Rgb = [235, 235, 238];

/// What a side of a picture is painted from.
pub(crate) struct Side<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) pixels: Pixels,
    pub(crate) size: [u32; 2],
    pub(crate) mode: Mode,
    /// What is shown.
    pub(crate) shown: &'a Layer,
    /// What it is compared with: exact answers, or another precision's.
    pub(crate) against: Option<&'a Layer>,
}

impl Side<'_> {
    /// The colours of all pixels; where there is no answer yet, that of the pixel above and to the left which has one.
    pub(crate) fn paint(&self) -> Vec<Rgb> {
        let width = self.size[0] as usize;
        if self.mode == Mode::Depth {
            return self.paint_depth();
        }
        let mut colors = vec![BACKGROUND; width * self.size[1] as usize];
        colors.par_chunks_exact_mut(width).zip(0..self.size[1]).for_each(|(row, y)| {
            let Some(step) = self.step_at(y) else { return };
            let top = y - y % step;
            for (x, block) in (0..).step_by(step as usize).zip(row.chunks_mut(step as usize)) {
                block.fill(self.color(x, top));
            }
        });
        colors
    }

    /// The nearest and the farthest are known when all distances are.
    fn paint_depth(&self) -> Vec<Rgb> {
        let [width, height] = self.size;
        let hits = self.shown.hits();
        let mut distances = Vec::with_capacity(hits.len());
        for y in 0..height {
            let step = self.step_at(y);
            distances.extend(
                (0..width).map(|x| {
                    step.map_or(f32::INFINITY, |step| hits[((y - y % step) * width + x - x % step) as usize].t)
                }),
            );
        }
        shade::by_depth(&distances).collect()
    }

    /// Every how many pixels there is an answer of each kind.
    fn step_at(&self, y: u32) -> Option<u32> {
        let step = self.shown.step_at(y)?;
        self.against.map_or(Some(step), |other| Some(step.max(other.step_at(y)?)))
    }

    fn color(&self, x: u32, y: u32) -> Rgb {
        let i = (y * self.size[0] + x) as usize;
        let hit = match &self.shown.answers {
            Answers::Stages(stages) => return shade::by_stage(stages[i]),
            Answers::Hits(hits) => &hits[i],
        };
        let other = self.against.map_or(&FlatHit::MISS, |layer| &layer.hits()[i]);
        match self.mode {
            Mode::Normal => shade::by_normal(self.scene, &self.pixels.ray(x, y), hit),
            Mode::Primitive => shade::by_primitive(hit),
            Mode::Uv => shade::by_uv(hit),
            Mode::Error | Mode::Difference => shade::by_error(other, hit),
            Mode::Verdict => Verdict::of(other, hit).color(),
            Mode::Mask | Mode::Depth | Mode::Stage => {
                if hit.is_hit() {
                    HIT
                } else {
                    BACKGROUND
                }
            }
        }
    }

    /// What there is to say of a side when all its pixels are answered.
    pub(crate) fn figures(&self) -> Option<Figures> {
        let whole = self.shown.is_complete() && self.against.is_none_or(Layer::is_complete);
        whole.then(|| match (&self.shown.answers, self.against) {
            (Answers::Stages(stages), _) => {
                let mut counts = [0; 3];
                stages.iter().for_each(|&stage| counts[usize::from(stage.clamp(1, 3)) - 1] += 1);
                Figures::Stages(counts)
            }
            (Answers::Hits(hits), None) => {
                let distances = || hits.iter().filter(|hit| hit.is_hit()).map(|hit| hit.t);
                let range = [distances().reduce(f32::min), distances().reduce(f32::max)];
                Figures::Hits { hits: distances().count(), range: range[0].zip(range[1]).map(<[f32; 2]>::from) }
            }
            (Answers::Hits(hits), Some(other)) => Figures::Errors(Errors::of(other.hits(), hits)),
        })
    }
}

/// Figures about a side of a picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Figures {
    /// How many pixels hit something, and the least and the largest t.
    Hits {
        hits: usize,
        range: Option<[f32; 2]>,
    },
    /// How many pixels each stage decides.
    Stages([usize; 3]),
    Errors(Errors),
}

/// How a precision's answers stand to others.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Errors {
    /// How many there are of each verdict, in the order of [`Verdict::ALL`].
    pub(crate) verdicts: [usize; 5],
    /// The median error of t where the primitive is the same, in ULP; that of 99.9 %; the worst.
    pub(crate) ulps: Option<[u64; 3]>,
    /// The places of the first wrong answers, [`Errors::SHOWN`] at most, each with its verdict.
    pub(crate) places: Vec<(u32, Verdict)>,
}

impl Errors {
    /// How many wrong answers are kept.
    pub(crate) const SHOWN: usize = 500;

    pub(crate) fn of(exact: &[FlatHit], answers: &[FlatHit]) -> Self {
        let mut verdicts = [0; 5];
        let (mut ulps, mut places) = (Vec::new(), Vec::new());
        for ((exact, answer), place) in exact.iter().zip(answers).zip(0..) {
            let verdict = Verdict::of(exact, answer);
            verdicts[Verdict::ALL.iter().position(|&v| v == verdict).unwrap_or(0)] += 1;
            match verdict {
                Verdict::Hit => ulps.push(ulp_distance(exact.t, answer.t)),
                Verdict::Miss => {}
                wrong if places.len() < Self::SHOWN => places.push((place, wrong)),
                _ => {}
            }
        }
        ulps.sort_unstable();
        let quantile = |thousandths: usize| ulps[(ulps.len() - 1) * thousandths / 1000];
        let ulps = (!ulps.is_empty()).then(|| [500, 999, 1000].map(quantile));
        Self { verdicts, ulps, places }
    }

    /// How many answers are wrong.
    pub(crate) fn wrong(&self) -> usize {
        self.verdicts[2..].iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use rayproof::scene::Camera;

    use super::*;
    use crate::model::layer::{Ask, STEPS};
    use crate::model::look::Source;

    /// A layer of hits, each of a primitive of its own, with the passes down to a step done and rows of the next.
    fn layer(step: u32, rows: u32, first: u32) -> Layer {
        let [width, height] = SIZE;
        let mut layer = Layer::new(Ask::Hits(Source::EXACT), (width * height) as usize);
        let pass = STEPS.iter().position(|&s| s == step).unwrap_or(0);
        layer.advance(pass, height, height);
        if rows > 0 {
            layer.advance(pass + 1, rows, height);
        }
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let answered =
            |(x, y): (u32, u32)| layer.step_at(y).is_some_and(|s| x.is_multiple_of(s) && y.is_multiple_of(s));
        let hit = |(place, primitive)| {
            if answered(place) { FlatHit { t: 1.0, u: 0.0, v: 0.0, primitive } } else { FlatHit::MISS }
        };
        layer.answers = Answers::Hits(places.zip(first..).map(hit).collect());
        layer
    }

    const SIZE: [u32; 2] = [10, 9];

    #[test]
    fn what_is_not_answered_yet_looks_like_its_neighbour() {
        let scene = Scene::default();
        let pixels = Camera::framing(&scene).pixels(SIZE[0], SIZE[1]);
        let paint = |mode, shown: &Layer, against: Option<&Layer>| {
            let side = Side { scene: &scene, pixels, size: SIZE, mode, shown, against };
            (side.paint(), side.figures().is_some())
        };
        let place = |x: u32, y: u32| (y * SIZE[0] + x) as usize;
        // Every fourth pixel is there; in the upper four rows every second.
        let shown = layer(4, 4, 0);
        let (colors, whole) = paint(Mode::Primitive, &shown, None);
        for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
            let step = if y < 4 { 2 } else { 4 };
            let from = shown.hits()[place(x - x % step, y - y % step)];
            assert_eq!(colors[place(x, y)], shade::by_primitive(&from), "{x}, {y}");
        }
        assert!(!whole);
        // Two layers are compared where both are answered: else neighbours would be compared.
        let (exact, coarse) = (layer(1, 0, 0), layer(4, 0, 0));
        assert_eq!(paint(Mode::Verdict, &exact, Some(&coarse)).0, vec![Verdict::Hit.color(); colors.len()]);
        assert_eq!(paint(Mode::Verdict, &coarse, Some(&exact)).0, vec![Verdict::Hit.color(); colors.len()]);
        let (all, whole) = paint(Mode::Verdict, &exact, Some(&layer(1, 0, 1)));
        assert!(whole && all == vec![Verdict::Another.color(); colors.len()]);
        let nothing = Layer::new(Ask::Hits(Source::EXACT), colors.len());
        assert_eq!(paint(Mode::Primitive, &nothing, None).0, vec![BACKGROUND; colors.len()]);
    }

    #[test]
    fn errors_are_counted_by_verdict() {
        let at = |t: f32, primitive| FlatHit { t, u: 0.0, v: 0.0, primitive };
        let off = f32::from_bits(2.0_f32.to_bits() + 7);
        let exact = [at(2.0, 0), at(2.0, 0), at(2.0, 0), FlatHit::MISS, FlatHit::MISS, at(2.0, 0)];
        let answers = [at(2.0, 0), at(off, 0), at(2.0, 1), at(1.0, 0), FlatHit::MISS, FlatHit::MISS];
        let errors = Errors::of(&exact, &answers);
        assert_eq!((errors.verdicts, errors.ulps), ([1, 2, 1, 1, 1], Some([0, 0, 7])));
        assert_eq!(errors.places, [(2, Verdict::Another), (3, Verdict::FalseHit), (5, Verdict::FalseMiss)]);
        assert_eq!(errors.wrong(), 3);
        assert_eq!(Errors::of(&[], &[]).ulps, None);
    }
}
