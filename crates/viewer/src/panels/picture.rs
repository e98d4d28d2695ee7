//! The picture, and moving about in it.

use egui::{Color32, CursorIcon, PointerButton, Rect, Response, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use rayproof::scene::Ray;
use rayproof_picture::color::WRONG;

use super::legend;
use crate::app::App;
use crate::canvas::{fit, pixel};
use crate::inspector::Picked;
use crate::model::look::Mode;
use crate::model::navigate;
use crate::model::paint::Figures;

/// Points around the split that take hold of it.
const GRIP: f32 = 6.0;

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    let place = ui.available_rect_before_wrap();
    let scale = ui.pixels_per_point();
    let rect = fit(place, app.size, scale);
    let most = ui.input(|i| i.max_texture_side);
    let size = app.size.map_or_else(|| pixels(rect, scale, most), |size| limited(app, ui, size, most));
    ui.painter().rect_filled(place, 0.0, ui.visuals().extreme_bg_color);
    let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
    let look = app.settings.look;
    response.widget_info(|| {
        let label = format!("Picture of {}, mode {}", app.world.name, look.mode.name());
        WidgetInfo::labeled(egui::Role::Image, true, label)
    });
    if response.drag_started() || response.clicked() {
        // The keys are the camera's again.
        if let Some(focused) = ui.memory(|memory| memory.focused()) {
            ui.memory_mut(|memory| memory.surrender_focus(focused));
        }
    }
    if !split(app, ui, &response, rect) {
        navigate_by(app, ui, &response, rect);
    }
    clicks(app, ui, &response, rect, size);
    app.want(size);
    app.canvas.paint(ui.painter(), rect, app.settings.split_at);
    wrong(app, ui, rect);
    if app.canvas.look.is_split() {
        names(app, ui, rect);
    }
    legend::paint(ui.painter(), rect, app.canvas.look.mode);
    marker(app, ui, rect, size);
    if app.world.scene.is_empty() {
        let (text, font) = ("The scene is empty: there is nothing to hit.", egui::FontId::proportional(16.0));
        let galley = ui.painter().layout(text.to_owned(), font, Color32::WHITE, rect.width() - 16.0);
        ui.painter().galley(rect.center() - galley.size() * 0.5, galley, Color32::WHITE);
    }
}

/// A size that was asked for, if what paints the window can hold it.
fn limited(app: &mut App, ui: &Ui, size: [u32; 2], most: usize) -> [u32; 2] {
    let most = u32::try_from(most).unwrap_or(u32::MAX);
    if size.iter().any(|&side| side > most) {
        app.size = Some(size.map(|side| side.min(most)));
        app.tell(ui.ctx(), format!("a picture has at most {most} × {most} pixels here"));
    }
    size.map(|side| side.min(most))
}

/// The pixels of the screen in a rectangle.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
fn pixels(rect: Rect, scale: f32, most: usize) -> [u32; 2] {
    let side = |points: f32| (points * scale).round().clamp(1.0, most.min(16_384) as f32) as u32;
    [side(rect.width()), side(rect.height())]
}

/// Moves the split while it is dragged; whether it is.
fn split(app: &mut App, ui: &Ui, response: &Response, rect: Rect) -> bool {
    if !app.settings.look.is_split() {
        app.canvas.splitting = false;
        return false;
    }
    let at = |app: &App| rect.left() + app.settings.split_at * rect.width();
    let near = |x: f32, app: &App| (x - at(app)).abs() <= GRIP;
    if response.drag_started_by(PointerButton::Primary) {
        let from = ui.input(|i| i.pointer.press_origin());
        app.canvas.splitting = from.is_some_and(|from| near(from.x, app));
    }
    if !response.dragged() {
        app.canvas.splitting = false;
    }
    let hovered = response.hover_pos().is_some_and(|p| near(p.x, app));
    if app.canvas.splitting || hovered {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    if app.canvas.splitting
        && let Some(pointer) = response.interact_pointer_pos()
    {
        app.settings.split_at = ((pointer.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
    }
    app.canvas.splitting
}

/// Moves the camera by drags and the wheel.
fn navigate_by(app: &mut App, ui: &Ui, response: &Response, rect: Rect) {
    let by = response.drag_delta() / rect.height();
    let (x, y) = (f64::from(by.x), f64::from(by.y));
    let shift = ui.input(|i| i.modifiers.shift);
    if by != egui::Vec2::ZERO {
        let dragged = |button| response.dragged_by(button);
        app.camera = if dragged(PointerButton::Middle) || dragged(PointerButton::Primary) && shift {
            navigate::pan(&app.camera, -x, y)
        } else if dragged(PointerButton::Primary) {
            navigate::orbit(&app.camera, -x * std::f64::consts::PI, y * std::f64::consts::PI)
        } else {
            let angle = f64::from(app.camera.fov_y).to_radians();
            navigate::look(&app.camera, -x * angle, y * angle)
        };
    }
    if response.hovered() {
        let (scroll, zoom) = ui.input(|i| (f64::from(i.smooth_scroll_delta().y), f64::from(i.zoom_delta())));
        if scroll != 0.0 {
            app.camera = navigate::dolly(&app.camera, (-scroll / 300.0).exp());
        }
        if (zoom - 1.0).abs() > f64::EPSILON {
            app.camera = navigate::zoom(&app.camera, 1.0 / zoom);
        }
    }
}

/// Picks a ray, or looks at a point.
fn clicks(app: &mut App, ui: &Ui, response: &Response, rect: Rect, size: [u32; 2]) {
    let Some(at) = response.interact_pointer_pos() else { return };
    if response.double_clicked() {
        let ray = ray(app, size, pixel(rect, size, at));
        app.canvas.focus(ui.ctx(), &app.world, ray);
    } else if response.clicked_by(PointerButton::Primary) {
        pick(app, ui.ctx(), size, pixel(rect, size, at));
    }
}

fn ray(app: &App, size: [u32; 2], [x, y]: [u32; 2]) -> Ray {
    app.camera.pixels(size[0], size[1]).ray(x, y)
}

/// Picks the ray of a pixel.
pub(crate) fn pick(app: &mut App, context: &egui::Context, size: [u32; 2], pixel: [u32; 2]) {
    let ray = ray(app, size, pixel);
    let picked = Picked { ray, pixel: Some(pixel) };
    app.settings.side = Some(crate::settings::Side::Inspector);
    app.inspector.pick(context, &app.world, picked, None);
}

/// Rings around pixels that hit or miss wrongly, where they are few enough to be overlooked.
fn wrong(app: &App, ui: &Ui, rect: Rect) {
    const FEW: usize = 60;
    let mode = app.canvas.look.mode;
    if !mode.judges() && mode != Mode::Difference {
        return;
    }
    let [width, height] = app.canvas.size;
    let split = rect.left() + if app.canvas.look.is_split() { app.settings.split_at } else { 1.0 } * rect.width();
    let sides = [rect.with_max_x(split), rect.with_min_x(split)];
    for (figures, side) in app.canvas.figures.iter().zip(sides) {
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

/// The split and the methods on both its sides.
fn names(app: &App, ui: &Ui, rect: Rect) {
    let x = rect.left() + app.settings.split_at * rect.width();
    let painter = ui.painter().with_clip_rect(rect);
    painter.vline(x, rect.y_range(), Stroke::new(3.0, Color32::BLACK));
    painter.vline(x, rect.y_range(), Stroke::new(1.0, Color32::WHITE));
    let look = &app.canvas.look;
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
fn marker(app: &App, ui: &Ui, rect: Rect, size: [u32; 2]) {
    let Some(picked) = &app.inspector.picked else { return };
    let (origin, direction) = (picked.ray.origin.as_dvec3(), picked.ray.direction.as_dvec3());
    let t = match &app.inspector.result {
        Some(Ok(inspection)) if inspection.ray == picked.ray && inspection.truth.is_hit() => inspection.truth.t,
        _ if picked.ray.origin == app.camera.eye => 1.0,
        _ => return,
    };
    let Some([x, y]) = navigate::project(&app.camera, size, origin + f64::from(t) * direction) else { return };
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
