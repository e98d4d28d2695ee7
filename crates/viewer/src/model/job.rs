//! One picture in the making: coarse first, then finer, and stopped as soon as another one is wanted.

use std::collections::HashMap;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use rayproof::scene::{FlatHit, Ray};
use rayproof::{Error, Intersector};

use super::judge::Judge;
use super::layer::{Answers, Ask, Layer, STEPS, row_of_pass};
use super::look::Source;
use super::tracer::Shared;
use super::view::{Progress, State, View};

/// Between two publications of a picture that is not done.
const PAUSE: Duration = Duration::from_millis(150);

/// One view in the making.
pub(super) struct Job<'a> {
    pub(super) shared: &'a Shared,
    pub(super) view: View,
    pub(super) number: u64,
    pub(super) since: Instant,
    pub(super) layers: HashMap<Ask, Layer>,
    pub(super) judge: Judge,
    pub(super) progress: Progress,
    pub(super) published: Instant,
    /// Rays a call: as many as take some milliseconds.
    chunk: usize,
    /// Rays answered, and in how much time.
    pub(super) spent: (usize, Duration),
}

impl<'a> Job<'a> {
    pub(super) fn new(
        shared: &'a Shared,
        view: View,
        number: u64,
        since: Instant,
        (layers, judge): (HashMap<Ask, Layer>, Judge),
    ) -> Self {
        let (progress, spent) = (Progress::default(), (0, Duration::ZERO));
        Self { shared, view, number, since, layers, judge, progress, published: since, chunk: 1 << 14, spent }
    }

    fn is_stale(&self) -> bool {
        self.shared.newest.load(Ordering::Relaxed) != self.number
    }

    /// Makes the picture, for as long as no other one is wanted.
    ///
    /// # Errors
    /// When an engine cannot be made, or fails.
    pub(super) fn run(&mut self) -> Result<(), Error> {
        let asks = Ask::of(&self.view.look);
        let pixels = self.view.size.map(|side| side as usize).iter().product::<usize>();
        let mut engines = Vec::new();
        for &ask in &asks {
            let source = if let Ask::Hits(source) = ask { source } else { Source::EXACT };
            self.progress.state = State::Building(source);
            self.report();
            engines.push(self.view.world.engine(source)?);
            self.layers.entry(ask).or_insert_with(|| Layer::new(ask, pixels));
        }
        self.progress.state = State::Tracing;
        for pass in first_pass(self.view.size)..STEPS.len() {
            for (&ask, engine) in asks.iter().zip(&engines) {
                if !self.trace_pass(ask, engine, pass)? {
                    return Ok(());
                }
            }
            if pass + 1 < STEPS.len() {
                self.publish();
            }
        }
        let judges = self.view.look.mode.judges();
        self.progress.state = if judges { State::Judging } else { State::Done };
        self.publish();
        if judges {
            self.judge_pixels();
            if !self.is_stale() {
                self.progress.state = State::Done;
                // The pixels are those that are shown, unless the oracle had other answers.
                if self.judge.contradicted() > 0 { self.publish() } else { self.report() }
            }
        }
        Ok(())
    }

    /// Answers what is left of a pass; false when another view is wanted.
    fn trace_pass(&mut self, ask: Ask, engine: &Intersector, pass: usize) -> Result<bool, Error> {
        let Some(layer) = self.layers.get(&ask) else { return Ok(true) };
        let (is_first, start) = (layer.is_fresh(), layer.next());
        let Some((at, mut y)) = start.filter(|&(at, _)| at <= pass) else { return Ok(true) };
        if at < pass {
            y = 0;
        }
        let [width, height] = self.view.size;
        let pixels = self.view.pixels();
        let (mut rays, mut places) = (Vec::new(), Vec::new());
        while y < height {
            // The first pass always comes to its end: else a camera in motion would show nothing.
            if !is_first && self.is_stale() {
                return Ok(false);
            }
            rays.clear();
            places.clear();
            while y < height && rays.len() < self.chunk {
                for x in row_of_pass(pass, is_first, y, width) {
                    rays.push(pixels.ray(x, y));
                    places.push((y * width + x) as usize);
                }
                y += STEPS[pass];
            }
            self.answer(ask, engine, &rays, &places)?;
            if !is_first && y < height {
                self.advance(ask, pass, y);
                if self.published.elapsed() > PAUSE {
                    self.publish();
                }
            }
        }
        self.advance(ask, pass, height);
        Ok(true)
    }

    fn advance(&mut self, ask: Ask, pass: usize, rows: u32) {
        let height = self.view.size[1];
        if let Some(layer) = self.layers.get_mut(&ask) {
            layer.advance(pass, rows, height);
        }
    }

    /// Asks the engine, and puts each answer in its place.
    fn answer(&mut self, ask: Ask, engine: &Intersector, rays: &[Ray], places: &[usize]) -> Result<(), Error> {
        let start = Instant::now();
        let Some(layer) = self.layers.get_mut(&ask) else { return Ok(()) };
        match &mut layer.answers {
            Answers::Hits(all) => {
                let mut hits = vec![FlatHit::MISS; rays.len()];
                engine.closest_flat(rays, &mut hits)?;
                places.iter().zip(hits).for_each(|(&place, hit)| all[place] = hit);
            }
            Answers::Stages(all) => {
                let mut stages = vec![0; rays.len()];
                engine.deciding_stages(rays, &mut stages)?;
                places.iter().zip(stages).for_each(|(&place, stage)| all[place] = stage);
            }
        }
        let taken = start.elapsed();
        self.spent = (self.spent.0 + rays.len(), self.spent.1 + taken);
        self.chunk = match taken.as_millis() {
            0..4 => (self.chunk * 2).min(1 << 18),
            4..16 => self.chunk,
            _ => (self.chunk / 2).max(1 << 14),
        };
        Ok(())
    }

    /// Has the oracle answer pixel after pixel too, for as long as nothing else is wanted.
    fn judge_pixels(&mut self) {
        let (world, pixels, size) = (self.view.world.clone(), self.view.pixels(), self.view.size);
        loop {
            while self.shared.rests.load(Ordering::Relaxed) && !self.is_stale() {
                std::thread::sleep(Duration::from_millis(10));
            }
            let Some(Answers::Hits(exact)) = self.layers.get_mut(&Ask::Hits(Source::EXACT)).map(|l| &mut l.answers)
            else {
                return;
            };
            let more = self.judge.go_on(&world.scene, pixels, size, exact);
            self.progress.judged = Some([self.judge.judged(), exact.len()]);
            self.progress.contradicted = self.judge.contradicted();
            if !more || self.is_stale() {
                return;
            }
            if self.published.elapsed() > PAUSE {
                self.report();
                self.published = Instant::now();
            }
        }
    }
}

/// The pass to start with: one that leaves some thousand pixels.
fn first_pass(size: [u32; 2]) -> usize {
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    STEPS.iter().position(|&step| pixels / u64::from(step * step) >= 4_000).unwrap_or(STEPS.len() - 1)
}
