//! A window, painted by whatever there is.

use eframe::egui_wgpu::{WgpuSetup, WgpuSetupExisting};
use eframe::{NativeOptions, Renderer};
use egui::ViewportBuilder;
use rayproof::{Device, Handles};

use crate::args::{self, Cli};
use crate::{App, Start};

/// What paints the window.
#[derive(Clone)]
enum Painter {
    /// The device that traces.
    Shared(Box<Handles>),
    /// Another Vulkan device: that which traces may have no screen.
    Wgpu,
    /// OpenGL.
    Glow,
}

/// Opens the window and stays until it is closed.
///
/// # Errors
/// When nothing can paint one; the text says what was tried.
pub(crate) fn open(cli: &Cli, device: &Device) -> Result<(), String> {
    let shared = device.handles().filter(|_| !device.is_software());
    let painters = match (cli.painter, shared) {
        (args::Painter::Auto, Some(handles)) => vec![Painter::Shared(Box::new(handles)), Painter::Wgpu, Painter::Glow],
        // Without a GPU both are Mesa's processor drivers, and that of OpenGL paints five times as fast.
        (args::Painter::Auto, None) => vec![Painter::Glow, Painter::Wgpu],
        (args::Painter::Vulkan, Some(handles)) => vec![Painter::Shared(Box::new(handles))],
        (args::Painter::Vulkan, None) => vec![Painter::Wgpu],
        (args::Painter::Opengl, _) => vec![Painter::Glow],
    };
    let mut tried = Vec::new();
    for painter in painters {
        let name = match painter {
            Painter::Shared(_) => "the device that traces",
            Painter::Wgpu => "Vulkan",
            Painter::Glow => "OpenGL",
        };
        let start = Start {
            device: device.clone(),
            scene: cli.scene.clone(),
            look: cli.look(),
            size: cli.size,
            script: cli.script().unwrap_or_default(),
        };
        let make =
            move |window: &eframe::CreationContext<'_>| Ok(Box::new(App::new(window, start)) as Box<dyn eframe::App>);
        match eframe::run_native("rayproof-viewer", options(cli, painter), Box::new(make)) {
            Ok(()) => return Ok(()),
            Err(error) => tried.push(format!("  with {name}: {error}")),
        }
    }
    Err(tried.join("\n"))
}

fn options(cli: &Cli, painter: Painter) -> NativeOptions {
    let [width, height] = cli.window.unwrap_or([1280, 800]).map(|side| side as f32);
    let viewport = ViewportBuilder::default()
        .with_title("Rayproof")
        .with_app_id("rayproof-viewer")
        .with_inner_size([width, height])
        .with_drag_and_drop(true);
    let unattended = cli.screenshot.is_some() || cli.measure.is_some();
    let mut options = NativeOptions {
        viewport,
        renderer: if matches!(painter, Painter::Glow) { Renderer::Glow } else { Renderer::Wgpu },
        // A run without a user neither depends on what the last one left nor changes it.
        persist_window: !unattended && cli.window.is_none(),
        persistence_path: unattended
            .then(|| std::env::temp_dir().join(format!("rayproof-viewer-{}", std::process::id()))),
        ..NativeOptions::default()
    };
    if let Painter::Shared(handles) = painter {
        let Handles { instance, adapter, device, queue } = *handles;
        options.wgpu_options.wgpu_setup = WgpuSetup::Existing(WgpuSetupExisting { instance, adapter, device, queue });
    }
    options
}
