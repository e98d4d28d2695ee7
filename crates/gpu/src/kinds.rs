//! What kernels know of the kinds of primitive: written by the host for the kinds that a scene holds, so that a kernel knows of
//! no other, and a new kind is added in Rust, where the compiler names what is left.

use std::fmt::Write as _;

use rayproof_scene::{Kind, Kinds};
use rayproof_tree::{Bvh, COUNT_SHIFT, INDEX_MASK, KIND_MASK, KIND_SHIFT};

/// A list of a kind, as kernels read it: its accessor's name, its elements' type and size, and their bytes.
pub(crate) struct List<'a> {
    pub(crate) name: &'static str,
    pub(crate) element: &'static str,
    pub(crate) stride: usize,
    pub(crate) bytes: &'a [u8],
}

/// The lists of a kind.
pub(crate) fn lists(kind: Kind, bvh: &Bvh) -> Vec<List<'_>> {
    match kind {
        Kind::Triangle => vec![List {
            name: "triangle_quad",
            element: "vec4<u32>",
            stride: 16,
            bytes: bytemuck::cast_slice(&bvh.triangles),
        }],
        Kind::Sphere => vec![
            List { name: "sphere_quad", element: "vec4<u32>", stride: 16, bytes: bytemuck::cast_slice(&bvh.spheres) },
            List { name: "sphere_id", element: "u32", stride: 4, bytes: bytemuck::cast_slice(&bvh.sphere_ids) },
        ],
    }
}

/// WGSL: how the bits of a leaf's word are dealt out, and a number for each kind.
pub(crate) fn words(kinds: Kinds) -> String {
    let mut text = format!(
        "const KIND_SHIFT: u32 = {KIND_SHIFT}u;\nconst KIND_MASK: u32 = {KIND_MASK}u;\n\
         const COUNT_SHIFT: u32 = {COUNT_SHIFT}u;\nconst INDEX_MASK: u32 = {INDEX_MASK}u;\n"
    );
    for kind in kinds.iter() {
        let _ = writeln!(text, "const {}: u32 = {}u;", kind.name().to_uppercase(), kind as u32);
    }
    text
}

/// WGSL: `intersect_leaf`, which every walk calls.
pub(crate) fn leaves(kinds: Kinds) -> String {
    let head = "fn intersect_leaf(ray: PreparedRay, word: u32, found: Found) -> Found";
    by_kind(kinds, head, "leaf_kind(word)", |name| format!("intersect_{name}s(ray, word, found)"))
}

/// WGSL: `values` and `flat_number` of the primitive in a place, by which hits are rounded.
pub(crate) fn rounding(kinds: Kinds) -> String {
    let values = by_kind(kinds, "fn values(ray: PreparedRay, place: u32) -> Values", "place_kind(place)", |name| {
        format!("{name}_values(ray, place_index(place))")
    });
    let number = by_kind(kinds, "fn flat_number(place: u32) -> u32", "place_kind(place)", |name| {
        format!("{name}_id(place_index(place))")
    });
    values + &number
}

/// A function that hands on to the one of a kind: by a switch where there are several, the last of them in the place of all
/// others.
fn by_kind(kinds: Kinds, head: &str, kind_of: &str, call: impl Fn(&str) -> String) -> String {
    if let Some(kind) = kinds.only() {
        return format!("{head} {{\n    return {};\n}}\n", call(kind.name()));
    }
    let mut text = format!("{head} {{\n    switch {kind_of} {{\n");
    let last = kinds.iter().last();
    for kind in kinds.iter() {
        let label = if Some(kind) == last { "default".to_owned() } else { format!("case {}u", kind as u32) };
        let _ = writeln!(text, "        {label}: {{ return {}; }}", call(kind.name()));
    }
    text + "    }\n}\n"
}
