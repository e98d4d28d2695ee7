//! Every shader file is part of a kernel, and every kernel parses and validates.

use std::collections::BTreeSet;

use rayproof::Precision;
use rayproof::scene::{Kind, Kinds};
use rayproof_gpu::{Kernel, Pass, Query, Walk};

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

#[test]
fn every_kernel_validates_and_every_file_is_used() {
    let mut used = BTreeSet::new();
    let sources: Vec<&str> = rayproof_shaders::FILES.iter().map(|(_, text)| *text).collect();
    assert!(sources.len() > 15, "{} shader files", sources.len());
    let mut kernels = 0;
    let passes = Precision::ALL.map(Pass::Trace).into_iter().chain(Pass::all_exact());
    for pass in passes {
        for query in Query::ALL {
            for (kinds, walk) in Kinds::all().flat_map(|kinds| [(kinds, Walk::Tree), (kinds, Walk::Every)]) {
                let kernel = Kernel { pass, query, kinds, walk };
                if !kernel.exists() {
                    continue;
                }
                let linked = kernel.link(LISTS);
                let (module, _) = linked.validate().unwrap_or_else(|e| panic!("{kernel:?}: {e}"));
                assert_eq!(module.entry_points[0].name, kernel.entry());
                // A scene without spheres runs a kernel that knows of none, and likewise for every kind.
                for kind in Kind::ALL {
                    let name = kind.name();
                    let functions = [format!("fn intersect_{name}s("), format!("fn {name}_values(")];
                    let knows = functions.iter().any(|function| linked.source().contains(function));
                    assert_eq!(knows, kinds.contains(kind), "{kernel:?} and {name}s");
                }
                used.extend((0..sources.len()).filter(|&i| linked.source().contains(sources[i].trim())));
                kernels += 1;
            }
        }
    }
    // The check kernels stand alone; every device that is opened for the precision `exact` runs both. The ray query is a peer's.
    let checks =
        |text: &&str| ["fn fingerprint(", "fn trial(", "fn query_closest("].iter().any(|entry| text.contains(entry));
    used.extend((0..sources.len()).filter(|&i| checks(&sources[i])));
    assert_eq!(used.len(), sources.len(), "a file in shaders/ belongs to no kernel");
    println!("{kernels} kernels of {} files", sources.len());
}
