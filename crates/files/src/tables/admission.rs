use std::path::{Path, PathBuf};

use glam::DVec3;

use crate::decimal::Number;
use crate::{BadInput, Error, Rounding};
use rayproof_scene::{INVALID_RAY, InvalidRays, Ray};

/// The rays of a file as they come in: what is subtracted, what is rounded, and which are bad, so far.
pub(super) struct Admission {
    path: PathBuf,
    policy: InvalidRays,
    /// Subtracted from their origins.
    pub(super) origin: DVec3,
    /// By how much rounding may move an origin.
    pub(super) most: f64,
    rounding: Rounding,
    count: u64,
    first: Option<BadInput>,
}

impl Admission {
    pub(super) fn new(path: PathBuf, policy: InvalidRays) -> Self {
        let (origin, most, rounding) = (DVec3::ZERO, f64::INFINITY, Rounding::default());
        Self { path, policy, origin, most, rounding, count: 0, first: None }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) const fn count(&self) -> u64 {
        self.count
    }

    pub(super) const fn rounding(&self) -> Rounding {
        self.rounding
    }

    /// A row of numbers that are `f32` as it stands.
    pub(super) fn admit_singles(&mut self, row: [f32; 8], place: impl FnOnce() -> String) -> Ray {
        if self.origin == DVec3::ZERO {
            self.check(super::ray_of(row), place)
        } else {
            self.admit(row.map(Into::into), place)
        }
    }

    /// The ray of a row if it is one, else [`INVALID_RAY`]; `place` says where it stands.
    pub(super) fn admit(&mut self, mut row: [Number; 8], place: impl FnOnce() -> String) -> Ray {
        let (origin, rest) = row.split_at_mut(3);
        for (number, zero) in origin.iter_mut().zip(self.origin.to_array()) {
            *number = number.minus(zero);
            self.rounding.count(*number);
        }
        // Directions and ranges are rounded relative to what they are: no place makes that worse.
        rest.iter().for_each(|&number| self.rounding.count_only(number));
        let moved = row[..3].iter().position(|number| number.shift() > self.most);
        if let (Some(axis), None) = (moved, &self.first) {
            let Number { wide, single } = row[axis];
            self.first = Some(BadInput {
                file: self.path.display().to_string(),
                place: place(),
                what: format!("{} = {wide:?} is no f32, and rounded to {single:?}", super::RAY_COLUMNS[axis]),
                more: 0,
                expected: "subtract an origin near it, or allow such rounding".to_owned(),
            });
            self.count += 1;
            return INVALID_RAY;
        }
        self.count += u64::from(moved.is_some());
        self.check(super::ray_of(row.map(|number| number.single)), place)
    }

    fn check(&mut self, ray: Ray, place: impl FnOnce() -> String) -> Ray {
        let Some(fault) = ray.fault() else { return ray };
        self.count += 1;
        if self.policy == InvalidRays::Error && self.first.is_none() {
            let text = fault.to_string();
            let (what, expected) = text.split_once("; ").unwrap_or((&text, "give a ray"));
            self.first = Some(BadInput {
                file: self.path.display().to_string(),
                place: place(),
                what: format!("{what}: {} = {:?}", super::RAY_COLUMNS.join(","), super::row_of(&ray)),
                more: 0,
                expected: expected.to_owned(),
            });
        }
        INVALID_RAY
    }

    /// Whether reading must stop because of a bad ray.
    pub(super) const fn stops(&self) -> bool {
        self.first.is_some()
    }

    /// The error to stop with, once all bad rays are counted.
    pub(super) fn error(&mut self) -> Option<Error> {
        let mut first = self.first.take()?;
        first.more = usize::try_from(self.count - 1).unwrap_or(usize::MAX);
        Some(Error::Bad(Box::new(first)))
    }
}
