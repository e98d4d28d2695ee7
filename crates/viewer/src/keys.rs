//! What keys do.

use egui::{Context, Key, Modifiers};

use crate::app::App;
use crate::model::look::Mode;
use crate::model::navigate;
use crate::panels;
use crate::settings::Side;

/// The keys and the pointer, for people.
pub(crate) const HELP: [(&str, &str); 17] = [
    ("drag", "orbit around the target"),
    ("Shift + drag, middle drag", "pan"),
    ("right drag", "look around"),
    ("scroll", "nearer, farther"),
    ("Ctrl + scroll, pinch", "zoom"),
    ("click", "inspect the pixel's ray"),
    ("double-click", "look at that point"),
    ("W A S D, E Q", "fly forward, left, back, right, up, down; with Shift faster"),
    ("arrows", "orbit"),
    ("+ and -", "nearer, farther"),
    ("1 to 9", "what pixels show"),
    ("X", "split the picture between two methods"),
    ("F", "frame the scene"),
    ("C", "copy the camera as a [camera] table"),
    ("P", "save the picture as PNG"),
    ("F12", "save the window as PNG, legend and panels included"),
    ("F1, F2, F3, F4", "help, inspector, gallery, plot"),
];

const DIGITS: [Key; 9] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];

/// Does what was pressed.
pub(crate) fn act(app: &mut App, context: &Context) {
    for (key, side) in
        [(Key::F1, Side::Help), (Key::F2, Side::Inspector), (Key::F3, Side::Gallery), (Key::F4, Side::Plot)]
    {
        if context.input(|i| i.key_pressed(key)) {
            app.settings.side = Some(side).filter(|side| app.settings.side != Some(*side));
        }
    }
    if context.input(|i| i.key_pressed(Key::F12)) {
        panels::toolbar::save_window(app, context);
    }
    // What is typed into a control is not for the camera.
    if context.egui_wants_keyboard_input() || context.memory(|memory| memory.focused().is_some()) {
        return;
    }
    let pressed = |key| context.input(|i| i.key_pressed(key) && !i.modifiers.command && !i.modifiers.alt);
    for (key, mode) in DIGITS.into_iter().zip(Mode::ALL) {
        if pressed(key) {
            app.settings.look.mode = mode;
        }
    }
    if pressed(Key::X) {
        app.settings.look.split ^= true;
    }
    if pressed(Key::F) {
        app.frame();
    }
    if pressed(Key::C) {
        panels::view::copy_camera(app, context);
    }
    if pressed(Key::P) {
        app.saving = true;
    }
    fly(app, context);
}

/// Moves the camera for as long as keys are down.
fn fly(app: &mut App, context: &Context) {
    let (held, seconds) = context.input(|i| {
        let quiet = i.modifiers.matches_logically(Modifiers::NONE) || i.modifiers.shift_only();
        let held = |key| if quiet && i.key_down(key) { 1.0 } else { 0.0 };
        let axes = [
            held(Key::D) - held(Key::A),
            held(Key::E) - held(Key::Q),
            held(Key::W) - held(Key::S),
            held(Key::ArrowRight) - held(Key::ArrowLeft),
            held(Key::ArrowUp) - held(Key::ArrowDown),
            held(Key::Plus) + held(Key::Equals) - held(Key::Minus),
        ];
        let speed = if i.modifiers.shift { 4.0 } else { 1.0 };
        (axes.map(|axis: f64| axis * speed), f64::from(i.stable_dt.min(0.1)))
    });
    if held == [0.0; 6] {
        return;
    }
    let [right, up, forward, around, over, near] = held.map(|axis| axis * seconds);
    if [right, up, forward] != [0.0; 3] {
        app.camera = navigate::fly(&app.camera, [right * 0.6, up * 0.6, forward * 0.6]);
    }
    if [around, over] != [0.0; 2] {
        app.camera = navigate::orbit(&app.camera, around, over);
    }
    if near != 0.0 {
        app.camera = navigate::dolly(&app.camera, (-near).exp());
    }
    context.request_repaint();
}
