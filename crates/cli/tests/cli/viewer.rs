//! The viewer's pictures against those of `rayproof render`: the same pixels for the same camera.

use std::path::Path;
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use rayproof::{Device, DeviceChoice, Precision};
use rayproof_viewer::{App, Look, Mode, Script, Source, Start};

use super::Folder;

const SIZE: [u32; 2] = [320, 240];

/// The viewer on a scene, without a window.
fn viewer(device: &DeviceChoice, scene: &Path, look: Look) -> Harness<'static, App> {
    let device = Device::open(device).unwrap();
    let (scene, look) = (Some(scene.to_owned()), Some(look));
    let start = Start { device, scene, look, size: Some(SIZE), panel: None, script: Script::default() };
    let mut viewer = Harness::builder().with_size([1280.0, 800.0]).build_eframe(|window| App::new(window, start));
    settle(&mut viewer);
    viewer
}

fn settle(viewer: &mut Harness<'_, App>) {
    let start = Instant::now();
    viewer.run_steps(2);
    while !viewer.state().is_settled() {
        assert!(start.elapsed() < Duration::from_secs(120), "the viewer does not come to rest");
        std::thread::sleep(Duration::from_millis(2));
        viewer.step();
    }
}

/// Asserts that the picture is the one that the command line draws of a scene.
fn compare(folder: &Folder, scene: &str, viewer: &Harness<'_, App>, options: &str) {
    let [width, height] = SIZE;
    folder.run(&format!("render {scene} -o drawn.png --size {width}x{height} {options}")).expect(0, &[]);
    let drawn = image::open(folder.path("drawn.png")).unwrap().to_rgb8();
    let (size, shown) = viewer.state().pixels();
    assert_eq!((size, drawn.dimensions()), (SIZE, (width, height)));
    let different = drawn.pixels().zip(&shown).filter(|(drawn, shown)| drawn.0 != **shown).count();
    println!("{scene}, {options}: {different} of {} pixels differ", shown.len());
    assert_eq!(different, 0, "{scene}, {options}");
}

#[test]
fn the_viewer_draws_what_render_writes() {
    let folder = Folder::with_sample();
    for (mode, show) in
        [(Mode::Primitive, "primitive"), (Mode::Normal, "normal"), (Mode::Depth, "depth"), (Mode::Uv, "uv")]
    {
        for precision in [Precision::Fast, Precision::Exact] {
            let look = Look { mode, left: Source::device(precision), ..Look::default() };
            let viewer = viewer(&DeviceChoice::Cpu, &folder.path("sample.toml"), look);
            let options = format!("--show {show} --precision {} --device cpu", precision.name());
            compare(&folder, "sample.toml", &viewer, &options);
        }
    }
    // Without a camera of its own, and on the device.
    let look = Look { mode: Mode::Primitive, ..Look::default() };
    let viewer = viewer(&DeviceChoice::Gpu, &folder.path("knot.obj"), look);
    compare(&folder, "knot.obj", &viewer, "--show primitive --device gpu");
}

#[test]
fn a_camera_that_was_copied_draws_the_same_picture() {
    let folder = Folder::with_sample();
    let look = Look { mode: Mode::Primitive, ..Look::default() };
    let mut viewer = viewer(&DeviceChoice::Cpu, &folder.path("sample.toml"), look);
    let before = viewer.state().pixels().1;
    for key in [egui::Key::ArrowRight, egui::Key::W, egui::Key::E] {
        viewer.key_down(key);
        viewer.run_steps(7);
        viewer.key_up(key);
        viewer.step();
    }
    settle(&mut viewer);
    assert_ne!(viewer.state().pixels().1, before, "the camera has not moved");
    viewer.get_by_label("Copy").click();
    viewer.step();
    let table = viewer.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let scene = String::from_utf8(folder.read("sample.toml")).unwrap();
    let geometry = scene.split("[camera]").next().unwrap();
    folder.write("moved.toml", format!("{geometry}{}", table.unwrap()));
    compare(&folder, "moved.toml", &viewer, "--show primitive --device cpu");
}
