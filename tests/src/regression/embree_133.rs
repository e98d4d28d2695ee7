//! Embree, issue 133: what does a ray hit that starts on a triangle's surface? That triangle, at t = 0.

use super::recorded;

#[test]
fn a_ray_from_the_surface_hits_it() {
    for answers in recorded(2, 16) {
        assert!(answers.hits.iter().all(|hit| hit.is_hit() && hit.t.to_bits() == 0), "{:?}", answers.hits);
    }
}
