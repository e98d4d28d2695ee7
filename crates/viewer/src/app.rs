//! The viewer's state, and what happens in every frame.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::CreationContext;
use rayproof::Device;

use crate::act::Act;
use crate::keys;
use crate::model::look::Look;
use crate::model::tracer::Tracer;
use crate::model::view::View;
use crate::model::world::World;
use crate::opener::Opener;
use crate::panels::canvas::Canvas;
use crate::panels::gallery::Gallery;
use crate::panels::inspector::Inspector;
use crate::panels::plot::Plot;
use crate::panels::status::Status;
use crate::panels::toolbar::Toolbar;
use crate::save::{Saver, write_new};
use crate::script::{Script, Seen};
use crate::settings::{Panel, Settings};
use crate::standpoint::Standpoint;

/// What the viewer starts with.
pub struct Start {
    /// What traces.
    pub device: Device,
    /// The scene to open; else the last one.
    pub scene: Option<PathBuf>,
    /// How it is shown; else as the last time.
    pub look: Option<Look>,
    /// The size of the picture in pixels; else that of its place in the window.
    pub size: Option<[u32; 2]>,
    /// Which panel is open on the right, or that none is; else as the last time.
    pub panel: Option<Option<Panel>>,
    /// What is done without a user.
    pub script: Script,
}

/// The viewer.
pub struct App {
    pub(crate) settings: Settings,
    pub(crate) device: Device,
    pub(crate) standpoint: Standpoint,
    pub(crate) tracer: Tracer,
    /// What was asked of the tracer last, and its number.
    pub(crate) asked: Option<(View, u64)>,
    pub(crate) opener: Opener,
    pub(crate) saver: Saver,
    pub(crate) script: Script,
    pub(crate) toolbar: Toolbar,
    pub(crate) status: Status,
    pub(crate) canvas: Canvas,
    pub(crate) inspector: Inspector,
    pub(crate) gallery: Gallery,
    pub(crate) plot: Plot,
}

impl App {
    /// The viewer in a window that is there.
    #[must_use]
    pub fn new(window: &CreationContext<'_>, start: Start) -> Self {
        let kept = window.storage.and_then(Settings::kept);
        let mut settings = kept.unwrap_or_default();
        settings.look = start.look.unwrap_or(settings.look);
        settings.panel = start.panel.unwrap_or(settings.panel);
        legible(&window.egui_ctx);
        // A last scene that is gone is no fault: nobody has asked for it.
        let last = settings.scene.take().filter(|path| path.exists());
        let context = window.egui_ctx.clone();
        let mut app = Self {
            settings,
            standpoint: Standpoint::new(Arc::new(World::welcome(start.device.clone()))),
            device: start.device,
            tracer: Tracer::new(move || context.request_repaint()),
            asked: None,
            opener: Opener::default(),
            saver: Saver::default(),
            script: start.script,
            toolbar: Toolbar::default(),
            status: Status::default(),
            canvas: Canvas::new(start.size),
            inspector: Inspector::default(),
            gallery: Gallery::default(),
            plot: Plot::default(),
        };
        app.apply(&window.egui_ctx, start.scene.or(last).map(Act::Open));
        app
    }

    /// Takes in what was done beside the window.
    fn collect(&mut self, context: &egui::Context) {
        let opened = self.opener.collect();
        self.apply(context, opened);
        let hung = self.gallery.collect();
        self.apply(context, hung);
        self.inspector.collect();
        self.plot.collect();
        let found = self.saver.collect().into_iter().chain(self.canvas.collect());
        self.apply(context, found);
        self.tracer.rest(self.plot.is_measuring());
        let dropped = context.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        self.apply(context, dropped.map(Act::Open));
    }

    /// Measures all precisions on the view, where that is wanted and was not done.
    fn measure(&mut self, context: &egui::Context) {
        let Some((view, number)) = &self.asked else { return };
        if self.settings.panel == Some(Panel::Plot) && self.plot.wants(*number) && self.is_whole() {
            self.tracer.rest(true);
            self.plot.measure(context, view.clone(), *number);
        }
    }

    /// Saves the picture, where that is wanted and it is whole.
    fn save_picture(&mut self, context: &egui::Context) {
        if !self.saver.waits || !self.is_whole() {
            return;
        }
        self.saver.waits = false;
        let (size, pixels) = {
            let picture = self.tracer.picture();
            (picture.size, self.composed(&picture))
        };
        let word = self.settings.look.mode.name();
        self.status.tell(context, write_new(&self.standpoint.world.name, word, size, pixels.as_flattened()));
    }

    /// Does the next thing of the script.
    fn follow_script(&mut self, context: &egui::Context) {
        if !self.script.runs() {
            return;
        }
        let (number, progress) = {
            let picture = self.tracer.picture();
            (picture.view, picture.progress.clone())
        };
        let seen = Seen {
            shown: self.is_shown(),
            whole: self.is_newest_whole(number, &progress).then_some((number, progress)),
            fault: self.opener.fault.as_deref(),
            standpoint: &self.standpoint,
            size: self.canvas.size,
            scenes: self.gallery.hung.as_ref().map_or(0, |hung| hung.of),
            device: &self.device,
        };
        let act = self.script.step(context, &seen);
        self.apply(context, act);
    }
}

/// Text that stands out from its ground, also where it is secondary.
fn legible(context: &egui::Context) {
    for (theme, grey) in [(egui::Theme::Dark, 200), (egui::Theme::Light, 30)] {
        context.style_mut_of(theme, |style| {
            style.visuals.widgets.noninteractive.fg_stroke.color = egui::Color32::from_gray(grey);
            style.visuals.weak_text_alpha = 0.8;
        });
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        self.status.beat(&context, frame.info().cpu_usage);
        self.collect(&context);
        self.canvas.upload(&context, &self.tracer);
        let pressed = keys::pressed(&context, self.settings.look, &self.standpoint.camera);
        self.apply(&context, pressed);
        self.lay_out(ui);
        self.measure(&context);
        self.save_picture(&context);
        self.follow_script(&context);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        if !self.script.runs() {
            self.settings.keep(storage);
        }
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}
