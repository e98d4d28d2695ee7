//! Plots as text: scales, axes, marks and labels that keep out of each other's way.

use std::fmt::Write as _;

use super::format::{escape, number};

/// A precision's colour (Okabe and Ito 2008: told apart by all kinds of colour vision), dash and width. Curves lie on one another
/// where precisions agree: the later ones are thinner or dashed, so that all are seen.
pub(crate) fn style(precision: &str) -> (&'static str, &'static str, f64) {
    match precision {
        "textbook" => ("#d55e00", "", 5.0),
        "classic" => ("#e69f00", "", 2.0),
        "fast" => ("#0072b2", "", 2.5),
        "pair" => ("#cc79a7", "", 6.0),
        "double" => ("#009e73", "", 3.5),
        _ => ("#000000", "5 4", 1.6),
    }
}

/// A precision's colour for text, dark enough to read.
pub(crate) fn ink(color: &'static str) -> &'static str {
    match color {
        "#e69f00" => "#946200",
        "#cc79a7" => "#9c4a77",
        "#d55e00" => "#b34e00",
        "#009e73" => "#00795a",
        other => other,
    }
}

/// A logarithmic scale from values to places.
#[derive(Clone, Copy)]
pub(crate) struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// From `low..high`, both positive, to the places `from..to`; other values go to the nearer end.
    pub(crate) fn log(low: f64, high: f64, from: f64, to: f64) -> Self {
        Self { low: low.log10(), high: high.log10().max(low.log10() + 0.1), from, to }
    }

    pub(crate) fn place(&self, x: f64) -> f64 {
        let share = (x.max(1e-300).log10() - self.low) / (self.high - self.low);
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// Powers of ten, with 2 and 5 times them where those are few; every second or third where they are many.
    pub(crate) fn ticks(&self) -> Vec<f64> {
        let decades = self.high - self.low;
        let step = if decades > 10.0 { 2 } else { 1 };
        let mut ticks = Vec::new();
        #[expect(clippy::cast_possible_truncation, reason = "decades of a plot")]
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        for exponent in (first..=last).step_by(step) {
            let factors: &[f64] = if decades <= 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
            ticks.extend(factors.iter().map(|factor| factor * 10.0_f64.powi(exponent)));
        }
        ticks.retain(|tick| tick.log10() >= self.low - 1e-9 && tick.log10() <= self.high + 1e-9);
        ticks
    }
}

/// A drawing under way.
pub(crate) struct Drawing {
    pub(crate) body: String,
    width: f64,
    height: f64,
}

impl Drawing {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        Self { body: String::new(), width, height }
    }

    /// The whole as an element; alone it is a file.
    pub(crate) fn finish(self, title: &str) -> String {
        let Self { body, width, height } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             font-family=\"system-ui, 'Segoe UI', Helvetica, Arial, sans-serif\" font-size=\"13\">\n<title>{}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{body}</svg>\n",
            escape(title)
        )
    }

    pub(crate) fn text(&mut self, x: f64, y: f64, anchor: &str, color: &str, text: &str) {
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{color}\" stroke=\"#fff\" \
             stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
            escape(text)
        );
    }

    pub(crate) fn strong(&mut self, x: f64, y: f64, text: &str) {
        let _ = writeln!(self.body, "<text x=\"{x:.1}\" y=\"{y:.1}\" font-weight=\"600\">{}</text>", escape(text));
    }

    /// Text that runs upward, in the middle of a vertical axis.
    pub(crate) fn upward(&mut self, x: f64, y: f64, text: &str) {
        let _ = writeln!(
            self.body,
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\" fill=\"#333\">{}</text>",
            escape(text)
        );
    }

    pub(crate) fn line(&mut self, [x1, y1, x2, y2]: [f64; 4], color: &str, more: &str) {
        let _ = writeln!(
            self.body,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{color}\" {more}/>"
        );
    }

    pub(crate) fn path(&mut self, points: &[(f64, f64)], color: &str, more: &str) {
        if points.is_empty() {
            return;
        }
        let points: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let points = points.join(" ");
        let _ = writeln!(
            self.body,
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-linejoin=\"round\" {more}/>"
        );
    }

    /// The mark of a device: each has its own shape.
    pub(crate) fn mark(&mut self, x: f64, y: f64, device: usize, color: &str) {
        let r = 5.0;
        let polygon = |corners: &[(f64, f64)]| {
            let points: Vec<String> =
                corners.iter().map(|(dx, dy)| format!("{:.1},{:.1}", x + dx * r, y + dy * r)).collect();
            format!("<polygon points=\"{}\" fill=\"{color}\" stroke=\"#fff\"/>", points.join(" "))
        };
        let shape = match device % 4 {
            0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\" fill=\"{color}\" stroke=\"#fff\"/>"),
            1 => polygon(&[(-0.95, -0.95), (0.95, -0.95), (0.95, 0.95), (-0.95, 0.95)]),
            2 => polygon(&[(0.0, -1.2), (1.15, 0.9), (-1.15, 0.9)]),
            _ => polygon(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]),
        };
        self.body.push_str(&shape);
        self.body.push('\n');
    }

    /// A frame with grid lines and ticks; the horizontal axis has its numbers only where it has a name.
    pub(crate) fn axes(&mut self, x: &Scale, y: &Scale, name: Option<&str>) {
        let (left, right, top, bottom) = (x.from, x.to, y.to, y.from);
        for tick in x.ticks() {
            let at = x.place(tick);
            self.line([at, top, at, bottom], "#e4e4e4", "");
            if name.is_some() {
                self.text(at, bottom + 17.0, "middle", "#333", &tick_text(tick));
            }
        }
        for tick in y.ticks() {
            let at = y.place(tick);
            self.line([left, at, right, at], "#e4e4e4", "");
            self.text(left - 7.0, at + 4.0, "end", "#333", &tick_text(tick));
        }
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            self.body,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" \
            stroke=\"#888\"/>"
        );
        if let Some(name) = name {
            self.text((left + right) / 2.0, bottom + 36.0, "middle", "#333", name);
        }
    }
}

/// A tick's number: far powers of ten as such.
pub(crate) fn tick_text(x: f64) -> String {
    let exponent = x.log10().round();
    if (0.009..99_999.0).contains(&x) || (x.log10() - exponent).abs() > 1e-9 {
        return if x >= 1000.0 { number(x) } else { format!("{}", (x * 1e6).round() / 1e6) };
    }
    let digits = format!("{exponent}");
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => c.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(c),
    };
    format!("10{}", digits.chars().map(raised).collect::<String>())
}

/// A part of a drawing.
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

impl Area {
    pub(crate) fn around(x: f64, y: f64, r: f64) -> Self {
        Self { left: x - r, right: x + r, top: y - r, bottom: y + r }
    }

    /// The box around two points, that much larger.
    pub(crate) fn between((x1, y1): (f64, f64), (x2, y2): (f64, f64), more: f64) -> Self {
        Self { left: x1.min(x2) - more, right: x1.max(x2) + more, top: y1.min(y2) - more, bottom: y1.max(y2) + more }
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    pub(crate) fn is_within(&self, frame: &Self) -> bool {
        self.left >= frame.left && self.right <= frame.right && self.top >= frame.top && self.bottom <= frame.bottom
    }
}

/// Moves labels apart that stand one above the other: their places in order, each at least `gap` from the last, as near
/// to where
/// they belong as that lets them, and none outside of `low..high` while there is room.
pub(crate) fn spread(wanted: &[f64], gap: f64, low: f64, high: f64) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|&a, &b| wanted[a].total_cmp(&wanted[b]));
    let mut places = vec![0.0; wanted.len()];
    let mut next = low;
    for &i in &order {
        places[i] = wanted[i].max(next);
        next = places[i] + gap;
    }
    let mut limit = high;
    for &i in order.iter().rev() {
        places[i] = places[i].min(limit);
        limit = places[i] - gap;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_overlap() {
        for wanted in [vec![10.0, 10.0, 10.0, 11.0], vec![0.0, 99.0, 98.0, 97.0], vec![50.0], vec![]] {
            let places = spread(&wanted, 14.0, 0.0, 100.0);
            let mut sorted = places.clone();
            sorted.sort_by(f64::total_cmp);
            assert!(sorted.windows(2).all(|w| w[1] - w[0] >= 14.0 - 1e-9), "{wanted:?}: {places:?}");
            assert!(places.iter().all(|p| (0.0..=100.0).contains(p)), "{wanted:?}: {places:?}");
        }
    }

    #[test]
    fn ticks_lie_on_the_scale() {
        let scale = Scale::log(0.3, 700.0, 100.0, 400.0);
        assert_eq!(scale.ticks(), [1.0, 10.0, 100.0]);
        assert_eq!((scale.place(0.3), scale.place(700.0), scale.place(1e-20)), (100.0, 400.0, 100.0));
        let texts = [1e-6, 0.01, 0.5, 1.0, 20.0, 10_000.0, 1e8].map(tick_text);
        assert_eq!(texts, ["10⁻⁶", "0.01", "0.5", "1", "20", "10,000", "10⁸"]);
        assert_eq!(Scale::log(1.0, 20.0, 0.0, 1.0).ticks(), [1.0, 2.0, 5.0, 10.0, 20.0]);
    }
}
