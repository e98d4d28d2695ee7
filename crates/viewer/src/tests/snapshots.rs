//! How the window looks, against pictures that were looked at.

use rayproof::Precision;

use super::*;
use crate::model::look::Source;

/// The window, in points.
const WIDTH: f32 = 760.0;
const HEIGHT: f32 = 520.0;

/// Text may move by a pixel with another painter; a panel that is missing is more.
fn options() -> egui_kittest::SnapshotOptions {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots");
    egui_kittest::SnapshotOptions::new().output_path(folder).threshold(1.5).max_failed_pixels(400_usize)
}

fn window(theme: egui::Theme, look: Look) -> Harness<'static, App> {
    let start = Start {
        device: Device::cpu(),
        scene: None,
        look: Some(look),
        size: None,
        panel: None,
        script: Script::default(),
    };
    let builder = Harness::builder().with_size([WIDTH, HEIGHT]).with_theme(theme).wgpu();
    let mut viewer = builder.build_eframe(|window| App::new(window, start));
    viewer.state_mut().settings.panel = None;
    settle(&mut viewer);
    viewer
}

#[test]
fn the_window_looks_as_it_did() {
    let textbook = Look { left: Source::device(Precision::Textbook), split: true, ..look(Mode::Error) };
    let mut results = egui_kittest::SnapshotResults::new();
    for (name, theme, look) in
        [("error-dark", egui::Theme::Dark, textbook), ("stage-light", egui::Theme::Light, look(Mode::Stage))]
    {
        let mut viewer = window(theme, look);
        // The line of speeds at the bottom is the clock's.
        viewer.mask(egui::Rect::from_min_max(egui::pos2(0.0, HEIGHT - 28.0), egui::pos2(WIDTH, HEIGHT)));
        results.add(viewer.try_snapshot_options(name, &options()));
    }
}
