//! The scale of an error picture and the colours of one of stages, drawn into the lower left corner.

use font8x8::{BASIC_FONTS, UnicodeFonts as _};
use rayproof_picture::color::{BACKGROUND, DECADES, Rgb, STAGES, WRONG, viridis};

use crate::picture::Picture;

/// Pixels a decade: the widest label and a gap.
const STEP: u32 = 40;
const WIDTH: u32 = STEP * 9;
const HEIGHT: u32 = 48;
const PANEL: Rgb = [0, 0, 0];
const TEXT: Rgb = [255, 255, 255];

/// Draws the scale, if the picture is large enough to leave most of it free.
pub(crate) fn draw(picture: &mut Picture) {
    if picture.size.width < WIDTH || picture.size.height < 4 * HEIGHT {
        return;
    }
    let top = picture.size.height - HEIGHT;
    fill(picture, (0, top), (WIDTH, HEIGHT), PANEL);
    let left = STEP / 2;
    for x in 0..7 * STEP {
        fill(picture, (left + x, top + 4), (1, 12), viridis(f64::from(x) / f64::from(7 * STEP - 1)));
    }
    for (label, x) in DECADES.iter().zip((left..).step_by(STEP as usize)) {
        fill(picture, (x, top + 14), (1, 4), TEXT);
        // Centred on its tick.
        let half = u32::try_from(label.len()).expect("a label is short") * 4;
        text(picture, (x - half, top + 20), label);
    }
    text(picture, (left + 7 * STEP + 22, top + 20), "ULP");
    fill(picture, (left, top + 34), (10, 10), WRONG);
    text(picture, (left + 14, top + 35), "wrong answer");
    fill(picture, (left + 128, top + 34), (10, 10), BACKGROUND);
    text(picture, (left + 142, top + 35), "miss");
}

/// Draws what the colours of stages stand for.
pub(crate) fn draw_stages(picture: &mut Picture) {
    if picture.size.width < WIDTH || picture.size.height < 4 * HEIGHT {
        return;
    }
    let top = picture.size.height - HEIGHT / 2;
    fill(picture, (0, top), (WIDTH, HEIGHT / 2), PANEL);
    let labels = ["f32", "double width", "exact"];
    for ((color, label), x) in STAGES.into_iter().zip(labels).zip([8, 88, 232]) {
        fill(picture, (x, top + 7), (10, 10), color);
        text(picture, (x + 14, top + 8), label);
    }
}

fn fill(picture: &mut Picture, (x, y): (u32, u32), (width, height): (u32, u32), color: Rgb) {
    for row in y..y + height {
        for column in x..x + width {
            picture.set(column, row, color);
        }
    }
}

/// Text in cells of 8 x 8 pixels, from its upper left corner.
fn text(picture: &mut Picture, (x, y): (u32, u32), text: &str) {
    for (c, x) in text.chars().zip((x..).step_by(8)) {
        for (row, y) in BASIC_FONTS.get(c).unwrap_or_default().into_iter().zip(y..) {
            for bit in (0..8).filter(|bit| row >> bit & 1 == 1) {
                picture.set(x + bit, y, TEXT);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "a test")]

    use super::*;

    #[test]
    fn small_pictures_are_left_alone_and_large_ones_are_labelled() {
        for (width, height, drawn) in [(WIDTH - 1, 600, false), (800, 4 * HEIGHT - 1, false), (WIDTH, 4 * HEIGHT, true)]
        {
            let mut picture = Picture::new(crate::parse::Size { width, height }).unwrap();
            picture.push((0..width * height).map(|_| [1, 2, 3]));
            draw(&mut picture);
            assert_eq!(picture.count(TEXT) > 200, drawn, "{width}x{height}");
            let outside = u64::from(width * height - WIDTH * HEIGHT * u32::from(drawn));
            assert_eq!(picture.count([1, 2, 3]), outside);
        }
    }
}
