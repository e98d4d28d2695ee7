//! The viewer without a window: every control is found by its label and used, and what it draws is compared.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

mod access;
mod camera;
mod faults;
mod modes;
mod panels;
mod snapshots;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use rayproof::Device;
use rayproof_picture::color::Rgb;

use crate::app::{App, Start};
use crate::model::look::{Look, Mode};
use crate::script::Script;

/// The picture in most tests: small, so that the oracle can judge all of it.
const SIZE: [u32; 2] = [96, 72];

/// The repository's sample scene.
fn sample() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/sample.toml")
}

/// A viewer on the CPU engine.
fn viewer(scene: Option<&Path>, look: Look) -> Harness<'static, App> {
    let start = Start {
        device: Device::cpu(),
        scene: scene.map(Path::to_owned),
        look: Some(look),
        size: Some(SIZE),
        panel: None,
        script: Script::default(),
    };
    viewer_of(start)
}

fn viewer_of(start: Start) -> Harness<'static, App> {
    let builder = Harness::builder().with_size([1280.0, 800.0]).with_theme(egui::Theme::Dark).with_step_dt(1.0 / 60.0);
    let mut viewer = builder.build_eframe(|window| App::new(window, start));
    settle(&mut viewer);
    viewer
}

/// Paints frames until all is traced and judged.
fn settle(viewer: &mut Harness<'_, App>) {
    let start = Instant::now();
    // The first frame after an event sends it on.
    viewer.run_steps(2);
    while !viewer.state().is_settled() {
        assert!(start.elapsed() < Duration::from_secs(120), "{:?}", viewer.state().tracer.picture().progress);
        std::thread::sleep(Duration::from_millis(2));
        viewer.step();
    }
    viewer.run_steps(2);
}

/// Clicks what has this label.
fn click(viewer: &mut Harness<'_, App>, label: &str) {
    viewer.get_by_label(label).click();
    settle(viewer);
}

/// Picks an entry of a list.
fn choose(viewer: &mut Harness<'_, App>, list: &str, entry: &str) {
    viewer.get_by_role_and_label(egui::accesskit::Role::ComboBox, list).click();
    viewer.run_steps(3);
    viewer.get_by_role_and_label(egui::accesskit::Role::Button, entry).click();
    settle(viewer);
}

/// The pixels of the left-hand side.
fn pixels(viewer: &Harness<'_, App>) -> Vec<Rgb> {
    let (size, pixels) = viewer.state().pixels();
    assert_eq!(size, SIZE);
    pixels
}

fn look(mode: Mode) -> Look {
    Look { mode, ..Look::default() }
}
