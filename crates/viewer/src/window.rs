//! A window, painted by whatever there is.

use std::path::PathBuf;

use eframe::egui_wgpu::{WgpuSetup, WgpuSetupExisting};
use eframe::{NativeOptions, Renderer};
use egui::ViewportBuilder;
use rayproof::{Device, Handles};

use crate::args::{self, Cli};
use crate::{App, Failure, Start};

/// What paints the window.
#[derive(Clone)]
enum Backend {
    /// The device that traces.
    Shared(Box<Handles>),
    /// Another Vulkan device: that which traces may have no screen.
    Wgpu,
    /// OpenGL.
    Glow,
}

/// Opens the window and stays until it is closed; returned is why what it was to do came to nothing.
///
/// # Errors
/// When nothing can paint one; the text says what was tried.
pub(crate) fn open(cli: &Cli, device: &Device) -> Result<Option<Failure>, String> {
    if cfg!(target_os = "linux") && ["DISPLAY", "WAYLAND_DISPLAY"].iter().all(|name| std::env::var_os(name).is_none()) {
        return Err("  there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set".to_owned());
    }
    let painters = match (cli.painter, device.handles()) {
        (args::Painter::Auto, Some(handles)) if !device.is_software() => {
            vec![Backend::Shared(Box::new(handles)), Backend::Wgpu, Backend::Glow]
        }
        // Without a GPU both are Mesa's processor drivers, and that of OpenGL paints five times as fast.
        (args::Painter::Auto, _) => vec![Backend::Glow, Backend::Wgpu],
        (args::Painter::Vulkan, Some(handles)) => vec![Backend::Shared(Box::new(handles))],
        (args::Painter::Vulkan, None) => vec![Backend::Wgpu],
        (args::Painter::Opengl, _) => vec![Backend::Glow],
    };
    // A run without a user neither depends on what the last one left nor changes it.
    let kept =
        cli.is_unattended().then(|| std::env::temp_dir().join(format!("rayproof-viewer-{}.ron", std::process::id())));
    let mut tried = Vec::new();
    for painter in painters {
        let name = match painter {
            Backend::Shared(_) => "the device that traces",
            Backend::Wgpu => "Vulkan",
            Backend::Glow => "OpenGL",
        };
        let start = Start {
            device: device.clone(),
            scene: cli.scene.clone(),
            look: cli.look(),
            size: cli.size,
            panel: cli.panel,
            script: cli.script().unwrap_or_default(),
        };
        let failure = start.script.failure.clone();
        let make =
            move |window: &eframe::CreationContext<'_>| Ok(Box::new(App::new(window, start)) as Box<dyn eframe::App>);
        match eframe::run_native("rayproof-viewer", options(cli, painter, kept.clone()), Box::new(make)) {
            Ok(()) => {
                if let Some(kept) = kept {
                    let _ = std::fs::remove_file(kept);
                }
                return Ok(failure.lock().ok().and_then(|failure| failure.clone()));
            }
            // No painter helps where there is no screen.
            Err(eframe::Error::WinitEventLoop(_) | eframe::Error::Winit(_)) => return Err(unreachable()),
            Err(error) => tried.push(format!("  with {name}: {error}")),
        }
    }
    Err(tried.join("\n"))
}

/// What is said of a display that cannot be reached.
fn unreachable() -> String {
    let set =
        ["DISPLAY", "WAYLAND_DISPLAY"].map(|name| std::env::var(name).ok().map(|value| format!("{name}={value}")));
    let set = set.into_iter().flatten().collect::<Vec<_>>().join(", ");
    format!("  the display cannot be opened ({set})")
}

/// The window's options; what is kept from run to run goes to a place of its own where one is given.
fn options(cli: &Cli, painter: Backend, kept: Option<PathBuf>) -> NativeOptions {
    let [width, height] = cli.window.unwrap_or([1280, 800]).map(|side| side as f32);
    let viewport = ViewportBuilder::default()
        .with_title("Rayproof")
        .with_app_id("rayproof-viewer")
        .with_inner_size([width, height])
        .with_drag_and_drop(true);
    let mut options = NativeOptions {
        viewport,
        renderer: if matches!(painter, Backend::Glow) { Renderer::Glow } else { Renderer::Wgpu },
        persist_window: kept.is_none() && cli.window.is_none(),
        persistence_path: kept,
        ..NativeOptions::default()
    };
    if let Backend::Shared(handles) = painter {
        let Handles { instance, adapter, device, queue } = *handles;
        options.wgpu_options.wgpu_setup = WgpuSetup::Existing(WgpuSetupExisting { instance, adapter, device, queue });
    }
    options
}
