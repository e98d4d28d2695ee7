//! tinybvh: a determinant test against 1e-6 missed every triangle of size 1e-4. A ray down on the middle of each hits that one.

use super::{each_its_own, recorded};

#[test]
fn small_triangles_are_hit() {
    for answers in recorded(7, 32) {
        assert!(each_its_own(&answers), "{:?}", answers.hits);
    }
}
