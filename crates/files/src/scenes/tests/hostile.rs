//! Whatever the bytes, an answer or an error.

use glam::Vec3;
use proptest::prelude::*;

use super::{config, csv, npy, parse, write};
use crate::Error;
use rayproof_scene::Mesh;

/// Reads bytes by any of the readers.
fn read(reader: &str, bytes: &[u8]) -> Result<(), Error> {
    match reader {
        "csv" => csv("f.csv", bytes).map(drop),
        "npy" => npy("f.npy", bytes).map(drop),
        ending => {
            let mesh = parse(ending, bytes)?;
            // What is read can be used.
            assert!((0..mesh.triangles.len()).all(|i| mesh.triangle(i).a.is_finite()));
            Ok(())
        }
    }
}

/// A good file of each kind, and whether each part of one is bad.
fn samples() -> Vec<(&'static str, Vec<u8>, bool)> {
    let vertices = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.25, -3e-5, 1e9)];
    let mesh = Mesh { vertices, triangles: vec![[0, 1, 2], [3, 2, 1], [1, 1, 1]] };
    let (json, bin) = write::gltf(&mesh, r#", "rotation": [0, 0, 0, 1]"#, "", "");
    let uri = format!(r#""uri": "data:application/octet-stream;base64,{}", "byteLength": 84"#, "AAAA".repeat(28));
    let spheres: Vec<u8> = (0..8_u8).flat_map(|i| f32::from(i).to_le_bytes()).collect();
    vec![
        ("obj", write::obj(&mesh).into_bytes(), false),
        ("ply", write::ply(&mesh, "ascii", "float"), false),
        ("ply", write::ply(&mesh, "binary_little_endian", "float"), true),
        ("ply", write::ply(&mesh, "binary_big_endian", "double"), true),
        ("stl", write::stl_ascii(&mesh).into_bytes(), false),
        ("stl", write::stl_binary(&mesh, "binary"), true),
        ("glb", write::glb(&json, &bin), true),
        ("gltf", json.replace(r#""byteLength": 84"#, &uri).into_bytes(), true),
        ("npy", write::npy("<f4", "False", "(2, 4)", &spheres), true),
        ("csv", b"x,y,z,r\n1,2,3,4\n-5e3,6,7,8\n".to_vec(), false),
    ]
}

#[test]
fn the_whole_is_good_and_no_part_of_a_binary_is() {
    for (reader, bytes, binary) in samples() {
        read(reader, &bytes).unwrap();
        for end in 0..bytes.len() {
            let result = read(reader, &bytes[..end]);
            assert!(!binary || matches!(result, Err(Error::Bad(_))), "{reader} of {end} bytes: {result:?}");
        }
    }
}

#[test]
fn a_flipped_byte_is_no_reason_to_panic() {
    for (reader, bytes, _) in samples() {
        let (mut good, mut bad) = (0, 0);
        for at in 0..bytes.len() {
            for flip in [1, 2, 4, 8, 0x10, 0x20, 0x40, 0x80, 0xff, bytes[at] ^ b'9', bytes[at] ^ b'-'] {
                let mut changed = bytes.clone();
                changed[at] ^= flip;
                match read(reader, &changed) {
                    Ok(()) => good += 1,
                    Err(Error::Bad(_)) => bad += 1,
                    Err(e) => assert_eq!(reader, "gltf", "{e}"),
                }
            }
        }
        println!("{reader}: {} bytes, {good} changes still read, {bad} refused", bytes.len());
        assert!(good > 0 && bad > 0);
    }
}

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn random_bytes_are_no_reason_to_panic(
        sample in prop::sample::select(samples()),
        keep in 0..400_usize,
        noise in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        let (reader, bytes, _) = sample;
        let _ = read(reader, &noise);
        let _ = read(reader, &[&bytes[..keep.min(bytes.len())], &noise].concat());
    }

    #[test]
    fn random_words_are_no_reason_to_panic(
        sample in prop::sample::select(samples()),
        at in any::<prop::sample::Index>(),
        word in "[-+0-9eE.(){}\\[\\],:'\" a-z/\n]{0,12}",
    ) {
        let (reader, mut bytes, _) = sample;
        let at = at.index(bytes.len());
        bytes.splice(at..at, word.bytes());
        let _ = read(reader, &bytes);
    }

    #[test]
    fn random_scene_files_are_no_reason_to_panic(text in "(\\[\\[geometry\\]\\]\n|\\[camera\\]\n|eye = |spheres = |\\[|\\]|[0-9],|nan|\n|\"|=){0,30}") {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("f.toml");
        std::fs::write(&path, text).unwrap();
        let _ = crate::load(&path);
    }
}
