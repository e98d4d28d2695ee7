//! A line and a sphere, exactly.
//!
//! With `o = e - c`, `|o + t d|^2 = r^2` is `a t^2 + 2 b t + c' = 0` for `a = d.d`, `b = o.d`, `c' = o.o - r^2`; its
//! roots are `p +- sqrt(D)` with `p = -b / a` and `D = (b^2 - a c') / a^2`.

use dashu_base::Sign;
use rayproof_scene::Sphere;

use crate::{
    rational::{Line, Number, dot, number, sub, vector},
    root::Root,
};

/// Where a line meets a sphere.
pub(crate) enum Roots {
    /// Nowhere.
    None,
    /// In one point: a tangent, or a sphere without radius.
    Double(Root),
    /// In two, in order.
    Two([Root; 2]),
}

impl Roots {
    pub(crate) fn new(line: &Line, sphere: &Sphere) -> Self {
        let o = sub(&line.e, &vector(sphere.center));
        let (a, b) = (dot(&line.d, &line.d), dot(&o, &line.d));
        let c = dot(&o, &o) - number(sphere.radius).sqr();
        let discriminant = b.sqr() - &a * c;
        if discriminant < Number::ZERO {
            return Self::None;
        }
        let p = (-b / &a).canonicalize();
        if discriminant.is_zero() {
            return Self::Double(p.into());
        }
        let radicand = (discriminant / a.sqr()).canonicalize();
        Self::Two([Sign::Negative, Sign::Positive].map(|sign| Root::new(p.clone(), sign, radicand.clone())))
    }
}
