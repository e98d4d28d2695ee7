//! The picture on the screen: its textures, and what a pointer does to it.

use std::sync::Arc;

use egui::{Color32, ColorImage, Rect, TextureHandle, TextureOptions, Vec2, pos2};
use glam::Vec3;
use rayproof::Precision;
use rayproof::scene::{FlatHit, Ray};

use crate::act::Act;
use crate::model::look::Look;
use crate::model::paint::Figures;
use crate::model::task::{Task, take};
use crate::model::tracer::Tracer;
use crate::model::view::{Picture, Progress};
use crate::model::world::World;

/// The textures of the picture, and what is looked up in the scene under the pointer.
#[derive(Default)]
pub(crate) struct Canvas {
    textures: [Option<TextureHandle>; 2],
    /// The version of the picture that the textures hold.
    version: u64,
    /// The size that was asked for; without one it is that of the picture's place in the window.
    pub(super) asked: Option<[u32; 2]>,
    pub(crate) size: [u32; 2],
    /// How the picture is shown, which may not yet be how it is wanted.
    pub(crate) look: Look,
    /// About each side of the picture, when it is whole.
    pub(crate) figures: [Option<Figures>; 2],
    pub(crate) progress: Progress,
    /// Whether the pointer drags the split.
    pub(super) splitting: bool,
    focusing: Option<Task<Option<Vec3>>>,
}

impl Canvas {
    /// A canvas without a picture yet; of a size, where one is asked for.
    pub(crate) fn new(asked: Option<[u32; 2]>) -> Self {
        Self { asked, ..Self::default() }
    }

    /// Takes the newest picture to the device that paints the window.
    pub(crate) fn upload(&mut self, context: &egui::Context, tracer: &Tracer) {
        let picture = tracer.picture();
        self.progress.clone_from(&picture.progress);
        if picture.version == self.version {
            return;
        }
        self.version = picture.version;
        self.size = picture.size;
        self.look = picture.look;
        self.figures.clone_from(&picture.figures);
        for (texture, pixels) in self.textures.iter_mut().zip(&picture.sides) {
            if pixels.is_empty() {
                *texture = None;
                continue;
            }
            let image = ColorImage::from_rgb(picture.size.map(|side| side as usize), pixels.as_flattened());
            match texture {
                Some(texture) => texture.set(image, TextureOptions::NEAREST),
                None => *texture = Some(context.load_texture("picture", image, TextureOptions::NEAREST)),
            }
        }
    }

    /// Whether the textures hold this picture.
    pub(crate) const fn shows(&self, picture: &Picture) -> bool {
        self.version == picture.version
    }

    /// Paints the picture into a rectangle, the second side right of the split.
    pub(super) fn paint(&self, painter: &egui::Painter, rect: Rect, split_at: f32) {
        let [Some(left), right] = &self.textures else { return };
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(left.id(), rect, whole, Color32::WHITE);
        if let Some(right) = right {
            let at = split_column(split_at, self.size[0]) as f32 / self.size[0] as f32;
            let x = rect.left() + at * rect.width();
            let uv = Rect::from_min_max(pos2(at, 0.0), pos2(1.0, 1.0));
            painter.image(right.id(), rect.with_min_x(x), uv, Color32::WHITE);
        }
    }

    /// Looks for the point of the scene that a ray hits, to look at it.
    pub(super) fn focus(&mut self, context: &egui::Context, world: &Arc<World>, ray: Ray) {
        let world = world.clone();
        self.focusing = Some(Task::start(context, move || {
            let mut hit = [FlatHit::MISS];
            world.on_cpu(Precision::Exact).ok()?.closest_flat(&[ray], &mut hit).ok()?;
            hit[0].is_hit().then(|| ray.at(hit[0].t)).filter(|point| point.is_finite())
        }));
    }

    /// Looks at the point when it is found.
    pub(crate) fn collect(&mut self) -> Option<Act> {
        take(&mut self.focusing)?.ok().flatten().map(Act::LookAt)
    }
}

/// The first column of pixels right of the split.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of the width")]
pub(crate) fn split_column(at: f32, width: u32) -> u32 {
    (f64::from(at.clamp(0.0, 1.0)) * f64::from(width)).round() as u32
}

/// The largest rectangle of the picture's shape in a place; without a shape the place itself. In whole pixels of the screen.
pub(super) fn fit(place: Rect, size: Option<[u32; 2]>, pixels_per_point: f32) -> Rect {
    let snap = |x: f32| (x * pixels_per_point).round() / pixels_per_point;
    let whole = match size {
        None => place.size(),
        Some(size) => {
            let points = Vec2::from(size.map(|side| side as f32 / pixels_per_point));
            let scale = (place.width() / points.x).min(place.height() / points.y);
            // Pixels are not enlarged: one of the picture is one of the screen.
            points * scale.min(1.0)
        }
    };
    let min = place.center() - whole * 0.5;
    Rect::from_min_size(pos2(snap(min.x), snap(min.y)), Vec2::new(snap(whole.x), snap(whole.y)))
}

/// The pixel of the picture under a point of the screen.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
pub(super) fn pixel(rect: Rect, size: [u32; 2], at: egui::Pos2) -> [u32; 2] {
    let share = (at - rect.min) / rect.size();
    let pixel = |share: f32, side: u32| ((share * side as f32).floor().max(0.0) as u32).min(side.saturating_sub(1));
    [pixel(share.x, size[0]), pixel(share.y, size[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_fitted_and_its_pixels_are_found() {
        let place = Rect::from_min_size(pos2(10.25, 20.0), Vec2::new(400.0, 300.0));
        assert_eq!(fit(place, None, 2.0).size(), place.size());
        let small = fit(place, Some([200, 100]), 1.0);
        assert_eq!((small.size(), small.center().round()), (Vec2::new(200.0, 100.0), place.center().round()));
        let large = fit(place, Some([800, 800]), 1.0);
        assert_eq!(large.size(), Vec2::splat(300.0));
        let rect = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(100.0, 50.0));
        for (at, expected) in [((10.0, 20.0), [0, 0]), ((109.9, 69.9), [199, 99]), ((500.0, 0.0), [199, 0])] {
            assert_eq!(pixel(rect, [200, 100], pos2(at.0, at.1)), expected);
        }
        assert_eq!([0.0, 0.5, 1.0, 2.0].map(|at| split_column(at, 7)), [0, 4, 7, 7]);
    }
}
