//! Embree, issue 676: which of two overlapping spheres does a ray hit first? Sphere 0, at t = 10.2983, by the numbers in its
//! `sphere_intersector_tests.cpp`.

use super::recorded;

#[test]
fn the_nearer_sphere_is_hit() {
    for answers in recorded(3, 2) {
        let hit = answers.hits[1];
        assert!(hit.primitive == 0 && (hit.t - 10.2983).abs() < 5e-5, "{hit:?}");
    }
}
