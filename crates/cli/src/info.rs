//! `rayproof info`: what a scene holds, and what reading it left out or rounded.

use std::fmt::Write as _;

use rayproof::files::Survey;
use rayproof::scene::{Geometry, Kind};
use serde::Serialize;

use crate::args::Info;
use crate::exit::{Failure, print, print_json};
use crate::load::Loaded;
use crate::summary::{SceneSize, grouped};

/// The object that `--json` prints.
#[derive(Serialize)]
struct Contents {
    scene: SceneSize,
    /// The lowest and the highest corner of the box around all primitives.
    #[serde(rename = "box")]
    bounds: Option<[[f32; 3]; 2]>,
    /// From the farthest coordinate of the box to the next `f32`.
    step: f32,
    origin: [f64; 3],
    geometries: Vec<OfGeometry>,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct OfGeometry {
    kind: &'static str,
    primitives: usize,
    closed: bool,
    #[serde(flatten)]
    survey: Survey,
}

impl From<&Geometry> for OfGeometry {
    fn from(geometry: &Geometry) -> Self {
        let survey = Survey::of(geometry);
        let kind = match geometry.kind() {
            Kind::Triangle => "mesh",
            Kind::Sphere => "spheres",
        };
        Self { kind, primitives: geometry.len(), closed: survey.is_closed(), survey }
    }
}

/// Runs the command.
pub(crate) fn run(args: &Info) -> Result<(), Failure> {
    let Loaded { scene: loaded, notes, .. } = Loaded::read(&args.scene, &args.place)?;
    let bounds = loaded.scene.bounds();
    let farthest =
        bounds.map_or(0.0, |bounds| bounds.into_iter().fold(0.0, |far: f32, v| far.max(v.abs().max_element())));
    let report = Contents {
        scene: SceneSize::of(&loaded),
        bounds: bounds.map(|bounds| bounds.map(|corner| corner.to_array())),
        step: farthest.next_up() - farthest,
        origin: loaded.origin,
        geometries: loaded.scene.geometries().iter().map(OfGeometry::from).collect(),
        notes,
    };
    if args.json {
        return print_json(&report);
    }
    print(report.text().trim_end())
}

impl Contents {
    fn text(&self) -> String {
        let mut text = format!("scene     {}\n", self.scene);
        if let Some([low, high]) = self.bounds {
            let _ = writeln!(text, "box       {low:?} to {high:?}; the step of f32 there is {:.1e}", self.step);
        }
        for (i, geometry) in self.geometries.iter().enumerate() {
            let closed = if geometry.closed { "closed" } else { "open" };
            let _ = writeln!(
                text,
                "geometry  {i}: {}, {} primitives, {closed}",
                geometry.kind,
                grouped(geometry.primitives as u64)
            );
            for (name, tally) in [
                ("boundary edges", geometry.survey.boundary_edges),
                ("edges of more than two triangles", geometry.survey.non_manifold_edges),
                ("triangles that are there twice", geometry.survey.duplicate_triangles),
                ("triangles without area", geometry.survey.flat_triangles),
            ] {
                if let Some(first) = tally.first {
                    let _ = writeln!(
                        text,
                        "          {} {name}, the first at triangle {first}",
                        grouped(tally.count as u64)
                    );
                }
            }
        }
        for note in &self.notes {
            let _ = writeln!(text, "note      {note}");
        }
        text
    }
}
