//! `rayproof render`: pictures.

use std::collections::HashSet;

use super::{Folder, shipped};

const MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR";

/// The size that a PNG's header tells.
fn size(png: &[u8]) -> (u32, u32) {
    let rest = png.strip_prefix(MAGIC).unwrap();
    let number = |at: usize| u32::from_be_bytes(rest[at..at + 4].try_into().unwrap());
    assert_eq!(&png[png.len() - 8..png.len() - 4], b"IEND");
    (number(0), number(4))
}

#[test]
fn every_kind_of_picture_has_the_size_asked_for_and_is_the_same_in_every_run() {
    let folder = Folder::with_scene();
    let mut different = HashSet::new();
    for show in ["normal", "depth", "primitive", "uv", "error"] {
        let line = format!("render scene.toml -o picture.png --show {show} --size 90x70 --device cpu");
        folder.run(&line).expect(0, &["CPU", "picture.png"]);
        let picture = folder.read("picture.png");
        assert_eq!(size(&picture), (90, 70), "{show}");
        let piped = folder.run(&line.replace("picture.png", "-")).expect(0, &[]).stdout;
        assert!(piped == picture, "{show}");
        different.insert(picture);
    }
    assert_eq!(different.len(), 5);
    folder.run("render scene.toml -o picture.PNG --device cpu").expect(0, &[]);
    assert_eq!(size(&folder.read("picture.PNG")), (800, 600));
}

#[test]
fn the_error_picture_shows_what_the_precision_costs() {
    let folder = Folder::new();
    let camera = "[camera]\neye = [0, 0, 20000]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y = 0.008\n";
    folder.write("far.toml", format!("[[geometry]]\nspheres = [[0.0, 0.0, 0.0, 1.0]]\n{camera}"));
    let make = |precision: &str| {
        let line = format!(
            "render far.toml -o {precision}.png --show error --precision {precision} --size 50x50 --device cpu"
        );
        folder.run(&line).expect(0, &[]);
        folder.read(&format!("{precision}.png"))
    };
    assert!(make("fast") != make("classic"));
    // No error and no wrong answer: two colours, of the hits and of the background.
    assert!(colors(&make("exact")) == 2 && colors(&make("fast")) > 2);
}

#[test]
fn the_tier_picture_shows_what_f32_leaves_open() {
    let folder = Folder::new();
    folder.write("near.toml", "[[geometry]]\nspheres = [[0.0, 0.0, 0.0, 1.0], [3.0, 0.0, 0.0, 1e-3]]\n");
    for device in ["cpu", "gpu"] {
        let line = format!("render near.toml -o tier.png --show tier --size 64x64 --device {device}");
        folder.run(&line).expect(0, &[]);
        assert!((1..=3).contains(&colors(&folder.read("tier.png"))));
    }
    folder.run("render near.toml -o none.png --show tier --precision fast").expect(2, &["--precision exact"]);
}

/// A rounding may move an edge by a pixel here and there; a scene, camera or shading that has changed moves far more.
#[test]
fn the_picture_in_the_readme_is_the_sample() {
    let folder = Folder::with_sample();
    folder.run("render sample.toml -o drawn.png --device cpu").expect(0, &[]);
    let [drawn, shown] =
        [folder.path("drawn.png"), shipped("sample.png")].map(|path| image::open(path).unwrap().to_rgb8());
    assert_eq!(drawn.dimensions(), shown.dimensions());
    let different = drawn.pixels().zip(shown.pixels()).filter(|(a, b)| a != b).count();
    println!("{different} of {} pixels differ", drawn.pixels().len());
    assert!(
        different * 1000 <= drawn.pixels().len(),
        "{different} pixels differ: `rayproof render tests/data/sample.toml -o tests/data/sample.png`, and look at it"
    );
}

/// How many colours a picture has.
fn colors(png: &[u8]) -> usize {
    let picture = image::load_from_memory(png).unwrap().to_rgb8();
    picture.pixels().map(|pixel| pixel.0).collect::<std::collections::BTreeSet<_>>().len()
}
