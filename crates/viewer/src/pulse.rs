//! How often the window is painted, and how long that takes.

use std::collections::VecDeque;
use std::time::Instant;

/// Frames that are remembered.
const FRAMES: usize = 240;

/// The times of the last frames.
#[derive(Default)]
pub(crate) struct Pulse {
    last: Option<Instant>,
    /// Seconds from frame to frame, where the second was not waited for; and seconds of work in a frame.
    frames: VecDeque<f32>,
    work: VecDeque<f32>,
    /// Whether the next frame is asked for at once.
    busy: bool,
}

impl Pulse {
    /// Notes that a frame begins; `work` is how long the last one has taken.
    pub(crate) fn beat(&mut self, context: &egui::Context, work: Option<f32>) {
        let now = Instant::now();
        // Time that was spent asleep says nothing.
        if let Some(last) = self.last.filter(|_| self.busy) {
            push(&mut self.frames, now.duration_since(last).as_secs_f32());
        }
        self.last = Some(now);
        self.busy = context.requested_repaint_last_pass() || context.has_requested_repaint();
        if let Some(work) = work {
            push(&mut self.work, work);
        }
    }

    /// Frames a second, by the median of the last ones in a row.
    pub(crate) fn rate(&self) -> Option<f32> {
        Some(1.0 / quantile(&self.frames, 0.5)?.max(1e-6))
    }

    /// The median and the 95th percentile of the work in a frame, in milliseconds.
    pub(crate) fn milliseconds(&self) -> Option<[f32; 2]> {
        Some([quantile(&self.work, 0.5)? * 1e3, quantile(&self.work, 0.95)? * 1e3])
    }
}

fn push(times: &mut VecDeque<f32>, time: f32) {
    if times.len() == FRAMES {
        times.pop_front();
    }
    times.push_back(time);
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
fn quantile(times: &VecDeque<f32>, share: f32) -> Option<f32> {
    let mut sorted: Vec<f32> = times.iter().copied().collect();
    sorted.sort_unstable_by(f32::total_cmp);
    sorted.get(((sorted.len().checked_sub(1)?) as f32 * share).round() as usize).copied()
}
