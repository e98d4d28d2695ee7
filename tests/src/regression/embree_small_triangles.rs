//! Embree, `verify.cpp`, `SmallTriangleHitTest`: a ray to the middle of each small triangle of a plane hits that one. There some may
//! miss; here none.

use super::{each_its_own, recorded};

#[test]
fn each_small_triangle_is_hit_in_its_middle() {
    for answers in recorded(11, 128) {
        assert!(each_its_own(&answers), "{:?}", answers.hits);
    }
}
