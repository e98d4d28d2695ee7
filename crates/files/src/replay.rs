//! One ray and a few primitives as the text of two files that `rayproof intersect` answers again, to the bit.

use std::fmt::Write as _;

use rayproof_scene::{Primitive, Ray, number};

/// A scene file with a geometry for each primitive, its numbers hexadecimal.
#[must_use]
pub fn scene_file(primitives: impl IntoIterator<Item = Primitive>) -> String {
    let mut text = String::new();
    for primitive in primitives {
        let (key, numbers) = match primitive {
            Primitive::Sphere(s) => ("spheres", [&s.center.to_array()[..], &[s.radius]].concat()),
            Primitive::Triangle(t) => ("triangles", [t.a, t.b, t.c].map(|v| v.to_array()).concat()),
        };
        let row: Vec<String> = numbers.into_iter().map(|x| format!("\"{}\"", number::hex(x))).collect();
        let _ = writeln!(text, "[[geometry]]\n{key} = [[{}]]", row.join(", "));
    }
    text
}

/// A CSV file of one ray, its numbers hexadecimal.
#[must_use]
pub fn ray_file(ray: &Ray) -> String {
    let numbers = [&ray.origin.to_array()[..], &ray.direction.to_array(), &[ray.t_min, ray.t_max]].concat();
    let row: Vec<String> = numbers.into_iter().map(number::hex).collect();
    format!("ox,oy,oz,dx,dy,dz,t_min,t_max\n{}\n", row.join(","))
}
