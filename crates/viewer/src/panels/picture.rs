//! The picture, and moving about in it.

use std::sync::Arc;

use egui::{Color32, CursorIcon, PointerButton, Rect, Response, Sense, Ui, WidgetInfo};
use rayproof::scene::Camera;

use super::canvas::{Canvas, fit, pixel};
use super::inspector::{Inspector, Picked};
use super::{legend, marks};
use crate::act::Act;
use crate::model::navigate;
use crate::model::world::World;
use crate::settings::Settings;
use crate::standpoint::Standpoint;

/// Points around the split that take hold of it.
const GRIP: f32 = 6.0;

impl Canvas {
    /// Shows the picture, as far as it is, in the room that there is.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        settings: &Settings,
        standpoint: &Standpoint,
        inspector: &Inspector,
    ) -> Vec<Act> {
        let mut acts = Vec::new();
        let place = ui.available_rect_before_wrap();
        let rect = fit(place, self.asked, ui.pixels_per_point());
        let size = self.wanted(ui, rect, &mut acts);
        ui.painter().rect_filled(place, 0.0, ui.visuals().extreme_bg_color);
        let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
        let (world, look) = (&standpoint.world, settings.look);
        response.widget_info(|| {
            let label = format!("Picture of {}, mode {}", world.name, look.mode.name());
            WidgetInfo::labeled(egui::Role::Image, true, label)
        });
        if response.drag_started() || response.clicked() {
            // The keys are the camera's again.
            if let Some(focused) = ui.memory(|memory| memory.focused()) {
                ui.memory_mut(|memory| memory.surrender_focus(focused));
            }
        }
        let (mut camera, mut split_at) = (standpoint.camera, settings.split_at);
        if look.is_split() {
            split_at = self.drag_split(ui, &response, rect, split_at);
            acts.push(Act::SplitAt(split_at));
        } else {
            self.splitting = false;
        }
        if !self.splitting {
            camera = moved(ui, &response, rect, camera);
            acts.push(Act::See(camera));
        }
        acts.extend(self.clicks(ui, &response, &standpoint.world, &camera, rect, size));
        acts.push(Act::Trace(size));
        self.paint(ui.painter(), rect, split_at);
        marks::wrong(ui, self, rect, split_at);
        if self.look.is_split() {
            marks::split(ui, self, rect, split_at);
        }
        legend::paint(ui.painter(), rect, self.look.mode);
        marks::picked(ui, inspector, &camera, rect, size);
        if world.scene.is_empty() {
            let (text, font) = ("The scene is empty: there is nothing to hit.", egui::FontId::proportional(16.0));
            let galley = ui.painter().layout(text.to_owned(), font, Color32::WHITE, rect.width() - 16.0);
            ui.painter().galley(rect.center() - galley.size() * 0.5, galley, Color32::WHITE);
        }
        acts
    }

    /// The size that the picture should have: no more pixels than what paints the window can hold.
    fn wanted(&mut self, ui: &Ui, rect: Rect, acts: &mut Vec<Act>) -> [u32; 2] {
        let most = ui.input(|i| i.max_texture_side);
        let Some(size) = self.asked else { return pixels(rect, ui.pixels_per_point(), most) };
        let most = u32::try_from(most).unwrap_or(u32::MAX);
        let held = size.map(|side| side.min(most));
        if held != size {
            self.asked = Some(held);
            acts.push(Act::Tell(format!("a picture has at most {most} × {most} pixels here")));
        }
        held
    }

    /// Where the split is; it moves while it is dragged.
    fn drag_split(&mut self, ui: &Ui, response: &Response, rect: Rect, split_at: f32) -> f32 {
        let near = |x: f32| (x - (rect.left() + split_at * rect.width())).abs() <= GRIP;
        if response.drag_started_by(PointerButton::Primary) {
            let from = ui.input(|i| i.pointer.press_origin());
            self.splitting = from.is_some_and(|from| near(from.x));
        }
        self.splitting &= response.dragged();
        let hovered = response.hover_pos().is_some_and(|p| near(p.x));
        if self.splitting || hovered {
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        match response.interact_pointer_pos() {
            Some(pointer) if self.splitting => ((pointer.x - rect.left()) / rect.width()).clamp(0.0, 1.0),
            _ => split_at,
        }
    }

    /// Picks a ray, or looks at a point.
    fn clicks(
        &mut self,
        ui: &Ui,
        response: &Response,
        world: &Arc<World>,
        camera: &Camera,
        rect: Rect,
        size: [u32; 2],
    ) -> Option<Act> {
        let picked = Picked::through(camera, size, pixel(rect, size, response.interact_pointer_pos()?));
        if response.double_clicked() {
            self.focus(ui.ctx(), world, picked.ray);
            return None;
        }
        response.clicked_by(PointerButton::Primary).then_some(Act::Inspect(picked, None))
    }
}

/// The pixels of the screen in a rectangle.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
fn pixels(rect: Rect, scale: f32, most: usize) -> [u32; 2] {
    let side = |points: f32| (points * scale).round().clamp(1.0, most.min(16_384) as f32) as u32;
    [side(rect.width()), side(rect.height())]
}

/// The camera, moved by drags and the wheel.
fn moved(ui: &Ui, response: &Response, rect: Rect, mut camera: Camera) -> Camera {
    let by = response.drag_delta() / rect.height();
    let (x, y) = (f64::from(by.x), f64::from(by.y));
    let shift = ui.input(|i| i.modifiers.shift);
    if by != egui::Vec2::ZERO {
        let dragged = |button| response.dragged_by(button);
        camera = if dragged(PointerButton::Middle) || dragged(PointerButton::Primary) && shift {
            navigate::pan(&camera, -x, y)
        } else if dragged(PointerButton::Primary) {
            navigate::orbit(&camera, -x * std::f64::consts::PI, y * std::f64::consts::PI)
        } else {
            let angle = f64::from(camera.fov_y).to_radians();
            navigate::look(&camera, -x * angle, y * angle)
        };
    }
    if response.hovered() {
        let (scroll, zoom) = ui.input(|i| (f64::from(i.smooth_scroll_delta().y), f64::from(i.zoom_delta())));
        if scroll != 0.0 {
            camera = navigate::dolly(&camera, (-scroll / 300.0).exp());
        }
        if (zoom - 1.0).abs() > f64::EPSILON {
            camera = navigate::zoom(&camera, 1.0 / zoom);
        }
    }
    camera
}
