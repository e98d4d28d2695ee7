//! The ray and its primitive, number by number.

use egui::{Grid, Ui};
use glam::Vec3;
use rayproof::scene::{Kind, Primitive, Ray, Scene, number};

use super::{Picked, mono, strong};

/// The ray.
pub(super) fn ray(ui: &mut Ui, ray: &Ray, picked: &Picked) {
    let of = picked.pixel.map_or_else(String::new, |[x, y]| format!(" of the pixel {x}, {y}"));
    strong(ui, &format!("Ray{of}"));
    Grid::new("ray").num_columns(4).striped(true).show(ui, |ui| {
        vector(ui, "origin e", ray.origin);
        vector(ui, "direction d", ray.direction);
        for (name, t) in [("t_min", ray.t_min), ("t_max", ray.t_max)] {
            ui.label(name);
            both(ui, t);
            ui.end_row();
        }
    });
}

/// The components of a vector, a line each.
fn vector(ui: &mut Ui, name: &str, v: Vec3) {
    for (axis, x) in ["x", "y", "z"].into_iter().zip(v.to_array()) {
        ui.label(format!("{name}.{axis}"));
        both(ui, x);
        ui.end_row();
    }
}

/// A number in decimal, and as it is stored.
fn both(ui: &mut Ui, x: f32) {
    mono(ui, format!("{x:?}"));
    mono(ui, number::hex(x));
}

/// The primitive of a flat number.
pub(super) fn primitive(ui: &mut Ui, scene: &Scene, flat: u32) {
    let (geometry, row) = scene.locate(flat as usize);
    let shape = scene.primitive(flat as usize);
    let kind = match shape.kind() {
        Kind::Sphere => "Sphere",
        Kind::Triangle => "Triangle",
    };
    strong(ui, &format!("{kind} {row} of geometry {geometry}"));
    Grid::new("primitive").num_columns(3).striped(true).show(ui, |ui| match shape {
        Primitive::Sphere(sphere) => {
            vector(ui, "center c", sphere.center);
            ui.label("radius r");
            both(ui, sphere.radius);
            ui.end_row();
        }
        Primitive::Triangle(t) => {
            for (name, corner) in [("a", t.a), ("b", t.b), ("c", t.c)] {
                vector(ui, name, corner);
            }
        }
    });
}
