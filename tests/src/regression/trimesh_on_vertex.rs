//! trimesh, `test_ray.py`, `on_vertex` and `on_edge`: rays from the middle of a box at its corners, its edges and its faces' middles
//! were counted twice. Each hits once.

use super::{all_hit_once, recorded};

#[test]
fn a_corner_or_an_edge_is_hit_once() {
    for answers in recorded(4, 26) {
        assert!(all_hit_once(&answers), "{:?}", answers.hits);
    }
}
