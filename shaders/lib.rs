//! Rayproof's kernels in WGSL: one idea a file, the derivations in their headers.
//!
//! Declarations at module scope come in any order, so joining files is linking: a precision, a query and the kinds of primitive
//! in a scene are each a choice of files that define the same functions. The host (`rayproof-gpu`) chooses; nothing here knows
//! of it, but for what a header says comes from the host.
#![doc = include_str!("README.md")]

/// The files by their paths, in alphabetical order.
macro_rules! files {
    ($($path:literal),+ $(,)?) => {
        /// Every file: its path in this folder, and its text.
        pub const FILES: &[(&str, &str)] = &[$(($path, include_str!($path))),+];
    };
}

files![
    "batch.wgsl",
    "bvh/every.wgsl",
    "bvh/slab.wgsl",
    "bvh/traverse.wgsl",
    "classic/ray.wgsl",
    "classic/sphere.wgsl",
    "classic/triangle.wgsl",
    "double/sphere.wgsl",
    "double/triangle.wgsl",
    "exact/leaf/both_roots.wgsl",
    "exact/leaf/candidate.wgsl",
    "exact/leaf/crossings.wgsl",
    "exact/leaf/first_root.wgsl",
    "exact/leaf/nearest.wgsl",
    "exact/leaf/spheres.wgsl",
    "exact/leaf/triangles.wgsl",
    "exact/line.wgsl",
    "exact/list.wgsl",
    "exact/number/double.wgsl",
    "exact/number/narrow.wgsl",
    "exact/number/native.wgsl",
    "exact/number/pair.wgsl",
    "exact/number/pair_of_f32.wgsl",
    "exact/number/pair_of_f64.wgsl",
    "exact/number/single.wgsl",
    "exact/number/single_by_rule.wgsl",
    "exact/number/single_ieee.wgsl",
    "exact/number/trial.wgsl",
    "exact/query/any.wgsl",
    "exact/query/closest.wgsl",
    "exact/query/count.wgsl",
    "exact/query/first.wgsl",
    "exact/query/second.wgsl",
    "exact/ray.wgsl",
    "exact/round/all.wgsl",
    "exact/round/hit.wgsl",
    "exact/round/refined_sphere.wgsl",
    "exact/round/refined_triangle.wgsl",
    "exact/round/rest.wgsl",
    "exact/round/root.wgsl",
    "exact/round/sphere.wgsl",
    "exact/round/triangle.wgsl",
    "exact/round/triangle_id.wgsl",
    "exact/round/value.wgsl",
    "exact/round/words.wgsl",
    "exact/sphere.wgsl",
    "exact/triangle.wgsl",
    "exact/vector.wgsl",
    "fast/ray.wgsl",
    "fast/sphere.wgsl",
    "fast/triangle.wgsl",
    "fingerprint.wgsl",
    "leaf/single.wgsl",
    "leaf/spheres.wgsl",
    "leaf/triangles.wgsl",
    "leaf/word.wgsl",
    "math.wgsl",
    "query/any.wgsl",
    "query/closest.wgsl",
    "ray_query.wgsl",
    "textbook/sphere.wgsl",
];

/// The text of a file.
///
/// # Panics
/// When there is no such file: the host links by constants, and tests link every kernel.
#[must_use]
pub fn source(path: &str) -> &'static str {
    let found = FILES.binary_search_by_key(&path, |(name, _)| name);
    FILES[found.unwrap_or_else(|_| panic!("there is no shader {path}"))].1
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    fn files_in(folder: &Path, root: &Path, found: &mut Vec<String>) {
        for entry in fs::read_dir(folder).expect("is there") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                files_in(&path, root, found);
            } else if path.extension().is_some_and(|ending| ending == "wgsl") {
                let name = path.strip_prefix(root).expect("is below").components();
                found.push(name.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/"));
            }
        }
    }

    #[test]
    fn every_file_is_listed_in_order() {
        let (root, mut found) = (Path::new(env!("CARGO_MANIFEST_DIR")), Vec::new());
        files_in(root, root, &mut found);
        found.sort();
        let listed: Vec<&str> = FILES.iter().map(|(path, _)| *path).collect();
        assert_eq!(listed, found);
        assert!(source("fast/sphere.wgsl").contains("fn intersect_sphere("));
    }
}
