//! trimesh, issue 1766: a ray straight down on the diagonal between two triangles. It hits once.

use super::{all_hit_once, recorded};

#[test]
fn a_shared_diagonal_is_hit_once() {
    for answers in recorded(9, 1) {
        assert!(all_hit_once(&answers), "{:?}", answers.hits);
    }
}
