//! trimesh, issue 1496: rays from the middle of a box to the vertices of a larger one around it were answered otherwise from run to
//! run. Each hits the inner box, once.

use super::{all_hit_once, recorded};

#[test]
fn a_box_is_hit_once_from_its_middle() {
    for answers in recorded(10, 98) {
        assert!(all_hit_once(&answers), "{:?}", answers.hits);
    }
}
