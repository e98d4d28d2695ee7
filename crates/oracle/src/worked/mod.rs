//! One ray against one primitive, worked out quantity by quantity: by the formulas of four precisions and exactly, side by
//! side. It shows where digits are lost.
//!
//! The columns in `f32` and `f64` do the operations of the engines, in their order, and accept and reject as they do.
//! They work on the stored numbers, unscaled: an engine scales by powers of two, which changes no bit unless a number
//! over- or underflows or is subnormal. Then an engine may differ from what is shown here. So may an engine's tree: it
//! spares a ray the primitives whose boxes it misses, false hits on them included.
//!
//! A quantity has one name, sign and scale in all columns. Where a formula computes it with another sign, or half or a
//! quarter of it, the number shown is that times -1, 2 or 4: exact. A quantity that an engine no longer computes after
//! it has rejected the ray is shown, too, as long as it is defined.
//!
//! ```
//! use glam::Vec3;
//! use rayproof_oracle::worked::{Conclusion, work};
//! use rayproof_scene::{Primitive, Ray, Sphere};
//!
//! // A sphere of radius 1, met halfway to its rim from 10,000 away.
//! let sphere = Sphere { center: Vec3::new(0.0, 0.5, -1e4), radius: 1.0 };
//! let worked = work(&Ray::new(Vec3::ZERO, Vec3::NEG_Z), &Primitive::Sphere(sphere));
//!
//! let discriminant = worked.rows.iter().find(|row| row.name == "D").expect("a row of every sphere");
//! let shown = discriminant.values.each_ref().map(|value| value.decimal(5));
//! assert_eq!(shown, ["0", "0", "3.0000e0", "3.0000e0", "3.0000e0"]);
//! assert!(matches!(worked.answers[3], Conclusion::Hit { .. }));
//! ```

mod digits;
mod float;
mod range;
mod sphere;
#[cfg(test)]
mod tests;
mod triangle;
mod value;

use rayproof_scene::{Precision, Primitive, Ray};

pub use value::Value;

/// The precisions that are worked out, in the order of the columns. `pair` is left out: its formulas are those of `double`, and
/// its digits nearly so. `textbook` has no formula of its own for triangles; `exact` is real arithmetic, unrounded.
pub const COLUMNS: [Precision; 5] =
    [Precision::Textbook, Precision::Classic, Precision::Fast, Precision::Double, Precision::Exact];

/// The place of the exact column.
pub const EXACT: usize = COLUMNS.len() - 1;

/// A ray and a primitive, worked out by every precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Worked {
    /// Of a triangle, the equations `[b - a, c - a, -d] [u v t]^T = e - a` of each precision, in the order of [`COLUMNS`].
    pub systems: Option<[System; 5]>,
    /// The quantities, in the order in which they are computed.
    pub rows: Vec<Row>,
    /// What each precision concludes, in the order of [`COLUMNS`].
    pub answers: [Conclusion; 5],
}

/// Three equations in x, y and z: the coefficients of `u`, `v`, `t`, and the right-hand side.
pub type System = [[Value; 4]; 3];

/// One quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its name.
    pub name: &'static str,
    /// How it follows from the quantities above it; where precisions compute it otherwise, theirs is named, too.
    pub formula: &'static str,
    /// What each precision makes of it, in the order of [`COLUMNS`].
    pub values: [Value; 5],
}

/// What a precision concludes.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there are five of them")]
pub enum Conclusion {
    /// Nothing: it has no formula for the primitive.
    Absent,
    /// A miss, and why, in words.
    Miss(&'static str),
    /// A hit.
    Hit {
        /// The parameter on the ray: rounded to `f32` but for the exact column, as are `u` and `v`.
        t: Value,
        /// The weight of the triangle's second vertex; 0 on a sphere.
        u: Value,
        /// The weight of the triangle's third vertex; 0 on a sphere.
        v: Value,
    },
}

impl Conclusion {
    /// A hit as an engine writes it: zero without a sign.
    fn hit(numbers: [f32; 3]) -> Self {
        let [t, u, v] = numbers.map(|x| Value::F32(if x == 0.0 { 0.0 } else { x }));
        Self::Hit { t, u, v }
    }
}

/// Works a ray and a primitive out by every precision.
///
/// Where the ray has a [fault](Ray::fault), a number of the primitive is not finite or the radius is negative, there is
/// no exact column: its values are absent.
#[must_use]
pub fn work(ray: &Ray, primitive: &Primitive) -> Worked {
    match primitive {
        Primitive::Sphere(sphere) => {
            let columns = sphere::columns(ray, sphere);
            Worked { systems: None, rows: rows(&sphere::ROWS, &columns), answers: columns.map(|column| column.answer) }
        }
        Primitive::Triangle(triangle) => {
            let (systems, columns) = triangle::columns(ray, triangle);
            let rows = rows(&triangle::ROWS, &columns);
            Worked { systems: Some(systems), rows, answers: columns.map(|column| column.answer) }
        }
    }
}

/// What one precision makes of `N` quantities.
struct Column<const N: usize> {
    values: [Value; N],
    answer: Conclusion,
}

impl<const N: usize> Column<N> {
    /// That of a precision which does not apply.
    fn absent(answer: Conclusion) -> Self {
        Self { values: std::array::from_fn(|_| Value::Absent), answer }
    }
}

/// The name and the formula of a quantity.
type Heading = (&'static str, &'static str);

fn rows<const N: usize>(headings: &[Heading; N], columns: &[Column<N>; 5]) -> Vec<Row> {
    let values = |i: usize| columns.each_ref().map(|column| column.values[i].clone());
    headings.iter().enumerate().map(|(i, &(name, formula))| Row { name, formula, values: values(i) }).collect()
}

/// Why there is no exact answer.
const INVALID: Conclusion = Conclusion::Miss("the ray or the primitive is not valid");
