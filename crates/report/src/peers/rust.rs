//! Which intersectors written in Rust there are.

use rayproof::scene::Mesh;

use super::{Absent, Contestant};

/// The intersectors written in Rust, each with its tree of the mesh: obvhs with its wide and its binary tree, parry3d
/// and bvh.
#[cfg(feature = "peers")]
#[must_use]
pub fn rust_peers(mesh: &Mesh) -> Vec<Contestant> {
    use ::obvhs::{bvh2::Bvh2, cwbvh::CwBvh};

    use super::threads::threaded;
    use super::{bvh, obvhs, parry};
    vec![
        threaded::<obvhs::Obvhs<CwBvh>>(mesh),
        threaded::<obvhs::Obvhs<Bvh2>>(mesh),
        threaded::<parry::Parry>(mesh),
        threaded::<bvh::Bvh>(mesh),
    ]
}

/// That the intersectors written in Rust are not in this build.
#[cfg(not(feature = "peers"))]
#[must_use]
pub fn rust_peers(mesh: &Mesh) -> Vec<Contestant> {
    let _ = mesh;
    absent_rust_peers("built without the cargo feature `peers`")
}

/// These peers where they are not measured, because of `why`.
#[must_use]
pub fn absent_rust_peers(why: &str) -> Vec<Contestant> {
    ["obvhs CwBvh", "obvhs Bvh2", "parry3d", "bvh"].map(|name| Err(Absent::new(name, why))).into()
}
