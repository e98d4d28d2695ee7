//! What the window shows, and whether it shows all that was asked for.

use crate::app::App;
use crate::model::view::{Picture, Progress, State};
use crate::panels::canvas::split_column;
use crate::settings::Panel;

impl App {
    /// Whether the newest picture is traced, though the oracle may not have judged all of it.
    pub(crate) fn is_whole(&self) -> bool {
        let picture = self.tracer.picture();
        self.is_newest_whole(picture.view, &picture.progress)
    }

    /// Whether the picture of this number, that far, is the newest one and whole.
    pub(crate) fn is_newest_whole(&self, number: u64, progress: &Progress) -> bool {
        let newest = self.asked.as_ref().is_some_and(|(_, newest)| *newest == number);
        newest && progress.whole.is_some()
    }

    /// Whether all that was asked for is shown, though the oracle may not have judged all of it.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        let idle = !(self.opener.is_busy() || self.plot.is_measuring() || self.gallery.is_busy());
        let measured = self.settings.panel != Some(Panel::Plot) || self.plot.measured.is_some();
        let picture = || self.tracer.picture();
        let failed = matches!(picture().progress.state, State::Failed(_));
        idle && measured && !self.inspector.is_busy() && (failed || self.is_whole()) && self.canvas.shows(&picture())
    }

    /// Whether, beyond that, nothing is going on any more.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        let done = matches!(self.tracer.picture().progress.state, State::Done | State::Failed(_));
        done && self.is_shown()
    }

    /// The picture of the left-hand side as it is now: its width and height, and red, green and blue of each pixel, row by row
    /// from the top left.
    #[must_use]
    pub fn pixels(&self) -> ([u32; 2], Vec<[u8; 3]>) {
        let picture = self.tracer.picture();
        (picture.size, picture.sides[0].clone())
    }

    /// The picture as it is shown: with both sides of a split.
    pub(crate) fn composed(&self, picture: &Picture) -> Vec<[u8; 3]> {
        let [left, right] = &picture.sides;
        if right.is_empty() {
            return left.clone();
        }
        let width = picture.size[0] as usize;
        let at = split_column(self.settings.split_at, picture.size[0]) as usize;
        left.chunks_exact(width)
            .zip(right.chunks_exact(width))
            .flat_map(|(l, r)| [&l[..at], &r[at..]].concat())
            .collect()
    }
}
