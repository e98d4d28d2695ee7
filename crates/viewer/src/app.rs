//! The viewer's state, and what happens in every frame.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::CreationContext;
use rayproof::Device;
use rayproof::scene::Camera;

use crate::canvas::Canvas;
use crate::gallery::Gallery;
use crate::inspector::Inspector;
use crate::model::look::Look;
use crate::model::measure::{Measured, measure};
use crate::model::navigate;
use crate::model::task::{Task, take};
use crate::model::tracer::Tracer;
use crate::model::view::View;
use crate::model::world::World;
use crate::panels;
use crate::pulse::Pulse;
use crate::script::{Panel, Script};
use crate::settings::{Settings, Side};

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
    /// Which panel is open on the right; else as the last time.
    pub panel: Option<Panel>,
    /// What is done without a user.
    pub script: Script,
}

/// The methods' speed and error, and the number of the view that they were measured on.
type Measurement = (u64, Result<Vec<Measured>, String>);

/// The viewer.
pub struct App {
    pub(crate) settings: Settings,
    pub(crate) device: Device,
    /// What is shown; a scene is always there.
    pub(crate) world: Arc<World>,
    pub(crate) camera: Camera,
    /// Why the last scene could not be opened.
    pub(crate) fault: Option<String>,
    pub(crate) opening: Option<Task<(PathBuf, Result<World, String>)>>,
    /// What the user has typed for a path.
    pub(crate) path: String,
    pub(crate) tracer: Tracer,
    /// What was asked of the tracer last, and its number.
    pub(crate) asked: Option<(View, u64)>,
    pub(crate) canvas: Canvas,
    pub(crate) inspector: Inspector,
    pub(crate) gallery: Gallery,
    pub(crate) measuring: Option<Task<Measurement>>,
    pub(crate) measured: Option<Measurement>,
    pub(crate) pulse: Pulse,
    /// Something to tell for a while.
    pub(crate) notice: Option<(String, f64)>,
    pub(crate) size: Option<[u32; 2]>,
    /// Whether the picture is to be saved as soon as it is whole.
    pub(crate) saving: bool,
    /// A picture of the window on its way to a file; and what is told of it then.
    pub(crate) writing: Option<Task<String>>,
    pub(crate) script: Script,
}

impl App {
    /// The viewer in a window that is there.
    #[must_use]
    pub fn new(window: &CreationContext<'_>, start: Start) -> Self {
        let kept = window.storage.and_then(Settings::kept);
        let mut settings = kept.unwrap_or_default();
        settings.look = start.look.unwrap_or(settings.look);
        settings.side = start.panel.map_or(settings.side, Panel::side);
        legible(&window.egui_ctx);
        let context = window.egui_ctx.clone();
        let world = Arc::new(World::welcome(start.device.clone()));
        let mut app = Self {
            device: start.device,
            camera: world.camera,
            world,
            fault: None,
            opening: None,
            path: String::new(),
            tracer: Tracer::new(move || context.request_repaint()),
            asked: None,
            canvas: Canvas::default(),
            inspector: Inspector::default(),
            gallery: Gallery::default(),
            measuring: None,
            measured: None,
            pulse: Pulse::default(),
            notice: None,
            size: start.size,
            saving: false,
            writing: None,
            script: start.script,
            settings,
        };
        // A last scene that is gone is no fault: nobody has asked for it.
        let last = app.settings.scene.take().filter(|path| path.exists());
        if let Some(path) = start.scene.or(last) {
            app.open(&window.egui_ctx, &path);
        }
        app
    }

    /// Reads a scene, beside the window.
    pub(crate) fn open(&mut self, context: &egui::Context, path: &Path) {
        let (path, device) = (path.to_owned(), self.device.clone());
        self.opening = Some(Task::start(context, move || {
            let world = World::open(&path, device);
            (path, world)
        }));
    }

    /// Shows another scene from its first camera.
    pub(crate) fn enter(&mut self, world: Arc<World>) {
        self.camera = world.camera;
        self.world = world;
        self.fault = None;
        self.inspector = Inspector::default();
        self.measured = None;
        self.measuring = None;
    }

    /// Back to where the scene is seen from at first.
    pub(crate) fn frame(&mut self) {
        self.camera = self.world.camera;
        self.gallery.decades = 0.0;
    }

    /// Takes in what was done beside the window.
    fn collect(&mut self, context: &egui::Context) {
        match take(&mut self.opening) {
            None => {}
            Some(Ok((path, Ok(world)))) => {
                self.settings.scene = std::path::absolute(&path).ok();
                self.gallery.close();
                self.enter(Arc::new(world));
            }
            // Nobody is to blame where a dialog was closed.
            Some(Ok((path, Err(why)))) if path.as_os_str().is_empty() => self.tell(context, why),
            Some(Ok((_, Err(why)))) => self.fault = Some(why),
            Some(Err(why)) => self.fault = Some(why.to_owned()),
        }
        if let Some(exhibit) = self.gallery.collect() {
            match exhibit {
                Ok(world) => self.enter(world),
                Err(why) => self.fault = Some(why),
            }
        }
        self.inspector.collect();
        if let Some(told) = take(&mut self.writing) {
            self.tell(context, told.unwrap_or_else(str::to_owned));
        }
        if let Some(point) = self.canvas.focused() {
            self.camera = navigate::focus(&self.camera, point);
        }
        match take(&mut self.measuring) {
            None => {}
            Some(Ok(measured)) => self.measured = Some(measured),
            Some(Err(why)) => self.measured = Some((0, Err(why.to_owned()))),
        }
        self.tracer.rest(self.measuring.is_some());
        let dropped = context.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            self.open(context, &path);
        }
        if self.notice.as_ref().is_some_and(|(_, until)| context.input(|i| i.time) > *until) {
            self.notice = None;
        }
    }

    /// Tells something for some seconds.
    pub(crate) fn tell(&mut self, context: &egui::Context, what: impl Into<String>) {
        self.notice = Some((what.into(), context.input(|i| i.time) + 6.0));
        context.request_repaint_after(std::time::Duration::from_secs(6));
    }

    /// Wants the picture that the window has room for.
    pub(crate) fn want(&mut self, size: [u32; 2]) {
        let view = View { world: self.world.clone(), camera: self.camera, size, look: self.settings.look };
        let same = |(asked, _): &(View, u64)| asked.same_rays(&view) && asked.look == view.look;
        if !self.asked.as_ref().is_some_and(same) {
            let number = self.tracer.show(view.clone());
            self.asked = Some((view, number));
        }
    }

    /// Measures all methods on the view, where that is wanted and was not done.
    pub(crate) fn measure(&mut self, context: &egui::Context) {
        let Some((view, number)) = &self.asked else { return };
        let known = self.measured.as_ref().is_some_and(|(measured, _)| measured == number);
        if known || self.measuring.is_some() || !self.is_whole() {
            return;
        }
        let (view, number) = (view.clone(), *number);
        self.tracer.rest(true);
        self.measuring = Some(Task::start(context, move || {
            (number, measure(&view.world, &view.camera, view.size).map_err(|e| e.to_string()))
        }));
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
        self.pulse.beat(&context, frame.info().cpu_usage);
        self.collect(&context);
        self.canvas.upload(&context, &self.tracer);
        crate::keys::act(self, &context);
        panels::show(self, ui);
        if self.settings.side == Some(Side::Plot) {
            self.measure(&context);
        }
        if self.saving && self.is_whole() {
            self.saving = false;
            panels::toolbar::save_picture(self, &context);
        }
        Script::step(self, &context);
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
