use std::fmt::Arguments;

use glam::Vec3;

use crate::{BadInput, Error};
use rayproof_scene::Sphere;

/// What the wrong places of one file have in common: the first of them, and how many more there are like it.
pub(super) struct Faults<'a> {
    file: &'a str,
    first: Option<Box<BadInput>>,
}

impl<'a> Faults<'a> {
    pub(super) const fn new(file: &'a str) -> Self {
        Self { file, first: None }
    }

    /// Notes a wrong place. After the first, those that expect the same are counted and others are left for later:
    /// the message is about one thing to put right.
    pub(super) fn add(&mut self, place: Arguments<'_>, what: Arguments<'_>, expected: &str) {
        match &mut self.first {
            None => {
                let (place, what) = (place.to_string(), what.to_string());
                let bad = BadInput { file: self.file.into(), place, what, more: 0, expected: expected.into() };
                self.first = Some(Box::new(bad));
            }
            Some(first) if first.expected == expected => first.more += 1,
            Some(_) => {}
        }
    }

    /// Notes a vertex that is not finite.
    pub(super) fn vertex(&mut self, place: Arguments<'_>, v: Vec3) {
        if !v.is_finite() {
            let what = format_args!("the vertex ({:?}, {:?}, {:?}) is not finite", v.x, v.y, v.z);
            self.add(place, what, "give three finite numbers within the range of f32");
        }
    }

    /// Notes a sphere that is not one.
    pub(super) fn sphere(&mut self, place: Arguments<'_>, s: Sphere) {
        let (c, r) = (s.center, s.radius);
        if !c.is_finite() || !r.is_finite() {
            let what = format_args!("the sphere ({:?}, {:?}, {:?}, {r:?}) is not finite", c.x, c.y, c.z);
            self.add(place, what, "give x, y, z and radius as finite numbers within the range of f32");
        } else if r < 0.0 {
            self.add(place, format_args!("the radius {r:?} is negative"), "give a radius of zero or more");
        }
    }

    /// # Errors
    /// When a wrong place was noted.
    pub(super) fn none(self) -> Result<(), Error> {
        self.first.map_or(Ok(()), |bad| Err(Error::Bad(bad)))
    }
}

/// The nearest f32; infinite beyond its range.
#[expect(clippy::cast_possible_truncation, reason = "`as` rounds to the nearest, which is what a loader promises")]
pub(super) const fn nearest(x: f64) -> f32 {
    x as f32
}
