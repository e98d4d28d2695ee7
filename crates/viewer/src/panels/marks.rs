//! What is painted over the picture: rings around wrong pixels, the split, the picked ray.

use egui::{Color32, Rect, Stroke, Ui, pos2, vec2};
use rayproof::scene::Camera;
use rayproof_picture::color::WRONG;

use super::canvas::Canvas;
use super::inspector::Inspector;
use crate::model::look::Mode;
use crate::model::navigate;
use crate::model::paint::Figures;

/// Rings around pixels that hit or miss wrongly, where they are few enough to be overlooked.
pub(super) fn wrong(ui: &Ui, canvas: &Canvas, rect: Rect, split_at: f32) {
    const FEW: usize = 60;
    let mode = canvas.look.mode;
    if !mode.judges() && mode != Mode::Difference {
        return;
    }
    let [width, height] = canvas.size;
    let split = rect.left() + if canvas.look.is_split() { split_at } else { 1.0 } * rect.width();
    let sides = [rect.with_max_x(split), rect.with_min_x(split)];
    for (figures, side) in canvas.figures.iter().zip(sides) {
        let Some(Figures::Errors(errors)) = figures else { continue };
        if errors.places.len() > FEW {
            continue;
        }
        let painter = ui.painter().with_clip_rect(side);
        for &(place, verdict) in &errors.places {
            let share =
                vec2((place % width) as f32 + 0.5, (place / width) as f32 + 0.5) / vec2(width as f32, height as f32);
            // In the colour that the legend gives them.
            let [r, g, b] = if mode == Mode::Verdict { verdict.color() } else { WRONG };
            for (thickness, color) in [(4.0, Color32::BLACK), (2.0, Color32::from_rgb(r, g, b))] {
                painter.circle_stroke(rect.min + share * rect.size(), 6.0, Stroke::new(thickness, color));
            }
        }
    }
}

/// The split, and the precisions on both its sides.
pub(super) fn split(ui: &Ui, canvas: &Canvas, rect: Rect, split_at: f32) {
    let x = rect.left() + split_at * rect.width();
    let painter = ui.painter().with_clip_rect(rect);
    painter.vline(x, rect.y_range(), Stroke::new(3.0, Color32::BLACK));
    painter.vline(x, rect.y_range(), Stroke::new(1.0, Color32::WHITE));
    let look = &canvas.look;
    let font = egui::FontId::proportional(14.0);
    for (anchor, gap, source) in [(egui::Align2::RIGHT_TOP, -8.0, look.left), (egui::Align2::LEFT_TOP, 8.0, look.right)]
    {
        let galley = painter.layout_no_wrap(source.precision.name().to_owned(), font.clone(), Color32::WHITE);
        let place = anchor.anchor_size(pos2(x + gap, rect.top() + 8.0), galley.size());
        painter.rect_filled(place.expand(3.0), 3.0, Color32::from_black_alpha(200));
        painter.galley(place.min, galley, Color32::WHITE);
    }
}

/// What the picked ray hits; where it hits nothing, a point on its way.
pub(super) fn picked(ui: &Ui, inspector: &Inspector, camera: &Camera, rect: Rect, size: [u32; 2]) {
    let Some(picked) = &inspector.picked else { return };
    let (origin, direction) = (picked.ray.origin.as_dvec3(), picked.ray.direction.as_dvec3());
    let t = match &inspector.result {
        Some(Ok(inspection)) if inspection.ray == picked.ray && inspection.truth.is_hit() => inspection.truth.t,
        _ if picked.ray.origin == camera.eye => 1.0,
        _ => return,
    };
    let Some([x, y]) = navigate::project(camera, size, origin + f64::from(t) * direction) else { return };
    #[expect(clippy::cast_possible_truncation, reason = "a place on the screen")]
    let at = rect.min + vec2(x as f32, y as f32) * rect.size();
    let painter = ui.painter().with_clip_rect(rect);
    for (width, color) in [(3.0, Color32::BLACK), (1.0, Color32::WHITE)] {
        painter.circle_stroke(at, 7.0, Stroke::new(width, color));
        for way in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
            painter.line_segment([at + 7.0 * way, at + 13.0 * way], Stroke::new(width, color));
        }
    }
}
