//! The range of a ray, and where a parameter lies to it.

use std::cmp::Ordering;

use rayproof_scene::Ray;

use crate::{Root, oracle::cmp_end};

/// Where a parameter lies.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Before,
    Within,
    After,
    /// It is not a number.
    Nowhere,
}

impl Place {
    pub(super) fn of(t: f32, ray: &Ray) -> Self {
        if t >= ray.t_min && t <= ray.t_max {
            Self::Within
        } else if t < ray.t_min {
            Self::Before
        } else if t > ray.t_max {
            Self::After
        } else {
            Self::Nowhere
        }
    }

    pub(super) fn of_exact(t: &Root, ray: &Ray) -> Self {
        if cmp_end(t, ray.t_min) == Ordering::Less {
            Self::Before
        } else if cmp_end(t, ray.t_max) == Ordering::Greater {
            Self::After
        } else {
            Self::Within
        }
    }
}

/// The first of these parameters that lies within the range, or why none does.
pub(super) fn first_within<T>(
    parameters: impl IntoIterator<Item = T>,
    place: impl Fn(&T) -> Place,
) -> Result<T, &'static str> {
    let mut places = Vec::new();
    for t in parameters {
        match place(&t) {
            Place::Within => return Ok(t),
            other => places.push(other),
        }
    }
    let all = |place| places.iter().all(|&p| p == place);
    Err(if places.contains(&Place::Nowhere) {
        "t is not a number"
    } else if all(Place::Before) {
        "t < t_min"
    } else if all(Place::After) {
        "t > t_max"
    } else {
        "one t < t_min, the other > t_max"
    })
}
