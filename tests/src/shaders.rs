//! Every shader file is part of a kernel, and every kernel parses and validates.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use rayproof::Precision;
use rayproof_gpu::{Contents, Kernel, Pass, Query, Walk};

/// Accessors as the host writes them for lists of one binding.
const LISTS: &str = "const STACK_SIZE: u32 = 32u;
const NODE_COUNT: u32 = 1u;
@group(0) @binding(4) var<storage, read> nodes_0: array<vec4<u32>>;
fn node_quad(i: u32) -> vec4<u32> { return nodes_0[i]; }
@group(0) @binding(5) var<storage, read> triangles_0: array<vec4<u32>>;
fn triangle_quad(i: u32) -> vec4<u32> { return triangles_0[i]; }
@group(0) @binding(6) var<storage, read> spheres_0: array<vec4<u32>>;
fn sphere_quad(i: u32) -> vec4<u32> { return spheres_0[i]; }
@group(0) @binding(7) var<storage, read> sphere_ids_0: array<u32>;
fn sphere_id(i: u32) -> u32 { return sphere_ids_0[i]; }
";

fn files(folder: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).expect("is there") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            files(&path, found);
        } else {
            found.push(fs::read_to_string(&path).expect("text"));
        }
    }
}

#[test]
fn every_kernel_validates_and_every_file_is_used() {
    let mut used = BTreeSet::new();
    let mut sources = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders"), &mut sources);
    assert!(sources.len() > 15, "{} shader files", sources.len());
    let mut kernels = 0;
    let passes = Precision::ALL.map(Pass::Trace).into_iter().chain(Pass::all_exact());
    for pass in passes {
        for query in Query::ALL {
            for (contents, walk) in Contents::ALL.into_iter().flat_map(|c| [(c, Walk::Tree), (c, Walk::Every)]) {
                let kernel = Kernel { pass, query, contents, walk };
                if !kernel.exists() {
                    continue;
                }
                let linked = kernel.link(LISTS);
                let (module, _) = linked.validate().unwrap_or_else(|e| panic!("{kernel:?}: {e}"));
                assert_eq!(module.entry_points[0].name, kernel.entry());
                // A scene without spheres runs a kernel that knows of none, and likewise for triangles.
                let knows = |functions: [&str; 2]| functions.iter().any(|f| linked.source().contains(f));
                assert_eq!(knows(["fn intersect_sphere(", "fn chord("]), contents != Contents::Triangles);
                assert_eq!(knows(["fn intersect_triangle(", "fn sides("]), contents != Contents::Spheres);
                used.extend((0..sources.len()).filter(|&i| linked.source().contains(sources[i].trim())));
                kernels += 1;
            }
        }
    }
    // The check kernels stand alone; every device that is opened for the precision `exact` runs both. The ray query is a peer's.
    let checks =
        |text: &String| ["fn fingerprint(", "fn trial(", "fn query_closest("].iter().any(|entry| text.contains(entry));
    used.extend((0..sources.len()).filter(|&i| checks(&sources[i])));
    assert_eq!(used.len(), sources.len(), "a file in shaders/ belongs to no kernel");
    println!("{kernels} kernels of {} files", sources.len());
}
