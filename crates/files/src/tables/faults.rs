use std::path::PathBuf;

use crate::{BadInput, Error};
use rayproof_scene::{INVALID_RAY, InvalidRays, Ray};

/// The bad rays of a file, so far.
pub(super) struct Faults {
    path: PathBuf,
    policy: InvalidRays,
    count: u64,
    first: Option<BadInput>,
}

impl Faults {
    pub(super) fn new(path: PathBuf, policy: InvalidRays) -> Self {
        Self { path, policy, count: 0, first: None }
    }

    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// The ray if it is one, else [`INVALID_RAY`]; `place` says where it stands.
    pub(super) fn admit(&mut self, ray: Ray, place: impl FnOnce() -> String) -> Ray {
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
    pub(super) fn stops(&self) -> bool {
        self.first.is_some()
    }

    /// The error to stop with, once all bad rays are counted.
    pub(super) fn error(&mut self) -> Option<Error> {
        let mut first = self.first.take()?;
        first.more = usize::try_from(self.count - 1).unwrap_or(usize::MAX);
        Some(Error::Bad(Box::new(first)))
    }
}
