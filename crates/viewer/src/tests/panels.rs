//! The panels on the right: one ray, the hard cases, speed against error.

use egui_kittest::kittest::NodeT as _;
use rayproof::Precision;

use super::*;
use crate::model::gallery::all;

fn click_picture(viewer: &mut Harness<'_, App>, share: egui::Vec2) {
    let pos = viewer.get_by_label_contains("Picture of").rect().lerp_inside(share);
    viewer.hover_at(pos);
    viewer.step();
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        viewer.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        viewer.step();
    }
    settle(viewer);
}

fn copied(viewer: &Harness<'_, App>) -> String {
    let commands = &viewer.output().platform_output.commands;
    let text = commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    text.expect("nothing was copied")
}

#[test]
fn a_click_reads_the_whole_calculation() {
    let mut viewer = viewer(None, look(Mode::Normal));
    assert!(viewer.query_by_label_contains("Click a pixel").is_some());
    // The sphere is on the left, the mesh on the right.
    click_picture(&mut viewer, egui::vec2(0.28, 0.46));
    for quantity in ["A", "B", "C", "D", "q", "t1", "t2", "r^2 - l.l"] {
        assert!(viewer.query_by_label(quantity).is_some(), "{quantity}");
    }
    assert!(viewer.query_by_label("Sphere 0 of geometry 0").is_some());
    click_picture(&mut viewer, egui::vec2(0.75, 0.53));
    for quantity in ["det", "det u", "det v", "det t", "u", "v", "t"] {
        assert!(viewer.query_all_by_label(quantity).next().is_some(), "{quantity}");
    }
    assert!(viewer.query_by_label_contains("of geometry 1").is_some());
    let inspection = viewer.state().inspector.result.clone().unwrap().unwrap();
    assert!(inspection.truth.is_hit() && inspection.hits[5].same_bits(&inspection.truth));
}

#[test]
fn what_is_copied_replays_to_the_bit() {
    let mut viewer = viewer(Some(&sample()), look(Mode::Normal));
    let mut replayed = 0;
    for share in [[0.5, 0.5], [0.3, 0.8], [0.7, 0.6], [0.2, 0.9], [0.05, 0.05]] {
        click_picture(&mut viewer, share.into());
        for (place, precision) in Precision::ALL.into_iter().enumerate() {
            viewer.state_mut().inspector.handed = Some(precision);
            viewer.step();
            viewer.get_by_label("Copy as a one-ray case").click();
            viewer.step();
            let text = copied(&viewer);
            let inspection = viewer.state().inspector.result.clone().unwrap().unwrap();
            replayed += usize::from(inspection.hits[place].is_hit());
            // The files between the marks, read as `rayproof intersect` reads them.
            let files: Vec<&str> =
                text.split("<<'END'\n").skip(1).map(|part| part.split("END\n").next().unwrap()).collect();
            let folder = tempfile::tempdir().unwrap();
            let [scene, rays] = ["ray.toml", "ray.csv"].map(|name| folder.path().join(name));
            std::fs::write(&scene, files[0]).unwrap();
            std::fs::write(&rays, files[1]).unwrap();
            let loaded = rayproof::files::load(&scene).unwrap();
            let numbers =
                files[1].lines().nth(1).unwrap().split(',').map(|x| rayproof::scene::number::parse(x).unwrap());
            let [ox, oy, oz, dx, dy, dz, t_min, t_max] = numbers.collect::<Vec<_>>().try_into().unwrap();
            let ray =
                rayproof::scene::Ray { origin: [ox, oy, oz].into(), direction: [dx, dy, dz].into(), t_min, t_max };
            assert_eq!(ray, inspection.ray);
            let options =
                rayproof::Options { precision, device: rayproof::DeviceChoice::Cpu, ..rayproof::Options::default() };
            let engine = rayproof::Intersector::new(&loaded.scene, &options).unwrap();
            let mut hit = [rayproof::scene::FlatHit::MISS];
            engine.closest_flat(&[ray], &mut hit).unwrap();
            let [again, before] = [hit[0], inspection.hits[place]].map(|h| [h.t, h.u, h.v].map(f32::to_bits));
            // Alone, a primitive may be scaled otherwise, and the text then says so; here none is.
            assert!(again == before && !text.starts_with('#'), "{precision:?}: {text}");
            assert!(text.contains(&format!("--precision {}", precision.name())));
        }
    }
    assert!(replayed > 15, "{replayed}");
}

#[test]
fn the_gallery_steps_through_all_families() {
    let mut viewer = viewer(None, look(Mode::Verdict));
    click(&mut viewer, "Gallery");
    for family in all() {
        click(&mut viewer, "family >");
        assert!(viewer.query_by_label(family.stresses).is_some(), "{}", family.name);
        let shown = format!("Picture of family {}, {}", family.number, family.name);
        assert!(viewer.query_by_label_contains(&shown).is_some(), "{shown}");
        assert!(viewer.state().gallery.hung.as_ref().is_some_and(|hung| !hung.rays.is_empty()));
    }
    click(&mut viewer, "family >");
    assert_eq!(viewer.state().gallery.hung.as_ref().map(|hung| hung.family), Some(0));
    click(&mut viewer, "scene >");
    assert_eq!(viewer.state().gallery.hung.as_ref().map(|hung| hung.number), Some(1));
    click(&mut viewer, "< scene");
    click(&mut viewer, "< family");
    assert_eq!(viewer.state().gallery.hung.as_ref().map(|hung| hung.family), Some(all().len() - 1));
}

#[test]
fn a_ray_of_the_gallery_is_inspected() {
    let mut viewer = viewer(None, look(Mode::Normal));
    click(&mut viewer, "Gallery");
    choose(&mut viewer, "family", "4 exact tangent");
    let first = viewer.state().gallery.hung.as_ref().unwrap().rays[0].clone();
    let row = viewer
        .query_all_by_role(egui::accesskit::Role::Button)
        .find(|node| node.accesskit_node().label().is_some_and(|l| l.trim_start().starts_with("0 ")))
        .unwrap();
    row.click();
    settle(&mut viewer);
    let inspection = viewer.state().inspector.result.clone().unwrap().unwrap();
    assert_eq!(inspection.ray, first.ray);
    assert!(inspection.hits.iter().zip(&first.hits).all(|(a, b)| a.same_bits(b)));
}

#[test]
fn speed_and_error_are_plotted() {
    let mut viewer = viewer(None, look(Mode::Normal));
    click(&mut viewer, "Plot");
    settle(&mut viewer);
    let (_, measured) = viewer.state().plot.measured.clone().unwrap();
    assert_eq!(measured.unwrap().len(), 6);
    assert!(viewer.query_by_label("Measure again").is_some());
}
