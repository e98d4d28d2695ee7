//! pbrt-v4, `Triangle.BadCases`: a ray hit a triangle whose corners lie on one line. Without area there is nothing to hit.

use super::{all_miss, recorded};

#[test]
fn a_triangle_without_area_is_missed() {
    assert!(recorded(0, 1).iter().all(all_miss));
}
