//! Scenes from files: one module a format, and what they say about bad input.

mod faces;
mod gltf;
mod gltf_data;
mod gltf_json;
mod lines;
mod obj;
mod ply;
mod ply_header;
mod ply_payload;
mod polygon;
mod reading;
mod scene_file;
mod spheres;
mod stl;
#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use glam::DVec3;

pub(crate) use self::reading::is_flat;
use self::reading::{Reading, Told};
use crate::gzip::{unpack, unpacked_name};
use crate::quote::quoted;
use crate::{Error, Note, Rounding};
use rayproof_scene::{Camera, Geometry, Mesh, Scene};

/// What is subtracted from every point of a scene, exactly, before it is rounded: far from 0 an `f32` has few digits left. It must
/// be subtracted from the rays, too ([`RayReader::subtract`](crate::RayReader::subtract)); `t`, `u` and `v` stay what they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Origin {
    /// What the scene file gives as `origin`; nothing where it gives none.
    #[default]
    Own,
    /// This, whatever the scene file gives.
    At([f64; 3]),
    /// The middle of the scene's box, rounded to multiples of the largest power of two that is not above the box's longest side.
    Auto,
}

/// What a scene's file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadedScene {
    /// The geometries, numbered as in the file.
    pub scene: Scene,
    /// The camera that a scene file names, if it does: valid for [`Camera::rays`].
    pub camera: Option<Camera>,
    /// The file, then the meshes and tables of spheres that it names, in order.
    pub sources: Vec<PathBuf>,
    /// What was subtracted from every point, the camera's too.
    pub origin: [f64; 3],
    /// What was left out of the files, or taken otherwise than one may think.
    pub notes: Vec<Note>,
    /// What rounding did to their numbers.
    pub rounding: Rounding,
}

/// Reads a scene: a mesh (`.obj`, `.ply`, `.stl`, `.gltf`, `.glb`), which becomes geometry 0, or a scene file
/// (`.toml`). The letter case of the ending does not matter, and `.gz` may follow it.
///
/// Triangles keep the file's order, and those without area are kept. A polygon of n corners becomes n - 2 triangles that cover its
/// inside: a convex one those from its first corner, in order. Every number is rounded once to the nearest `f32`, and
/// [`LoadedScene::rounding`] tells what that changed. A file without primitives is an empty scene, not an error.
///
/// # Errors
/// [`Error::Open`] where the file, or one that it names, cannot be opened; [`Error::Io`] where reading it fails;
/// [`Error::Bad`] where the ending is unknown or the content is not a scene: a vertex or sphere that is not finite, a
/// negative radius, an index out of range, a truncated file, an unknown key, a wrong shape or dtype.
pub fn load(path: &Path) -> Result<LoadedScene, Error> {
    load_at(path, Origin::Own)
}

/// As [`load`], with another origin than the scene's own.
///
/// # Errors
/// As [`load`].
pub fn load_at(path: &Path, origin: Origin) -> Result<LoadedScene, Error> {
    match origin {
        Origin::Own => load_from(path, None),
        Origin::At(origin) => load_from(path, Some(origin.into())),
        Origin::Auto => {
            let loaded = load_from(path, Some(DVec3::ZERO))?;
            match middle(&loaded.scene) {
                DVec3::ZERO => Ok(loaded),
                origin => load_from(path, Some(origin)),
            }
        }
    }
}

/// The middle of the scene's box on a grid that is as coarse as the box allows: subtracting it moves few digits.
fn middle(scene: &Scene) -> DVec3 {
    let Some([low, high]) = scene.bounds().map(|bounds| bounds.map(|corner| corner.as_dvec3())) else {
        return DVec3::ZERO;
    };
    let size = (high - low).max_element();
    let step = if size > 0.0 { size.log2().floor().exp2() } else { 1.0 };
    // The farthest multiples are those that f64 has, and their sum is.
    ((low / 2.0 + high / 2.0) / step).round() * step
}

fn load_from(path: &Path, origin: Option<DVec3>) -> Result<LoadedScene, Error> {
    if ending(path) == "toml" {
        return scene_file::load(path, origin);
    }
    let mut told = Told::at(origin.unwrap_or_default());
    let mesh = load_mesh(path, "give a scene: .obj, .ply, .stl, .gltf, .glb or .toml", &mut told)?;
    Ok(told.of(valid(vec![Geometry::Mesh(mesh)], path)?, None, vec![path.into()]))
}

/// The scene of what was read from a file. Readers refuse with a better place what is no primitive.
fn valid(geometries: Vec<Geometry>, path: &Path) -> Result<Scene, Error> {
    Scene::new(geometries).map_err(|e| {
        let (what, expected) =
            (e.fault.to_string(), "give finite numbers, radii of zero or more and indices within range");
        Error::bad(
            path.display().to_string(),
            format!("geometry {}, primitive {}", e.geometry, e.primitive),
            what,
            expected,
        )
    })
}

/// Reads a mesh by the file's ending; `endings` says which would be right.
fn load_mesh(path: &Path, endings: &str, told: &mut Told) -> Result<Mesh, Error> {
    let name = path.display().to_string();
    let reading = Reading::new(&name, told);
    match ending(path).as_str() {
        "obj" => obj::parse(&name, &read(path)?, reading),
        "ply" => ply::parse(&name, &read(path)?, reading),
        "stl" => stl::parse(&name, &read(path)?, reading),
        "gltf" | "glb" => gltf::parse(path, &read(path)?, reading),
        other => Err(unknown_ending(name, other, endings)),
    }
}

/// The file's ending in lower case, without its dot and a `.gz` after it; empty where there is none.
fn ending(path: &Path) -> String {
    let inner = unpacked_name(path);
    let path = inner.as_deref().unwrap_or(path);
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Whether a file can have this name, which another file says; a message shows it.
fn named(name: &str) -> Result<(), String> {
    if name.len() > 255 || name.chars().any(char::is_control) {
        return Err(format!("{} is no name of a file", quoted(name)));
    }
    Ok(())
}

fn unknown_ending(file: String, ending: &str, expected: &str) -> Error {
    if file == "-" {
        let what = "a scene is not read from stdin: the ending of its name says what it is, and it names other files";
        return Error::bad(file, "stdin", what, expected);
    }
    let what = if ending.is_empty() {
        "there is none".into()
    } else {
        format!("{} is not one we read", quoted(format!(".{ending}")))
    };
    Error::bad(file, "the file's ending", what, expected)
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let open = |source| Error::Open { path: path.into(), source };
    let mut file = File::open(path).map_err(open)?;
    if file.metadata().map_err(open)?.is_dir() {
        return Err(open(std::io::ErrorKind::IsADirectory.into()));
    }
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|source| Error::Io { path: path.into(), source })?;
    if unpacked_name(path).is_some() { unpack(path, &bytes) } else { Ok(bytes) }
}
