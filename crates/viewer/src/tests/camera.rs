//! Moving about, with the pointer and with keys.

use egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use rayproof::scene::Camera;

use super::*;

fn camera(viewer: &Harness<'_, App>) -> Camera {
    viewer.state().standpoint.camera
}

/// Where the picture is on the screen.
fn picture(viewer: &Harness<'_, App>) -> egui::Rect {
    viewer.get_by_label_contains("Picture of").rect()
}

fn button(viewer: &Harness<'_, App>, at: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
    viewer.event_modifiers(egui::Event::PointerButton { pos: at, button, pressed, modifiers }, modifiers);
}

fn drag(viewer: &mut Harness<'_, App>, with: PointerButton, by: Vec2, modifiers: Modifiers) {
    let from = picture(viewer).center() + egui::vec2(20.0, 10.0);
    viewer.hover_at(from);
    viewer.step();
    button(viewer, from, with, true, modifiers);
    viewer.step();
    viewer.event_modifiers(egui::Event::PointerMoved(from + by), modifiers);
    viewer.step();
    button(viewer, from + by, with, false, modifiers);
    settle(viewer);
}

#[test]
fn dragging_moves_the_camera() {
    let mut viewer = viewer(None, look(Mode::Normal));
    let start = camera(&viewer);
    let before = pixels(&viewer);
    drag(&mut viewer, PointerButton::Primary, egui::vec2(15.0, 5.0), Modifiers::NONE);
    let orbited = camera(&viewer);
    let distance = |c: Camera| c.eye.distance(c.target);
    assert!(orbited.target == start.target && orbited.eye != start.eye);
    assert!((distance(orbited) / distance(start) - 1.0).abs() < 1e-5);
    assert_ne!(pixels(&viewer), before);

    drag(&mut viewer, PointerButton::Primary, egui::vec2(15.0, 5.0), Modifiers::SHIFT);
    let panned = camera(&viewer);
    assert!(panned.target != orbited.target);
    assert!((panned.eye - panned.target).distance(orbited.eye - orbited.target) < 1e-4);

    drag(&mut viewer, PointerButton::Secondary, egui::vec2(15.0, 5.0), Modifiers::NONE);
    let turned = camera(&viewer);
    assert!(turned.eye == panned.eye && turned.target != panned.target);

    click(&mut viewer, "Frame");
    assert_eq!(camera(&viewer), start);
    assert_eq!(pixels(&viewer), before);
}

#[test]
fn the_wheel_goes_nearer() {
    let mut viewer = viewer(None, look(Mode::Normal));
    let start = camera(&viewer);
    viewer.hover_at(picture(&viewer).center());
    viewer.step();
    let (unit, delta, modifiers) = (egui::MouseWheelUnit::Point, egui::vec2(0.0, 100.0), Modifiers::NONE);
    viewer.event(egui::Event::MouseWheel {
        unit,
        delta,
        modifiers,
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
    });
    viewer.run_steps(20);
    settle(&mut viewer);
    assert!(
        camera(&viewer).eye.distance(start.target) < 0.8 * start.eye.distance(start.target),
        "{:?}",
        camera(&viewer)
    );
}

#[test]
fn keys_fly_and_choose() {
    let mut viewer = viewer(None, look(Mode::Normal));
    let start = camera(&viewer);
    viewer.key_down(Key::W);
    viewer.run_steps(10);
    viewer.key_up(Key::W);
    settle(&mut viewer);
    let flown = camera(&viewer);
    let ahead = (start.target - start.eye).normalize();
    assert!((flown.eye - start.eye).normalize().dot(ahead) > 0.999, "{flown:?}");
    viewer.key_press(Key::F);
    viewer.key_press(Key::Num3);
    viewer.key_press(Key::X);
    settle(&mut viewer);
    assert_eq!(camera(&viewer), start);
    assert!(viewer.state().settings.look.mode == Mode::Primitive && viewer.state().settings.look.split);
    viewer.key_press(Key::F1);
    settle(&mut viewer);
    assert!(viewer.query_by_label("Keys and pointer").is_some());
}

#[test]
fn keys_that_are_typed_into_a_field_are_no_moves() {
    let mut viewer = viewer(None, look(Mode::Normal));
    let start = camera(&viewer);
    viewer.get_by_role_and_label(egui::accesskit::Role::TextInput, "or path").focus();
    viewer.step();
    viewer.key_press(Key::Num4);
    viewer.key_down(Key::W);
    viewer.run_steps(5);
    assert_eq!((camera(&viewer), viewer.state().settings.look.mode), (start, Mode::Normal));
}

#[test]
fn a_double_click_looks_at_the_point() {
    let mut viewer = viewer(None, look(Mode::Normal));
    let start = camera(&viewer);
    let ball = picture(&viewer).lerp_inside(egui::vec2(0.28, 0.46));
    viewer.hover_at(ball);
    viewer.step();
    for _ in 0..2 {
        button(&viewer, ball, PointerButton::Primary, true, Modifiers::NONE);
        viewer.step();
        button(&viewer, ball, PointerButton::Primary, false, Modifiers::NONE);
        viewer.step();
    }
    let wait = Instant::now();
    while camera(&viewer) == start && wait.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(5));
        viewer.step();
    }
    let target = camera(&viewer).target;
    let center = glam::Vec3::new(-1.2, 0.0, 0.0);
    assert!((target.distance(center) - 1.0).abs() < 1e-4, "{target} is not on the sphere");
}

#[test]
fn the_camera_is_copied_as_it_is() {
    let mut viewer = viewer(Some(&sample()), look(Mode::Normal));
    drag(&mut viewer, PointerButton::Primary, egui::vec2(15.0, 5.0), Modifiers::NONE);
    viewer.get_by_label("Copy").click();
    viewer.step();
    let copied = viewer.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("seen.toml");
    std::fs::write(&file, copied.unwrap()).unwrap();
    assert_eq!(rayproof::files::load(&file).unwrap().camera, Some(camera(&viewer)));
}

#[test]
fn the_distance_keeps_the_size_and_costs_digits() {
    let mut viewer =
        viewer(None, Look { left: crate::Source::device(rayproof::Precision::Textbook), ..look(Mode::Error) });
    let figures = |viewer: &Harness<'_, App>| match viewer.state().tracer.picture().figures[0].clone() {
        Some(crate::model::paint::Figures::Errors(errors)) => errors,
        other => panic!("{other:?}"),
    };
    let hits = |errors: &crate::model::paint::Errors| {
        errors.verdicts[1] as f64 + errors.verdicts[3] as f64 + errors.verdicts[4] as f64
    };
    let errors = [0.0, 4.0].map(|decades| {
        viewer.get_by_role_and_label(egui::accesskit::Role::Slider, "distance").set_value_accesskit(decades);
        settle(&mut viewer);
        figures(&viewer)
    });
    println!("{errors:?}");
    assert!((hits(&errors[1]) / hits(&errors[0]) - 1.0).abs() < 0.3, "the size has changed");
    let median = errors.each_ref().map(|errors| errors.ulps.unwrap()[0]);
    assert!(errors[0].wrong() == 0 && errors[1].wrong() > 100 && median[1] > 10 * median[0].max(1));
}
