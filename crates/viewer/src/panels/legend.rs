//! What the colours of a picture stand for, in its lower left corner.

use egui::{Align2, Color32, FontId, Painter, Rect, Stroke, Vec2, pos2, vec2};
use rayproof_picture::color::{self, BACKGROUND, DECADES, Rgb, WRONG};
use rayproof_picture::shade::Verdict;

use crate::model::look::Mode;
use crate::model::paint::HIT;

/// What decides a pixel.
pub(super) const STAGES: [&str; 3] = ["f32", "double width", "exact"];

const FONT: FontId = FontId::new(12.0, egui::FontFamily::Proportional);
const PANEL: Color32 = Color32::from_black_alpha(215);
const TEXT: Color32 = Color32::WHITE;
/// Points a decade of the scale: as many as fit, between these.
const STEPS: std::ops::RangeInclusive<f32> = 14.0..=40.0;
const MARGIN: f32 = 8.0;

/// Paints the legend of a mode into a picture.
pub(super) fn paint(painter: &Painter, picture: Rect, mode: Mode) {
    let painter = painter.with_clip_rect(picture);
    match mode {
        Mode::Error | Mode::Difference => scale(&painter, picture, mode),
        Mode::Depth => depth(&painter, picture),
        Mode::Verdict => swatches(&painter, picture, &Verdict::ALL.map(|v| (v.color(), v.name()))),
        Mode::Stage => swatches(&painter, picture, &[0, 1, 2].map(|i| (color::STAGES[i], STAGES[i]))),
        Mode::Mask => swatches(&painter, picture, &[(HIT, "hit"), (BACKGROUND, "miss")]),
        Mode::Uv => {
            let corners: [(Rgb, &str); 3] = [([255, 0, 0], "1 - u - v"), ([0, 255, 0], "u"), ([0, 0, 255], "v")];
            swatches(&painter, picture, &corners);
        }
        Mode::Normal | Mode::Primitive => {}
    }
}

/// A dark box of a size in the lower left corner; returned is where its content starts, if most of the picture stays free.
fn panel(painter: &Painter, picture: Rect, size: Vec2) -> Option<egui::Pos2> {
    let size = size + Vec2::splat(2.0 * MARGIN);
    if picture.width() < size.x + 2.0 * MARGIN || picture.height() < 2.5 * size.y {
        return None;
    }
    let corner = picture.left_bottom() + vec2(MARGIN, -MARGIN - size.y);
    painter.rect_filled(Rect::from_min_size(corner, size), 4.0, PANEL);
    Some(corner + Vec2::splat(MARGIN))
}

fn text(painter: &Painter, at: egui::Pos2, anchor: Align2, text: &str) -> Rect {
    painter.text(at, anchor, text, FONT, TEXT)
}

/// The logarithmic scale of errors.
fn scale(painter: &Painter, picture: Rect, mode: Mode) {
    let beside = 62.0;
    let room = (picture.width() - beside - 4.0 * MARGIN) / 7.0;
    let step = room.clamp(*STEPS.start(), *STEPS.end()).floor();
    let length = 7.0 * step;
    let wrong = if mode == Mode::Error { "wrong answer" } else { "another, or none" };
    // Below each other where they do not fit beside each other.
    let below = if length < 200.0 { 18.0 } else { 0.0 };
    let Some(at) = panel(painter, picture, vec2(length + beside, 52.0 + below)) else { return };
    let at = at + vec2(10.0, 0.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some hundred points")]
    let columns = length as u16;
    for x in 0..columns {
        let [r, g, b] = color::viridis(f64::from(x) / f64::from(columns - 1));
        let column = Rect::from_min_size(at + vec2(f32::from(x), 0.0), vec2(1.0, 12.0));
        painter.rect_filled(column, 0.0, Color32::from_rgb(r, g, b));
    }
    for (i, label) in (0_u8..).zip(DECADES) {
        let x = at.x + step * f32::from(i);
        painter.vline(x, at.y + 12.0..=at.y + 16.0, Stroke::new(1.0, TEXT));
        // Every second where they are close.
        if step >= 34.0 || i % 2 == 0 {
            text(painter, pos2(x, at.y + 17.0), Align2::CENTER_TOP, label);
        }
    }
    text(painter, at + vec2(length + 22.0, 17.0), Align2::LEFT_TOP, "ULP");
    let next = swatch(painter, at + vec2(0.0, 44.0), WRONG, wrong);
    let place = if below > 0.0 { at + vec2(0.0, 62.0) } else { pos2(next + 16.0, at.y + 44.0) };
    swatch(painter, place, BACKGROUND, "miss");
}

/// Near to far.
fn depth(painter: &Painter, picture: Rect) {
    let length = 160_u16;
    let Some(at) = panel(painter, picture, vec2(f32::from(length), 28.0)) else { return };
    for x in 0..length {
        let [r, g, b] = color::cividis(1.0 - f64::from(x) / f64::from(length - 1));
        let column = Rect::from_min_size(at + vec2(f32::from(x), 0.0), vec2(1.0, 12.0));
        painter.rect_filled(column, 0.0, Color32::from_rgb(r, g, b));
    }
    text(painter, at + vec2(0.0, 14.0), Align2::LEFT_TOP, "nearest");
    text(painter, at + vec2(f32::from(length), 14.0), Align2::RIGHT_TOP, "farthest");
}

/// One colour a line.
fn swatches(painter: &Painter, picture: Rect, entries: &[(Rgb, &str)]) {
    let width = entries.iter().map(|(_, label)| painter.layout_no_wrap((*label).to_owned(), FONT, TEXT).size().x);
    let size = vec2(width.fold(0.0, f32::max) + 18.0, 18.0 * entries.len() as f32);
    let Some(at) = panel(painter, picture, size) else { return };
    for (i, &(color, label)) in entries.iter().enumerate() {
        swatch(painter, at + vec2(0.0, 18.0 * i as f32 + 9.0), color, label);
    }
}

/// A colour and what it stands for, from its left middle; returned is where it ends.
fn swatch(painter: &Painter, at: egui::Pos2, [r, g, b]: Rgb, label: &str) -> f32 {
    let square = Rect::from_center_size(at + vec2(6.0, 0.0), Vec2::splat(12.0));
    painter.rect(square, 2.0, Color32::from_rgb(r, g, b), Stroke::new(1.0, TEXT), egui::StrokeKind::Inside);
    text(painter, at + vec2(18.0, 0.0), Align2::LEFT_CENTER, label).right()
}
