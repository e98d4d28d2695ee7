#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

mod dialects;
mod gltf;
mod gltf_pose;
mod hostile;
mod obj;
mod packed;
mod ply;
mod polygon;
mod scene_file;
mod spheres;
mod stl;
mod write;

use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::reading::{Reading, Told};
use crate::{Error, LoadedScene};
use rayproof_scene::{Mesh, Sphere};

/// The seed of every random test here, printed so that a failure names it.
const SEED: u64 = 0x5ce9e;

fn config(cases: u32) -> ProptestConfig {
    println!("seed {SEED:#x}, {cases} cases");
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(SEED), failure_persistence: None, ..ProptestConfig::default() }
}

/// Reads bytes as a mesh that would have come from `f.ENDING`.
fn parse(ending: &str, bytes: impl AsRef<[u8]>) -> Result<Mesh, Error> {
    told(ending, bytes).map(|(mesh, _)| mesh)
}

/// The same, and what is told of it.
fn told(ending: &str, bytes: impl AsRef<[u8]>) -> Result<(Mesh, LoadedScene), Error> {
    let (file, bytes) = (format!("f.{ending}"), bytes.as_ref());
    let mut told = Told::default();
    let reading = Reading::new(&file, &mut told);
    let mesh = match ending {
        "obj" => super::obj::parse(&file, bytes, reading),
        "ply" => super::ply::parse(&file, bytes, reading),
        "stl" => super::stl::parse(&file, bytes, reading),
        "gltf" | "glb" => super::gltf::parse(Path::new(&file), bytes, reading),
        _ => unreachable!("{ending}"),
    }?;
    Ok((mesh, told.of(rayproof_scene::Scene::default(), None, vec![])))
}

fn csv(file: &str, bytes: &[u8]) -> Result<Vec<Sphere>, Error> {
    super::spheres::csv(file, bytes, Reading::new(file, &mut Told::default()))
}

fn npy(file: &str, bytes: &[u8]) -> Result<Vec<Sphere>, Error> {
    super::spheres::npy(file, bytes, Reading::new(file, &mut Told::default()))
}

/// What is noted of a file that is read.
#[track_caller]
fn notes(ending: &str, bytes: impl AsRef<[u8]>) -> Vec<String> {
    told(ending, bytes).unwrap().1.notes.iter().map(ToString::to_string).collect()
}

/// What is said about bad input.
#[track_caller]
fn message<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
    match result {
        Err(Error::Bad(bad)) => bad.to_string(),
        other => panic!("expected bad input, got {other:?}"),
    }
}

/// A finite f32 of any magnitude.
fn finite() -> impl Strategy<Value = f32> {
    use proptest::num::f32::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

/// A mesh of any finite vertices, some of them in no triangle, and triangles over them.
fn mesh() -> impl Strategy<Value = Mesh> {
    let vertices = prop::collection::vec(prop::array::uniform3(finite()), 1..12);
    vertices.prop_flat_map(|vertices| {
        let index = 0..u32::try_from(vertices.len()).unwrap();
        let triangles = prop::collection::vec(prop::array::uniform3(index), 0..12);
        let vertices: Vec<_> = vertices.into_iter().map(glam::Vec3::from).collect();
        triangles.prop_map(move |triangles| Mesh { vertices: vertices.clone(), triangles })
    })
}

/// Whether two meshes have equal vertices, to the bit, and equal triangles.
#[track_caller]
fn assert_same(read: &Mesh, written: &Mesh) {
    let bits = |mesh: &Mesh| mesh.vertices.iter().map(|v| v.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(bits(read), bits(written));
    assert_eq!(read.triangles, written.triangles);
}

/// Three vertices of its own a triangle.
fn unwelded(mesh: &Mesh) -> Mesh {
    let vertices: Vec<_> = mesh.triangles.iter().flatten().map(|&v| mesh.vertices[v as usize]).collect();
    let count = u32::try_from(vertices.len()).unwrap();
    Mesh { vertices, triangles: (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect() }
}
