//! What keys do.

use egui::{Context, Key, Modifiers};
use rayproof::scene::Camera;

use crate::act::Act;
use crate::model::look::{Look, Mode};
use crate::model::navigate;
use crate::settings::Panel;

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
    ("X", "split the picture between two precisions"),
    ("F", "frame the scene"),
    ("C", "copy the camera as a [camera] table"),
    ("P", "save the picture as PNG"),
    ("F12", "save the window as PNG, legend and panels included"),
    ("F1, F2, F3, F4", "help, inspector, gallery, plot"),
];

const DIGITS: [Key; 9] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];

/// What was pressed, to be done.
pub(crate) fn pressed(context: &Context, mut look: Look, camera: &Camera) -> Vec<Act> {
    let mut acts = Vec::new();
    let panels = [Panel::Help, Panel::Inspector, Panel::Gallery, Panel::Plot];
    for (key, panel) in [Key::F1, Key::F2, Key::F3, Key::F4].into_iter().zip(panels) {
        if context.input(|i| i.key_pressed(key)) {
            acts.push(Act::Toggle(panel));
        }
    }
    if context.input(|i| i.key_pressed(Key::F12)) {
        acts.push(Act::SaveWindow);
    }
    // What is typed into a control is not for the camera.
    if context.egui_wants_keyboard_input() || context.memory(|memory| memory.focused().is_some()) {
        return acts;
    }
    let pressed = |key| context.input(|i| i.key_pressed(key) && !i.modifiers.command && !i.modifiers.alt);
    let before = look;
    for (key, mode) in DIGITS.into_iter().zip(Mode::ALL) {
        if pressed(key) {
            look.mode = mode;
        }
    }
    look.split ^= pressed(Key::X);
    acts.extend((look != before).then_some(Act::Show(look)));
    acts.extend(flown(context, camera).map(Act::See));
    acts.extend(pressed(Key::F).then_some(Act::Frame));
    acts.extend(pressed(Key::C).then(|| Act::copy_camera(camera)));
    acts.extend(pressed(Key::P).then_some(Act::SavePicture));
    acts
}

/// Where the camera is moved to while keys are down.
fn flown(context: &Context, camera: &Camera) -> Option<Camera> {
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
        return None;
    }
    let mut camera = *camera;
    let [right, up, forward, around, over, near] = held.map(|axis| axis * seconds);
    if [right, up, forward] != [0.0; 3] {
        camera = navigate::fly(&camera, [right * 0.6, up * 0.6, forward * 0.6]);
    }
    if [around, over] != [0.0; 2] {
        camera = navigate::orbit(&camera, around, over);
    }
    if near != 0.0 {
        camera = navigate::dolly(&camera, (-near).exp());
    }
    context.request_repaint();
    Some(camera)
}
