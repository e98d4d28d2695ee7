//! The scene file, TOML: several geometries, and a camera.

use std::path::Path;

use glam::Vec3;
use serde::Deserialize;
use toml::Value;

use super::faults::{Faults, nearest};
use super::{LoadedScene, ending, load_mesh, read, spheres, unknown_ending, valid};
use crate::Error;
use rayproof_scene::{Camera, Geometry, Mesh, Sphere, number};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    #[serde(default)]
    geometry: Vec<Entry>,
    camera: Option<View>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    mesh: Option<String>,
    /// A path, or rows of `[x, y, z, radius]`.
    spheres: Option<Value>,
    /// Rows of three corners, `[ax, ay, az, bx, by, bz, cx, cy, cz]`.
    triangles: Option<Value>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct View {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    fov_y: f64,
}

pub(super) fn load(path: &Path) -> Result<LoadedScene, Error> {
    let name = path.display().to_string();
    let expected =
        "give [[geometry]] with `mesh`, `spheres` or `triangles`, and [camera] with `eye`, `target`, `up` and `fov_y`";
    let bytes = read(path)?;
    let text = std::str::from_utf8(&bytes).map_err(|e| {
        let line = 1 + bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
        Error::bad(&name, format!("line {line}"), "this is not UTF-8", expected)
    })?;
    let file: SceneFile = toml::from_str(text).map_err(|e| {
        let before = e.span().and_then(|span| text.get(..span.start)).unwrap_or_default();
        let line = 1 + before.matches('\n').count();
        Error::bad(&name, format!("line {line}"), e.message().trim_end(), expected)
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let named =
        file.geometry.iter().filter_map(|entry| entry.mesh.as_deref().or_else(|| entry.spheres.as_ref()?.as_str()));
    let sources = std::iter::once(path.into()).chain(named.map(|name| folder.join(name))).collect();
    let entries = file.geometry.into_iter().enumerate();
    let geometries = entries.map(|(i, entry)| geometry(&name, folder, i, entry)).collect::<Result<_, _>>()?;
    let camera = file.camera.map(|view| camera(&name, &view)).transpose()?;
    Ok(LoadedScene { scene: valid(geometries, path)?, camera, sources })
}

fn geometry(file: &str, folder: &Path, i: usize, entry: Entry) -> Result<Geometry, Error> {
    match (entry.mesh, entry.spheres, entry.triangles) {
        (Some(mesh), None, None) => {
            let path = folder.join(&mesh);
            if ending(&path) == "toml" {
                let place = format!("geometry {i} (counting from 0)");
                let what = format!("mesh = \"{mesh}\" is a scene file");
                return Err(Error::bad(file, place, what, "list that file's geometries here"));
            }
            load_mesh(&path, "give a mesh: .obj, .ply, .stl, .gltf or .glb").map(Geometry::Mesh)
        }
        (None, Some(Value::String(table)), None) => {
            let path = folder.join(table);
            let name = path.display().to_string();
            let spheres = match ending(&path).as_str() {
                "npy" => spheres::npy(&name, &read(&path)?),
                "csv" => spheres::csv(&name, &read(&path)?),
                other => Err(unknown_ending(name, other, "give a table of spheres: .npy or .csv")),
            };
            spheres.map(Geometry::Spheres)
        }
        (None, Some(Value::Array(rows)), None) => spheres_of(file, i, &rows).map(Geometry::Spheres),
        (None, None, Some(Value::Array(rows))) => triangles_of(file, i, &rows).map(Geometry::Mesh),
        (mesh, spheres, triangles) => {
            let what = match [mesh.is_some(), spheres.is_some(), triangles.is_some()] {
                [false, false, false] => "it has no `mesh`, no `spheres` and no `triangles`",
                [false, true, false] => "`spheres` is neither a path nor rows",
                [false, false, true] => "`triangles` are no rows",
                _ => "it has more than one of `mesh`, `spheres` and `triangles`",
            };
            let expected = "give one of: mesh = \"a path\", spheres = \"a path\", spheres = [[x, y, z, radius], ..], \
                            triangles = [[ax, ay, az, bx, by, bz, cx, cy, cz], ..]";
            Err(Error::bad(file, format!("geometry {i} (counting from 0)"), what, expected))
        }
    }
}

/// Rows of `[x, y, z, radius]` in the file itself.
fn spheres_of(file: &str, geometry: usize, rows: &[Value]) -> Result<Vec<Sphere>, Error> {
    let mut faults = Faults::new(file);
    let mut table = Vec::with_capacity(rows.len());
    for (i, row) in rows.iter().enumerate() {
        let place = format_args!("geometry {geometry}, sphere {i} (counting from 0)");
        match numbers(row, "four") {
            Ok(row) => {
                faults.sphere(place, spheres::sphere(row));
                table.push(spheres::sphere(row));
            }
            Err(what) => faults.add(place, format_args!("{what}"), "give [x, y, z, radius]"),
        }
    }
    faults.none()?;
    Ok(table)
}

/// Rows of three corners in the file itself.
fn triangles_of(file: &str, geometry: usize, rows: &[Value]) -> Result<Mesh, Error> {
    let mut faults = Faults::new(file);
    let mut mesh = Mesh::default();
    for (i, row) in rows.iter().enumerate() {
        let place = format_args!("geometry {geometry}, triangle {i} (counting from 0)");
        let [ax, ay, az, bx, by, bz, cx, cy, cz] = match numbers(row, "nine") {
            Ok(row) => row,
            Err(what) => {
                faults.add(place, format_args!("{what}"), "give [ax, ay, az, bx, by, bz, cx, cy, cz]");
                continue;
            }
        };
        let corners = [Vec3::new(ax, ay, az), Vec3::new(bx, by, bz), Vec3::new(cx, cy, cz)];
        corners.into_iter().for_each(|corner| faults.vertex(place, corner));
        let first = u32::try_from(mesh.vertices.len()).expect("no text of 2^32 vertices fits into memory");
        mesh.vertices.extend(corners);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    faults.none()?;
    Ok(mesh)
}

/// A row of exactly `N` numbers, or what it is instead.
fn numbers<const N: usize>(row: &Value, count: &str) -> Result<[f32; N], String> {
    let Some(entries) = row.as_array().filter(|entries| entries.len() == N) else {
        return Err(format!("`{row}` is not {count} numbers"));
    };
    let mut numbers = [0.0; N];
    for (number, entry) in numbers.iter_mut().zip(entries) {
        let what = || format!("`{entry}` is no number, and no hexadecimal float that is an f32");
        *number = number_of(entry).ok_or_else(what)?;
    }
    Ok(numbers)
}

#[expect(clippy::cast_precision_loss, reason = "integers are rounded to the nearest too")]
fn number_of(value: &Value) -> Option<f32> {
    match *value {
        Value::Float(x) => Some(nearest(x)),
        Value::Integer(x) => Some(x as f32),
        // TOML has no hexadecimal floats.
        Value::String(ref word) if word.contains(['x', 'X']) => number::parse(word),
        _ => None,
    }
}

fn camera(file: &str, view: &View) -> Result<Camera, Error> {
    let [eye, target, up] = [view.eye, view.target, view.up].map(|v| Vec3::from(v.map(nearest)));
    let camera = Camera { eye, target, up, fov_y: nearest(view.fov_y) };
    match camera.fault() {
        None => Ok(camera),
        Some([what, expected]) => Err(Error::bad(file, "[camera]", what, expected)),
    }
}
