//! What there is of a picture, shown.

use std::time::{Duration, Instant};

use super::job::Job;
use super::layer::Ask;
use super::paint::Side;
use super::view::{Picture, State, View};

impl Job<'_> {
    /// The layer of a side of the picture, and what it is compared with.
    fn side(&self, side: usize) -> Option<Side<'_>> {
        let look = &self.view.look;
        let layer = |ask| self.layers.get(&ask);
        let against = Ask::against(look).map(|ask| layer(ask).ok_or(())).transpose().ok()?;
        let View { world, size, .. } = &self.view;
        let (pixels, mode, shown) = (self.view.pixels(), look.mode, layer(Ask::shown(look, side))?);
        Some(Side { scene: &world.scene, pixels, size: *size, mode, shown, against })
    }

    /// Paints what there is, and shows it.
    pub(super) fn publish(&mut self) {
        let asks = Ask::of(&self.view.look);
        let done =
            asks.iter().filter_map(|ask| self.layers.get(ask)).map(|l| l.step_at(0).map_or(0.0, share)).sum::<f64>();
        self.progress.traced = done / asks.len() as f64;
        let elapsed = self.since.elapsed().as_secs_f64();
        if self.spent.1 > Duration::ZERO {
            self.progress.rate = self.spent.0 as f64 / self.spent.1.as_secs_f64();
        }
        let sides = if self.view.look.is_split() { 2 } else { 1 };
        let painted = [0, 1].map(|side| self.side(side).filter(|_| side < sides));
        let colors = painted.each_ref().map(|side| side.as_ref().map(Side::paint).unwrap_or_default());
        let figures = painted.each_ref().map(|side| side.as_ref().and_then(Side::figures));
        self.progress.first.get_or_insert(elapsed);
        if figures[..sides].iter().all(Option::is_some) {
            self.progress.whole.get_or_insert(elapsed);
        }
        {
            let mut picture = self.shared.picture();
            *picture = Picture {
                view: self.number,
                size: self.view.size,
                look: self.view.look,
                sides: colors,
                figures,
                progress: self.progress.clone(),
                version: picture.version + 1,
            };
        }
        self.published = Instant::now();
        (self.shared.repaint)();
    }

    /// Shows how far it is, with the pixels that are there.
    pub(super) fn report(&self) {
        let mut picture = self.shared.picture();
        picture.progress = self.progress.clone();
        drop(picture);
        (self.shared.repaint)();
    }

    /// Shows that nothing came of it.
    pub(super) fn fail(&mut self, why: String) {
        self.progress.state = State::Failed(why);
        self.layers.clear();
        self.shared.picture().view = self.number;
        self.report();
    }
}

/// How much of a picture is answered where every `step`-th pixel of every `step`-th row is.
fn share(step: u32) -> f64 {
    1.0 / (f64::from(step) * f64::from(step))
}
