//! The plot: speed against error, a point for each precision on each device.

use super::format::number;
use super::sections::labelled;
use super::svg::{Area, Drawing, Scale, ink, style};
use crate::model::{Panel, Point, Report};

/// What stands on the horizontal axis.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Speed {
    /// Nanoseconds a test: less is better.
    Test,
    /// Millions of rays a second: more is better.
    Rays,
}

impl Speed {
    fn of(self, point: &Point) -> f64 {
        match self {
            Self::Test => point.kernel_ns.unwrap_or(point.ns).median,
            Self::Rays => point.mrays.median,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Test => "nanoseconds a test of one ray with one primitive, without a tree (less is better)",
            Self::Rays => "millions of rays a second through a tree of 64 primitives, end to end (more is better)",
        }
    }
}

/// A point and the device that it is drawn as.
struct Placed<'r> {
    point: &'r Point,
    device: usize,
}

const WIDTH: f64 = 1180.0;
const PANEL: f64 = 590.0;
const TALL: f64 = 520.0;
const TOP: f64 = 46.0;
/// Room for an axis and its name.
const LEFT: f64 = 78.0;

/// All panels of all reports, two a row; the devices of the reports follow one another.
pub(crate) fn plot(reports: &[Report], speed: Speed) -> String {
    let devices = |(k, r): (usize, &Report)| (0..r.devices.len()).map(|i| labelled(r, k, i)).collect::<Vec<_>>();
    let names: Vec<String> = reports.iter().enumerate().flat_map(devices).collect();
    let panels = reports.first().map_or(&[][..], |r| &r.panels);
    let rows = panels.len().div_ceil(2);
    let mut drawing = Drawing::new(WIDTH, TOP + rows as f64 * TALL);
    for (i, name) in names.iter().enumerate() {
        let x = 70.0 + i as f64 * (WIDTH - 90.0) / names.len().max(1) as f64;
        drawing.mark(x, 20.0, i, "#555");
        drawing.text(x + 12.0, 24.5, "start", "#333", name);
    }
    for (i, panel) in panels.iter().enumerate() {
        let (x, y) = ((i % 2) as f64 * PANEL, TOP + (i / 2) as f64 * TALL);
        draw(&mut drawing, panel, &placed(reports, panel), speed, x, y);
    }
    drawing.finish("Speed against error of every precision on every device")
}

/// The points of a panel in all reports.
fn placed<'r>(reports: &'r [Report], panel: &Panel) -> Vec<Placed<'r>> {
    let mut all = Vec::new();
    let mut first = 0;
    for report in reports {
        let same = report.panels.iter().filter(|p| p.workload == panel.workload);
        all.extend(same.flat_map(|p| &p.points).map(|point| Placed { point, device: first + point.device }));
        first += report.devices.len();
    }
    all
}

fn draw(drawing: &mut Drawing, panel: &Panel, points: &[Placed<'_>], speed: Speed, left: f64, top: f64) {
    let (title, rest) = panel.workload.split_once(": ").unwrap_or((&panel.workload, ""));
    drawing.strong(left + LEFT, top + 14.0, title);
    drawing.text(left + LEFT, top + 31.0, "start", "#555", rest);
    let speeds: Vec<f64> = points.iter().map(|p| speed.of(p.point)).collect();
    let (low, high) = bounds(&speeds);
    // Names stand on the right of their marks.
    let x = Scale::log(low / 1.35, high * (high / low).powf(0.16) * 1.35, left + LEFT, left + PANEL - 18.0);

    let worst = points.iter().map(|p| p.point.errors.t.max).fold(10.0, f64::max);
    let y = Scale::log(0.2, worst * 2.0, top + 270.0, top + 44.0);
    drawing.axes(&x, &y, None);
    drawing.upward(left + 20.0, top + 157.0, "error of t, ULP: 99.9 % and worst");
    let half = y.place(0.5);
    drawing.line([left + LEFT, half, left + PANEL - 18.0, half], "#888", "stroke-dasharray=\"2 3\"");
    drawing.text(left + LEFT + 5.0, half - 5.0, "start", "#666", "0.5: rounding");
    errors(drawing, points, speed, &x, &y);

    let rates: Vec<f64> = points.iter().map(|p| shown_rate(p.point)).collect();
    let (lowest, _) = bounds(&rates);
    let y = Scale::log(lowest / 4.0, 100.0, top + 466.0, top + 290.0);
    drawing.axes(&x, &y, Some(speed.name()));
    drawing.upward(left + 20.0, top + 378.0, "misclassified, % of rays");
    verdicts(drawing, points, speed, &x, &y);
}

/// The least and the largest.
fn bounds(values: &[f64]) -> (f64, f64) {
    let positive = || values.iter().copied().filter(|&v| v > 0.0);
    let (low, high) = (positive().fold(f64::INFINITY, f64::min), positive().fold(0.0, f64::max));
    if low.is_finite() { (low, high) } else { (1.0, 10.0) }
}

/// The per cent that are drawn: where none was wrong, the bound.
fn shown_rate(point: &Point) -> f64 {
    let wrong = &point.errors.wrong;
    100.0 * if wrong.count == 0 { wrong.bound } else { wrong.count as f64 / wrong.of.max(1) as f64 }
}

/// Upper axes: a mark at the 99.9th percentile, a whisker up to the worst.
fn errors(drawing: &mut Drawing, points: &[Placed<'_>], speed: Speed, x: &Scale, y: &Scale) {
    let mut taken = fronts(drawing, points, speed, x, |p| p.errors.t.p999, |p| y.place(p.errors.t.p999));
    let mut labels = Vec::new();
    for Placed { point, device } in points {
        let (color, ..) = style(&point.precision);
        let (px, py, worst) = (x.place(speed.of(point)), y.place(point.errors.t.p999), y.place(point.errors.t.max));
        drawing.line([px, py, px, worst], color, "stroke-width=\"1.5\"");
        taken.push(Area { left: px - 1.0, right: px + 1.0, top: worst, bottom: py });
        drawing.line([px - 4.0, worst, px + 4.0, worst], color, "stroke-width=\"1.5\"");
        drawing.mark(px, py, *device, color);
        labels.push((px, py, color, point.precision.clone()));
    }
    label(drawing, &labels, taken, y, x);
}

/// Lower axes: a filled mark at the share of wrong verdicts; where there is none, a whisker down from the bound.
fn verdicts(drawing: &mut Drawing, points: &[Placed<'_>], speed: Speed, x: &Scale, y: &Scale) {
    let bottom = y.place(0.0);
    let none = |p: &Point| p.errors.wrong.count == 0;
    let mut taken = fronts(
        drawing,
        points,
        speed,
        x,
        |p| if none(p) { 0.0 } else { shown_rate(p) },
        |p| if none(p) { bottom - 6.0 } else { y.place(shown_rate(p)) },
    );
    let mut labels = Vec::new();
    for Placed { point, device } in points {
        let (color, ..) = style(&point.precision);
        let (px, py) = (x.place(speed.of(point)), y.place(shown_rate(point)));
        let text = if point.errors.wrong.count == 0 {
            drawing.line([px, py, px, bottom], color, "stroke-width=\"1.5\" stroke-dasharray=\"2 2\"");
            drawing.line([px - 4.0, py, px + 4.0, py], color, "stroke-width=\"1.5\"");
            taken.push(Area { left: px - 1.0, right: px + 1.0, top: py, bottom });
            drawing.mark(px, bottom - 6.0, *device, color);
            labels.push((px, bottom - 6.0, color, format!("{} 0", point.precision)));
            continue;
        } else {
            format!("{} {} %", point.precision, number(shown_rate(point)))
        };
        drawing.mark(px, py, *device, color);
        labels.push((px, py, color, text));
    }
    label(drawing, &labels, taken, y, x);
}

/// The points of each device that none of its others beats in both, joined by steps; returned is where the steps run. `error`
/// ranks, `place` draws.
fn fronts(
    drawing: &mut Drawing,
    points: &[Placed<'_>],
    speed: Speed,
    x: &Scale,
    error: impl Fn(&Point) -> f64,
    place: impl Fn(&Point) -> f64,
) -> Vec<Area> {
    let cost = |p: &Point| if speed == Speed::Test { speed.of(p) } else { -speed.of(p) };
    let devices = points.iter().map(|p| p.device + 1).max().unwrap_or(0);
    let mut taken = Vec::new();
    for device in 0..devices {
        let mut own: Vec<&Point> = points.iter().filter(|p| p.device == device).map(|p| p.point).collect();
        own.sort_by(|a, b| cost(a).total_cmp(&cost(b)).then(error(a).total_cmp(&error(b))));
        let mut best: Option<f64> = None;
        let mut path: Vec<(f64, f64)> = Vec::new();
        for point in own {
            if best.is_none_or(|best| error(point) < best) {
                let (px, py) = (x.place(speed.of(point)), place(point));
                if let Some(&(_, before)) = path.last() {
                    path.push((px, before));
                }
                path.push((px, py));
                best = Some(error(point));
            }
        }
        drawing.path(&path, "#9aa7b4", "stroke-width=\"2.5\" stroke-opacity=\"0.6\"");
        taken.extend(path.windows(2).map(|w| Area::between(w[0], w[1], 1.5)));
    }
    taken
}

/// Names beside their marks: each at the nearest place where it covers no mark, no other name and no frame.
fn label(drawing: &mut Drawing, labels: &[(f64, f64, &'static str, String)], lines: Vec<Area>, y: &Scale, x: &Scale) {
    let frame =
        Area { left: x.place(0.0), right: x.place(f64::INFINITY), top: y.place(f64::INFINITY), bottom: y.place(0.0) };
    let mut taken: Vec<Area> = labels.iter().map(|&(px, py, ..)| Area::around(px, py, 6.0)).collect();
    for (px, py, color, text) in labels {
        let width = 7.4 * text.chars().count() as f64;
        let places = (0..18).flat_map(|k| {
            let dy = f64::from((k + 1) / 2 * 14) * if k % 2 == 0 { 1.0 } else { -1.0 };
            [(px + 11.0, py + dy), (px - 11.0 - width, py + dy)]
        });
        let areas =
            places.map(|(left, middle)| Area { left, right: left + width, top: middle - 7.0, bottom: middle + 7.0 });
        let free = |area: &Area| area.is_within(&frame) && !taken.iter().any(|other| other.meets(area));
        let clear = |area: &Area| free(area) && !lines.iter().any(|other| other.meets(area));
        // Rather across a line than nowhere.
        let Some(area) = areas.clone().find(clear).or_else(|| areas.clone().find(free)) else { continue };
        let middle = (area.top + area.bottom) / 2.0;
        if (middle - py).abs() > 15.0 {
            let end = if area.left > *px { area.left } else { area.right };
            drawing.line([*px, *py, end, middle], color, "stroke-width=\"0.7\"");
        }
        drawing.text(area.left, middle + 4.5, "start", ink(color), text);
        taken.push(area);
    }
}

/// The figures of a point in words, for the table under the plot.
pub(crate) fn words(point: &Point) -> [String; 2] {
    [number(point.kernel_ns.unwrap_or(point.ns).median), number(point.mrays.median)]
}
