//! The scene file, TOML: several geometries, and a camera.

use std::ops::Range;
use std::path::Path;

use glam::{DVec3, Vec3};
use serde::Deserialize;
use toml::de::DeValue;
use toml::{Spanned, Value};

use super::reading::{Reading, Told, Vertices};
use super::{LoadedScene, ending, load_mesh, read, spheres, unknown_ending, valid};
use crate::Error;
use crate::decimal::Number;
use crate::quote::{cut, quoted};
use rayproof_scene::{Camera, Geometry, Mesh, Sphere};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    #[serde(default)]
    geometry: Vec<Entry>,
    camera: Option<View>,
    /// Subtracted from every point.
    origin: Option<[f64; 3]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    mesh: Option<String>,
    /// A path, or rows of `[x, y, z, radius]`.
    spheres: Option<Spanned<Value>>,
    /// Rows of three corners, `[ax, ay, az, bx, by, bz, cx, cy, cz]`.
    triangles: Option<Spanned<Value>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct View {
    eye: Spanned<[f64; 3]>,
    target: Spanned<[f64; 3]>,
    up: Spanned<[f64; 3]>,
    fov_y: Spanned<f64>,
}

pub(super) fn load(path: &Path, origin: Option<DVec3>) -> Result<LoadedScene, Error> {
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
    let named = file
        .geometry
        .iter()
        .filter_map(|entry| entry.mesh.as_deref().or_else(|| entry.spheres.as_ref()?.get_ref().as_str()));
    for name in named.clone() {
        super::named(name).map_err(|what| Error::bad(path.display().to_string(), "[[geometry]]", what, expected))?;
    }
    let sources = std::iter::once(path.into()).chain(named.map(|name| folder.join(name))).collect();
    let origin = origin.or(file.origin.map(Into::into)).unwrap_or_default();
    if !origin.is_finite() {
        return Err(Error::bad(&name, "origin", "it is not finite", "give three finite numbers"));
    }
    let mut told = Told::at(origin);
    let mut scene = SceneText { file: &name, folder, text, told: &mut told };
    let entries = file.geometry.into_iter().enumerate();
    let geometries = entries.map(|(i, entry)| scene.geometry(i, entry)).collect::<Result<_, _>>()?;
    let camera = file.camera.map(|view| camera(&name, text, &view, origin)).transpose()?;
    Ok(told.of(valid(geometries, path)?, camera, sources))
}

/// A scene file being read.
struct SceneText<'a> {
    file: &'a str,
    folder: &'a Path,
    text: &'a str,
    told: &'a mut Told,
}

impl SceneText<'_> {
    fn geometry(&mut self, i: usize, entry: Entry) -> Result<Geometry, Error> {
        let Self { file, folder, .. } = *self;
        match (&entry.mesh, &entry.spheres, &entry.triangles) {
            (Some(mesh), None, None) => {
                let path = folder.join(mesh);
                if ending(&path) == "toml" {
                    let place = format!("geometry {i} (counting from 0)");
                    let what = format!("mesh = \"{}\" is a scene file", cut(mesh));
                    return Err(Error::bad(file, place, what, "list that file's geometries here"));
                }
                load_mesh(&path, "give a mesh: .obj, .ply, .stl, .gltf or .glb", self.told).map(Geometry::Mesh)
            }
            (None, Some(value), None) if let Some(table) = value.get_ref().as_str() => {
                let path = folder.join(table);
                let name = path.display().to_string();
                let reading = Reading::new(&name, self.told);
                let spheres = match ending(&path).as_str() {
                    "npy" => spheres::npy(&name, &read(&path)?, reading),
                    "csv" => spheres::csv(&name, &read(&path)?, reading),
                    other => Err(unknown_ending(name, other, "give a table of spheres: .npy or .csv")),
                };
                spheres.map(Geometry::Spheres)
            }
            (None, Some(rows), None) if rows.get_ref().is_array() => {
                self.spheres(i, rows.span()).map(Geometry::Spheres)
            }
            (None, None, Some(rows)) if rows.get_ref().is_array() => self.triangles(i, rows.span()).map(Geometry::Mesh),
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
    fn spheres(&mut self, geometry: usize, at: Range<usize>) -> Result<Vec<Sphere>, Error> {
        let mut reading = Reading::new(self.file, self.told);
        let mut table = Vec::new();
        rows(&self.text[at], |i, row| {
            let place = format_args!("geometry {geometry}, sphere {i} (counting from 0)");
            match numbers(row, "four") {
                Ok(row) => table.push(reading.sphere(place, row)),
                Err(what) => reading.fault(place, format_args!("{what}"), "give [x, y, z, radius]"),
            }
        });
        reading.end()?;
        Ok(table)
    }

    /// Rows of three corners in the file itself.
    fn triangles(&mut self, geometry: usize, at: Range<usize>) -> Result<Mesh, Error> {
        let mut reading = Reading::new(self.file, self.told);
        let (mut vertices, mut triangles) = (Vertices::default(), Vec::new());
        let place = |i| format!("geometry {geometry}, triangle {i} (counting from 0)");
        rows(&self.text[at], |i, row| match numbers::<9>(row, "nine") {
            Ok(row) => {
                let first = u32::try_from(vertices.len()).expect("no text of 2^32 vertices fits into memory");
                row.as_chunks::<3>().0.iter().for_each(|&corner| vertices.push(corner, i, &mut reading));
                triangles.push([first, first + 1, first + 2]);
            }
            Err(what) => {
                let expected = "give [ax, ay, az, bx, by, bz, cx, cy, cz]";
                reading.fault(format_args!("{}", place(i)), format_args!("{what}"), expected);
            }
        });
        let mesh = vertices.mesh(triangles, place, &mut reading);
        reading.end()?;
        Ok(mesh)
    }
}

/// The rows of an array, with their numbers as they are written: by way of `f64` some would be rounded twice.
fn rows(text: &str, mut each: impl FnMut(usize, &DeValue<'_>)) {
    // It was parsed with the file.
    let Ok(array) = DeValue::parse(text) else { return };
    for (i, row) in array.get_ref().as_array().into_iter().flatten().enumerate() {
        each(i, row.get_ref());
    }
}

/// A row of exactly `N` numbers, or what it is instead.
fn numbers<const N: usize>(row: &DeValue<'_>, count: &str) -> Result<[Number; N], String> {
    let entries = row.as_array().filter(|entries| entries.len() == N);
    let Some(entries) = entries else {
        return Err(format!("{} is not {count} numbers", shown(row)));
    };
    let mut numbers = [Number::default(); N];
    for (number, entry) in numbers.iter_mut().zip(entries) {
        let entry = entry.get_ref();
        let what = || format!("{} is no number, and no hexadecimal float that is an f32", shown(entry));
        *number = number_of(entry).ok_or_else(what)?;
    }
    Ok(numbers)
}

fn number_of(value: &DeValue<'_>) -> Option<Number> {
    match value {
        DeValue::Float(x) => Number::parse(x.as_str().as_bytes()),
        DeValue::Integer(x) if x.radix() == 10 => Number::parse(x.as_str().as_bytes()),
        #[expect(clippy::cast_precision_loss, reason = "integers are rounded to the nearest too")]
        DeValue::Integer(x) => i64::from_str_radix(x.as_str(), x.radix()).ok().map(|x| (x as f64).into()),
        // TOML has no hexadecimal floats.
        DeValue::String(word) if word.contains(['x', 'X']) => Number::parse_any(word.as_bytes()),
        _ => None,
    }
}

/// A value as a message quotes it.
fn shown(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => quoted(format!("\"{text}\"")),
        DeValue::Integer(x) => quoted(x.to_string()),
        DeValue::Float(x) => quoted(x.to_string()),
        DeValue::Boolean(x) => quoted(x.to_string()),
        DeValue::Datetime(x) => quoted(x.to_string()),
        DeValue::Array(entries) if entries.iter().all(|entry| entry.get_ref().as_array().is_none()) => {
            let entries: Vec<String> =
                entries.iter().take(12).map(|entry| shown(entry.get_ref()).trim_matches('`').to_owned()).collect();
            quoted(format!("[{}]", entries.join(", ")))
        }
        DeValue::Array(_) => "an array of arrays".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// The numbers as the text has them, each rounded once.
fn camera(file: &str, text: &str, view: &View, origin: DVec3) -> Result<Camera, Error> {
    let number = |value: &DeValue<'_>| number_of(value).expect("it was read as a number with the file");
    let parsed = |at: Range<usize>| DeValue::parse(&text[at]).expect("it was parsed with the file");
    let place = |point: &Spanned<[f64; 3]>, origin: DVec3| {
        let numbers = parsed(point.span());
        let numbers = numbers.get_ref().as_array().expect("it was read as three numbers with the file");
        let [x, y, z] = [0, 1, 2].map(|axis| number(numbers[axis].get_ref()).minus(origin[axis]).single);
        Vec3::new(x, y, z)
    };
    let camera = Camera {
        eye: place(&view.eye, origin),
        target: place(&view.target, origin),
        up: place(&view.up, DVec3::ZERO),
        fov_y: number(parsed(view.fov_y.span()).get_ref()).single,
    };
    match camera.fault() {
        None => Ok(camera),
        Some([what, expected]) => Err(Error::bad(file, "[camera]", what, expected)),
    }
}
