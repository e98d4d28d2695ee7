//! Scenes from files: one module a format, and what they say about bad input.

mod faults;
mod gltf;
mod gltf_data;
mod obj;
mod ply;
mod ply_payload;
mod scene_file;
mod spheres;
mod stl;
#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::Error;
use rayproof_scene::{Camera, Geometry, Mesh, Scene};

/// What a scene's file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadedScene {
    /// The geometries, numbered as in the file.
    pub scene: Scene,
    /// The camera that a scene file names, if it does: valid for [`Camera::rays`].
    pub camera: Option<Camera>,
    /// The file, then the meshes and tables of spheres that it names, in order.
    pub sources: Vec<PathBuf>,
}

/// Reads a scene: a mesh (`.obj`, `.ply`, `.stl`, `.gltf`, `.glb`), which becomes geometry 0, or a scene file
/// (`.toml`). The letter case of the ending does not matter.
///
/// Triangles keep the file's order, polygons fan out from their first vertex in order, and triangles without area are
/// kept. Every number is rounded once to the nearest `f32`. A file without primitives is an empty scene, not an error.
///
/// # Errors
/// [`Error::Open`] where the file, or one that it names, cannot be opened; [`Error::Io`] where reading it fails;
/// [`Error::Bad`] where the ending is unknown or the content is not a scene: a vertex or sphere that is not finite, a
/// negative radius, an index out of range, a truncated file, an unknown key, a wrong shape or dtype.
pub fn load(path: &Path) -> Result<LoadedScene, Error> {
    if ending(path) == "toml" {
        return scene_file::load(path);
    }
    let mesh = load_mesh(path, "give a scene: .obj, .ply, .stl, .gltf, .glb or .toml")?;
    Ok(LoadedScene { scene: valid(vec![Geometry::Mesh(mesh)], path)?, camera: None, sources: vec![path.into()] })
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
fn load_mesh(path: &Path, endings: &str) -> Result<Mesh, Error> {
    let name = path.display().to_string();
    match ending(path).as_str() {
        "obj" => obj::parse(&name, &read(path)?),
        "ply" => ply::parse(&name, &read(path)?),
        "stl" => stl::parse(&name, &read(path)?),
        "gltf" | "glb" => gltf::parse(path, &read(path)?),
        other => Err(unknown_ending(name, other, endings)),
    }
}

/// The file's ending in lower case, without its dot; empty where there is none.
fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

fn unknown_ending(file: String, ending: &str, expected: &str) -> Error {
    let what = if ending.is_empty() { "there is none".into() } else { format!("`.{ending}` is not one we read") };
    Error::bad(file, "the file's ending", what, expected)
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let mut file = File::open(path).map_err(|source| Error::Open { path: path.into(), source })?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|source| Error::Io { path: path.into(), source })?;
    Ok(bytes)
}
