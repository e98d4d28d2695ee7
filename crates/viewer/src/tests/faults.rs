//! Files: opened, dropped, unreadable.

use std::sync::Arc;

use super::*;

/// A file that is dropped on the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|e| e.to_string())
    }
}

fn drop_file(viewer: &mut Harness<'_, App>, path: PathBuf) {
    viewer.input_mut().dropped_files.push(Arc::new(Dropped(path)));
    viewer.step();
    viewer.input_mut().dropped_files.clear();
    settle(viewer);
}

#[test]
fn a_dropped_file_is_opened() {
    let mut viewer = viewer(None, look(Mode::Primitive));
    let before = pixels(&viewer);
    drop_file(&mut viewer, sample());
    assert_eq!(viewer.state().standpoint.world.scene.count(rayproof::scene::Kind::Triangle), 12_800);
    assert!(viewer.query_by_label_contains("12,800 triangles, 8 spheres").is_some());
    assert_ne!(pixels(&viewer), before);
}

#[test]
fn a_typed_path_is_opened() {
    let mut viewer = viewer(None, look(Mode::Normal));
    let field = viewer.get_by_role_and_label(egui::accesskit::Role::TextInput, "or path");
    field.focus();
    field.type_text(&sample().display().to_string());
    viewer.step();
    viewer.key_press(egui::Key::Enter);
    settle(&mut viewer);
    assert_eq!(viewer.state().standpoint.world.name, "sample.toml");
}

#[test]
fn a_bad_file_is_a_message_and_the_scene_stays() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(Some(&sample()), look(Mode::Normal));
    let before = pixels(&viewer);
    let cases: [(&str, &[u8], &str); 6] = [
        ("bad.obj", b"v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", "line 2"),
        ("bad.toml", b"[[geometry]]\nspheres = [[0, 0, 0, -1]]\n", "sphere 0"),
        ("bad.ply", b"ply\nformat ascii 1.0\nelement vertex 9\n", "bad.ply"),
        ("bad.glb", &[0; 64], "bad.glb"),
        ("picture.png", b"\x89PNG", "picture.png"),
        ("empty.stl", b"", "empty.stl"),
    ];
    for (name, bytes, says) in cases {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        drop_file(&mut viewer, path);
        assert!(viewer.query_by_label_contains("could not be opened").is_some(), "{name} was opened");
        assert!(viewer.query_by_label_contains(says).is_some(), "{name}: {:?}", viewer.state().opener.fault);
        assert_eq!(pixels(&viewer), before, "{name}");
        click(&mut viewer, "Dismiss");
        assert!(viewer.query_by_label_contains("could not be opened").is_none());
    }
    drop_file(&mut viewer, folder.path().join("gone.ply"));
    assert!(viewer.query_by_label_contains("gone.ply").is_some());
    drop_file(&mut viewer, sample());
    assert_eq!(viewer.state().opener.fault, None);
}

#[test]
fn scenes_of_nothing_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.toml");
    std::fs::write(&path, "").unwrap();
    let mut viewer = viewer(Some(&path), look(Mode::Normal));
    for mode in Mode::ALL {
        click(&mut viewer, mode.name());
        let first = pixels(&viewer)[0];
        assert!(pixels(&viewer).iter().all(|&pixel| pixel == first), "{mode:?}");
    }
    let at = viewer.get_by_label_contains("Picture of").rect().center();
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        viewer.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        viewer.step();
    }
    settle(&mut viewer);
    assert!(viewer.state().inspector.picked.is_some());
}
