//! What is not seen: labels for those who cannot see, what is kept from run to run, and one device for kernels and window.

use std::collections::HashMap;

use eframe::egui_wgpu::{WgpuSetup, WgpuSetupExisting};
use egui::accesskit::Role;
use egui_kittest::kittest::NodeT as _;
use egui_kittest::wgpu::WgpuTestRenderer;
use rayproof::{DeviceChoice, Precision};

use super::*;
use crate::act::Act;
use crate::model::look::Source;
use crate::panels::inspector::Picked;
use crate::settings::{Panel, Settings};

/// Controls that do something.
const CONTROLS: [Role; 9] = [
    Role::Button,
    Role::CheckBox,
    Role::ComboBox,
    Role::RadioButton,
    Role::Slider,
    Role::SpinButton,
    Role::TextInput,
    Role::Link,
    Role::Image,
];

#[test]
fn every_control_has_a_label() {
    let mut split = look(Mode::Error);
    split.split = true;
    let mut viewer = viewer(Some(&sample()), split);
    let mut seen = HashMap::new();
    for panel in ["Inspector", "Gallery", "Plot", "Help"] {
        if viewer.state().settings.panel.is_none_or(|open| format!("{open:?}") != panel) {
            click(&mut viewer, panel);
        }
        if panel == "Inspector" {
            let (context, size) = (viewer.ctx.clone(), viewer.state().canvas.size);
            let ray = Picked::through(&viewer.state().standpoint.camera, size, [48, 40]);
            viewer.state_mut().apply(&context, [Act::Inspect(ray, None)]);
            settle(&mut viewer);
        }
        if panel == "Gallery" {
            click(&mut viewer, "family >");
        }
        for role in CONTROLS {
            for node in viewer.query_all_by_role(role) {
                let node = node.accesskit_node();
                let label = node.label().filter(|label| !label.trim().is_empty());
                assert!(
                    label.is_some(),
                    "in {panel} a {role:?} without a label: {:?}, {:?}",
                    node.value(),
                    node.bounding_box()
                );
                *seen.entry(role).or_insert(0) += 1;
            }
        }
    }
    println!("{seen:?}");
    assert!(seen.values().sum::<usize>() > 80);
}

/// Storage that keeps nothing on a disk.
#[derive(Default)]
struct Kept(HashMap<String, String>);

impl eframe::Storage for Kept {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.to_owned(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}

#[test]
fn the_last_scene_and_mode_come_back() {
    let mut kept = Kept::default();
    {
        let mut viewer = viewer(Some(&sample()), look(Mode::Depth));
        click(&mut viewer, "Gallery");
        eframe::App::save(viewer.state_mut(), &mut kept);
    }
    let start = Start {
        device: Device::cpu(),
        scene: None,
        look: None,
        size: Some(SIZE),
        panel: None,
        script: Script::default(),
    };
    let mut viewer = Harness::builder().with_size([1280.0, 800.0]).build_eframe(|window| {
        window.storage = Some(&kept);
        App::new(window, start)
    });
    settle(&mut viewer);
    let state = viewer.state();
    assert_eq!((state.standpoint.world.name.as_str(), state.settings.look.mode), ("sample.toml", Mode::Depth));
    assert_eq!(state.settings.panel, Some(Panel::Gallery));
}

#[test]
fn what_another_version_kept_is_no_trouble() {
    let mut kept = Kept::default();
    for text in ["", "nonsense", "(scene: 3)", "(look: (mode: Gone))"] {
        eframe::Storage::set_string(&mut kept, "rayproof-viewer", text.to_owned());
        let _ = Settings::kept(&kept);
    }
    eframe::Storage::set_string(&mut kept, "rayproof-viewer", "(split_at: 0.25, of_tomorrow: 1)".to_owned());
    assert_eq!(Settings::kept(&kept).map(|settings| settings.split_at), Some(0.25));
}

#[test]
fn one_device_runs_the_kernels_and_paints_the_window() {
    let device = Device::open(&DeviceChoice::Gpu).expect("tests need a Vulkan adapter");
    let rayproof::Handles { instance, adapter, device: shared, queue } = device.handles().unwrap();
    let setup = WgpuSetup::Existing(WgpuSetupExisting { instance, adapter, device: shared, queue });
    let look = Look { left: Source::device(Precision::Fast), ..look(Mode::Primitive) };
    let start = Start {
        device,
        scene: Some(sample()),
        look: Some(look),
        size: Some(SIZE),
        panel: None,
        script: Script::default(),
    };
    let builder = Harness::builder().with_size([760.0, 520.0]).renderer(WgpuTestRenderer::from_setup(setup));
    let mut viewer = builder.build_eframe(|window| App::new(window, start));
    viewer.state_mut().settings.panel = None;
    settle(&mut viewer);
    let window = viewer.render().unwrap();
    let rect = viewer.get_by_label_contains("Picture of").rect();
    // A pixel of the picture is one of the window.
    let (_, pixels) = viewer.state().pixels();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a pixel of the window")]
    let [left, top] = [rect.left(), rect.top()].map(|x| x.round() as u32);
    let place = |i: u32| window.get_pixel(left + i % SIZE[0], top + i / SIZE[0]).0;
    let same = (0..).zip(&pixels).filter(|&(i, pixel)| place(i)[..3] == pixel[..]).count();
    println!("{same} of {} pixels of the picture are in the window", pixels.len());
    assert!(same == pixels.len() && pixels.iter().any(|pixel| *pixel != pixels[0]));
}
