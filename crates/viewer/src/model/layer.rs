//! The answers to the rays of a picture, as they come: coarse first, then finer.

use rayproof::scene::FlatHit;

use super::look::{Look, Mode, Source};

/// The strides of the passes over a picture; each pass leaves out what the ones before it have answered.
pub(crate) const STEPS: [u32; 5] = [16, 8, 4, 2, 1];

/// What is asked of every ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Ask {
    /// Its closest hit.
    Hits(Source),
    /// Which stage of the cascade decides it.
    Stages,
}

impl Ask {
    /// What a side of a look shows: the left, 0, or that right of the split.
    pub(crate) const fn shown(look: &Look, side: usize) -> Self {
        match (look.mode, side) {
            (Mode::Stage, _) => Self::Stages,
            (_, 0) => Self::Hits(look.left),
            _ => Self::Hits(look.right),
        }
    }

    /// What that is compared with.
    pub(crate) const fn against(look: &Look) -> Option<Self> {
        match look.mode {
            Mode::Difference => Some(Self::Hits(look.right)),
            mode if mode.judges() => Some(Self::Hits(Source::EXACT)),
            _ => None,
        }
    }

    /// What a look is made of, what is shown first first.
    pub(crate) fn of(look: &Look) -> Vec<Self> {
        let second = look.is_split().then(|| Self::shown(look, 1));
        [Some(Self::shown(look, 0)), second, Self::against(look)].into_iter().flatten().collect()
    }
}

/// Answers to all pixels, of one kind; row by row from the top left.
#[derive(Clone, Debug)]
pub(crate) enum Answers {
    Hits(Vec<FlatHit>),
    /// 1 to 3.
    Stages(Vec<u8>),
}

/// One kind of answer for a picture, and how far it is.
#[derive(Clone, Debug)]
pub(crate) struct Layer {
    pub(crate) answers: Answers,
    /// Passes that are done.
    passes: usize,
    /// Of the next pass, the rows above this one are done.
    rows: u32,
}

impl Layer {
    pub(crate) fn new(ask: Ask, pixels: usize) -> Self {
        let answers = match ask {
            Ask::Hits(_) => Answers::Hits(vec![FlatHit::MISS; pixels]),
            Ask::Stages => Answers::Stages(vec![0; pixels]),
        };
        Self { answers, passes: 0, rows: 0 }
    }

    /// The pass to go on with and the row to start at; `None` when all pixels are answered.
    pub(crate) fn next(&self) -> Option<(usize, u32)> {
        (self.passes < STEPS.len()).then_some((self.passes, self.rows))
    }

    /// Whether there is no answer yet: whatever pass is the first then answers all its pixels.
    pub(crate) const fn is_fresh(&self) -> bool {
        self.passes == 0 && self.rows == 0
    }

    /// Notes that rows of a pass are done, up to `rows` of a picture that is `height` high. A first pass is noted when it is
    /// whole.
    pub(crate) const fn advance(&mut self, pass: usize, rows: u32, height: u32) {
        if rows >= height {
            self.passes = pass + 1;
            self.rows = 0;
        } else {
            self.passes = pass;
            self.rows = rows;
        }
    }

    /// Every how many pixels there is an answer, in a row and the rows with it; `None` where there is none yet.
    pub(crate) fn step_at(&self, y: u32) -> Option<u32> {
        if self.passes < STEPS.len() && y < self.rows {
            return Some(STEPS[self.passes]);
        }
        self.passes.checked_sub(1).map(|pass| STEPS[pass])
    }

    pub(crate) const fn is_complete(&self) -> bool {
        self.passes == STEPS.len()
    }

    pub(crate) fn hits(&self) -> &[FlatHit] {
        match &self.answers {
            Answers::Hits(hits) => hits,
            Answers::Stages(_) => &[],
        }
    }
}

/// The pixels of a row that a pass answers: all of its own if it is the first, else those that the pass before has left.
pub(crate) fn row_of_pass(pass: usize, is_first: bool, y: u32, width: u32) -> impl Iterator<Item = u32> {
    let step = STEPS[pass];
    let answered = move |x: u32| !is_first && x.is_multiple_of(2 * step) && y.is_multiple_of(2 * step);
    (0..width).step_by(step as usize).filter(move |&x| !answered(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_answer_every_pixel_once() {
        for first in 0..STEPS.len() {
            let (width, height) = (37, 21);
            let mut answered = vec![0; width * height];
            for (pass, &step) in STEPS.iter().enumerate().skip(first) {
                for y in (0..21).step_by(step as usize) {
                    row_of_pass(pass, pass == first, y, 37)
                        .for_each(|x| answered[y as usize * width + x as usize] += 1);
                }
            }
            assert!(answered.iter().all(|&times| times == 1), "from pass {first}: {answered:?}");
        }
    }

    #[test]
    fn rows_above_are_finer() {
        let mut layer = Layer::new(Ask::Stages, 100);
        assert_eq!(layer.step_at(0), None);
        layer.advance(1, 10, 10);
        layer.advance(2, 4, 10);
        assert_eq!([0, 3, 4, 9].map(|y| layer.step_at(y)), [Some(4), Some(4), Some(8), Some(8)]);
        layer.advance(4, 10, 10);
        assert!(layer.is_complete() && layer.step_at(9) == Some(1));
    }
}
