//! Error against distance, and wrong verdicts against the margin.

use super::svg::{Drawing, Scale, ink, spread, style};
use crate::model::{DistanceCurve, MarginCurve, Rate, Report};

const WIDTH: f64 = 1180.0;

/// The curves of the first device, and of others where they differ from it.
fn distinct<C>(curves: &[C], device: impl Fn(&C) -> usize, same: impl Fn(&C, &C) -> bool) -> impl Iterator<Item = &C> {
    let first = move |curve: &C| curves.iter().filter(|c| device(c) == 0).any(|c| same(c, curve)) && device(curve) != 0;
    curves.iter().filter(move |curve| !first(curve))
}

/// Error of `t` (above) and the share of wrong verdicts (below) against distance over radius.
pub(crate) fn distance(report: &Report) -> String {
    let same = |a: &DistanceCurve, b: &DistanceCurve| a.precision == b.precision && a.points == b.points;
    let curves: Vec<&DistanceCurve> = distinct(&report.distance, |c| c.device, same).collect();
    let mut drawing = Drawing::new(WIDTH, 640.0);
    let points = || curves.iter().flat_map(|c| &c.points);
    let (near, far) = points().fold((1e8_f64, 10.0_f64), |(a, b), p| (a.min(p.distance), b.max(p.distance)));
    let x = Scale::log(near.min(1.0), far, 70.0, WIDTH - 120.0);
    let worst = points().map(|p| p.t.max).fold(10.0, f64::max);
    let y = Scale::log(0.2, worst * 2.0, 370.0, 20.0);
    drawing.axes(&x, &y, None);
    drawing.upward(18.0, 195.0, "error of t in ULP: 99 % (thick) and worst (thin)");
    let half = y.place(0.5);
    drawing.line([70.0, half, WIDTH - 120.0, half], "#888", "stroke-dasharray=\"2 3\"");
    let mut ends = Vec::new();
    for curve in &curves {
        let (color, dash, width) = style(&curve.precision);
        let known = || curve.points.iter().filter(|p| p.t.n > 0);
        let line = |of: fn(&crate::model::Quantiles) -> f64| -> Vec<(f64, f64)> {
            known().map(|p| (x.place(p.distance), y.place(of(&p.t)))).collect()
        };
        drawing.path(&line(|t| t.max), color, "stroke-width=\"1\" stroke-opacity=\"0.55\"");
        drawing.path(&line(|t| t.p99), color, &format!("stroke-width=\"{width}\" stroke-dasharray=\"{dash}\""));
        if let Some(&(_, at)) = line(|t| t.p99).last() {
            ends.push((WIDTH - 120.0, at, color, curve.precision.clone()));
        }
    }
    names(&mut drawing, &ends, [28.0, 370.0]);

    let shares = |c: &DistanceCurve| c.points.iter().map(|p| (p.distance, p.wrong)).collect::<Vec<_>>();
    let curves: Vec<_> = curves.iter().map(|c| (c.precision.as_str(), shares(c))).collect();
    rates(&mut drawing, &curves, &x, [590.0, 400.0], "distance of the eye from the centre, over the radius");
    drawing.finish("Error of t and misclassified rays against the distance of a sphere")
}

/// Wrong verdicts against the margin, spheres on the left and triangles on the right.
pub(crate) fn margins(report: &Report) -> String {
    let same = |a: &MarginCurve, b: &MarginCurve| {
        (&a.precision, &a.primitive) == (&b.precision, &b.primitive) && a.points == b.points
    };
    let all: Vec<&MarginCurve> = distinct(&report.margins, |c| c.device, same).collect();
    let mut drawing = Drawing::new(WIDTH, 400.0);
    let from = [("sphere", "distance from the silhouette"), ("triangle", "distance from the edge")];
    for (i, (primitive, what)) in from.into_iter().enumerate() {
        let left = 70.0 + i as f64 * 590.0;
        let curves: Vec<&MarginCurve> = all.iter().copied().filter(|c| c.primitive == primitive).collect();
        let points = || curves.iter().flat_map(|c| &c.points);
        let (low, high) = points().fold((1.0_f64, 10.0_f64), |(a, b), p| (a.min(p.margin), b.max(p.margin)));
        let x = Scale::log(low, high, left, left + 420.0);
        let shares = |c: &MarginCurve| c.points.iter().map(|p| (p.margin, p.wrong)).collect::<Vec<_>>();
        let named: Vec<_> = curves.iter().map(|c| (c.precision.as_str(), shares(c))).collect();
        drawing.strong(left, 18.0, if primitive == "sphere" { "Spheres" } else { "Triangles" });
        rates(&mut drawing, &named, &x, [340.0, 30.0], &format!("{what}, in roundings of the largest coordinate"));
    }
    drawing.finish("Misclassified rays against the distance from the silhouette or the edge")
}

/// Curves of shares, with a band below for none; named at their right ends.
fn rates(drawing: &mut Drawing, curves: &[(&str, Vec<(f64, Rate)>)], x: &Scale, [bottom, top]: [f64; 2], name: &str) {
    let shares = || curves.iter().flat_map(|(_, points)| points).filter(|(_, rate)| rate.count > 0);
    let lowest = shares().map(|(_, rate)| 100.0 * rate.count as f64 / rate.of as f64).fold(10.0, f64::min);
    let y = Scale::log(lowest / 2.0, 100.0, bottom - 26.0, top);
    drawing.axes(x, &y, None);
    let (left, right) = (x.place(0.0), x.place(f64::INFINITY));
    drawing.text(left - 7.0, bottom - 6.0, "end", "#333", "none");
    drawing.upward(left - 52.0, (top + bottom) / 2.0, "misclassified, %");
    drawing.line([left, bottom, right, bottom], "#888", "");
    for &(tick, ref text) in &ticks(x) {
        drawing.text(tick, bottom + 17.0, "middle", "#333", text);
    }
    drawing.text((left + right) / 2.0, bottom + 36.0, "middle", "#333", name);
    let mut ends = Vec::new();
    for (precision, points) in curves {
        let (color, dash, width) = style(precision);
        let place = |&(at, rate): &(f64, Rate)| {
            let share = 100.0 * rate.count as f64 / rate.of.max(1) as f64;
            (x.place(at), if rate.count == 0 { bottom - 10.0 } else { y.place(share) })
        };
        let line: Vec<(f64, f64)> = points.iter().map(place).collect();
        drawing.path(&line, color, &format!("stroke-width=\"{width}\" stroke-dasharray=\"{dash}\""));
        // Where it falls to none, a curve is told apart best; else at its end.
        let fall = points.iter().rposition(|(_, rate)| rate.count > 0).filter(|&i| i + 1 < points.len());
        if let Some(&(end, at)) = fall.map_or(line.last(), |i| line.get(i)) {
            ends.push((if fall.is_some() { end } else { right }, at, color, (*precision).to_owned()));
        }
    }
    let (inner, outer): (Vec<_>, Vec<_>) = ends.into_iter().partition(|(x, ..)| *x < right);
    for group in [inner, outer] {
        names(drawing, &group, [top + 8.0, bottom + 4.0]);
    }
}

fn ticks(x: &Scale) -> Vec<(f64, String)> {
    x.ticks().into_iter().map(|tick| (x.place(tick), super::svg::tick_text(tick))).collect()
}

/// Names on the right of ends of curves, moved apart.
fn names(drawing: &mut Drawing, ends: &[(f64, f64, &'static str, String)], [top, bottom]: [f64; 2]) {
    let wanted: Vec<f64> = ends.iter().map(|(_, at, ..)| at + 4.0).collect();
    for ((end, _, color, precision), at) in ends.iter().zip(spread(&wanted, 14.0, top, bottom)) {
        drawing.text(end + 8.0, at, "start", ink(color), precision);
    }
}
