use std::fmt;

use crate::decimal::Number;
use crate::error::{Plain, first_of};

/// What a reader left out, or took otherwise than its user may think, though every triangle is where the file puts it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// The file, as it was named.
    pub file: String,
    /// The line or element, of the first such place.
    pub place: String,
    /// What was done there.
    pub what: String,
    /// How many more places are like it.
    pub more: usize,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, place, what, more } = self;
        write!(f, "{}: {}: {}{}", Plain(file), Plain(place), Plain(what), first_of(*more))
    }
}

/// What rounding to `f32` did to numbers that are none.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rounding {
    /// How many numbers changed.
    pub values: u64,
    /// By how much a coordinate of a place was moved at most: of a vertex, a sphere's centre or radius, or a ray's origin.
    pub largest_shift: f64,
    /// How many triangles had an area before, and have none after.
    pub flattened_triangles: u64,
}

impl Rounding {
    /// Counts a coordinate. What is beyond `f32` is no shift: it is bad input.
    pub(crate) fn count(&mut self, number: Number) {
        self.count_only(number);
        if number.shift().is_finite() {
            self.largest_shift = self.largest_shift.max(number.shift());
        }
    }

    /// Counts a number that is no place.
    pub(crate) fn count_only(&mut self, number: Number) {
        self.values += u64::from(number.shift() > 0.0);
    }
}
