//! Rays that are none are refused, or counted as misses: the same on every device, whatever an engine would make of them.

use std::borrow::Cow;

use rayon::prelude::*;
use rayproof_scene::{INVALID_RAY, InvalidRays, Ray, RayFault};

use crate::Error;

/// Rays looked at by one task.
const TASK: usize = 1 << 14;

/// The rays as an engine may have them, and how many of them now stand in for bad ones. What stands in for one already, since a
/// reader counted it, is admitted.
///
/// # Errors
/// [`Error::InvalidRay`] at the first bad one, where they are refused.
pub(crate) fn admit(rays: &[Ray], invalid: InvalidRays) -> Result<(Cow<'_, [Ray]>, u64), Error> {
    let count: usize = rays.par_chunks(TASK).map(|rays| rays.iter().filter_map(fault).count()).sum();
    if count == 0 {
        return Ok((Cow::Borrowed(rays), 0));
    }
    match invalid {
        InvalidRays::Miss => {
            let admitted = rays.iter().map(|ray| if fault(ray).is_some() { INVALID_RAY } else { *ray }).collect();
            Ok((Cow::Owned(admitted), count as u64))
        }
        InvalidRays::Error => {
            let mut faults = rays.iter().enumerate().filter_map(|(index, ray)| Some((index, fault(ray)?)));
            let (index, fault) = faults.next().expect("some are bad");
            Err(Error::InvalidRay { index, fault, more: count - 1 })
        }
    }
}

fn fault(ray: &Ray) -> Option<RayFault> {
    ray.fault().filter(|_| *ray != INVALID_RAY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_rays_are_refused_or_counted() {
        let good = Ray::new([0.0; 3], [0.0, 0.0, 1.0]);
        let bad = [
            Ray { t_max: f32::NAN, ..good },
            Ray { t_min: 2.0, t_max: 1.0, ..good },
            Ray::new([f32::INFINITY, 0.0, 0.0], [0.0, 0.0, 1.0]),
            Ray::new([0.0; 3], [f32::NAN; 3]),
            Ray::new([0.0; 3], [0.0; 3]),
        ];
        assert!(matches!(admit(&[good, INVALID_RAY, good], InvalidRays::Error), Ok((Cow::Borrowed(_), 0))));
        for ray in bad {
            let rays = [good, ray, good, ray];
            let (admitted, count) = admit(&rays, InvalidRays::Miss).expect("counted");
            assert_eq!((&*admitted, count), (&[good, INVALID_RAY, good, INVALID_RAY][..], 2));
            let error = admit(&rays, InvalidRays::Error).expect_err("refused");
            assert!(matches!(error, Error::InvalidRay { index: 1, more: 1, .. }), "{error}");
        }
        let error = admit(&bad[..1], InvalidRays::Error).expect_err("refused").to_string();
        assert_eq!(error, format!("ray 0: {}", RayFault::Range));
    }
}
