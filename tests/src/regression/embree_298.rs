//! Embree, issue 298: what does a ray hit that runs in a triangle's plane, through its inside? Nothing: seen edge on, a triangle
//! has no area.

use super::{all_miss, recorded};

#[test]
fn a_ray_in_the_plane_misses() {
    assert!(recorded(1, 2).iter().all(all_miss));
}
