use std::ops::Range;

use rayproof_scene::{Camera, Ray};

/// The rays through the pixels of a picture, row by row from the top left.
#[derive(Clone, Copy, Debug)]
pub struct Primary<'a> {
    /// Where the picture is seen from; a camera without a [`fault`](Camera::fault).
    pub camera: &'a Camera,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl<'a> Primary<'a> {
    /// How many rays there are.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// The rays in blocks of whole rows, of at most `block` rays or one row.
    pub fn blocks(self, block: usize) -> impl Iterator<Item = Vec<Ray>> + use<'a> {
        let Self { camera, width, height } = self;
        row_blocks(width, height, block).map(move |rows| camera.rays(width, height, rows).collect())
    }
}

fn row_blocks(width: u32, height: u32, block: usize) -> impl Iterator<Item = Range<u32>> {
    let rows = (block / width.max(1) as usize).clamp(1, height.max(1) as usize);
    let rows = u32::try_from(rows).expect("no more than the height");
    (0..height).step_by(rows as usize).map(move |y| y..height.min(y.saturating_add(rows)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::BATCH;

    #[test]
    fn row_blocks_cover_every_row_once_and_are_about_a_batch() {
        for (width, height) in [(1, 1), (800, 600), (1024, 1024), (1024, 5000), (65535, 40), (3, 65535)] {
            let mut next = 0;
            for rows in row_blocks(width, height, BATCH) {
                assert_eq!(rows.start, next);
                assert!(!rows.is_empty() && rows.len() as u64 * u64::from(width) <= BATCH as u64);
                next = rows.end;
            }
            assert_eq!(next, height);
        }
    }

    #[test]
    fn a_picture_without_pixels_has_no_rays() {
        for (width, height) in [(0, 0), (0, 3), (3, 0)] {
            assert_eq!(row_blocks(width, height, 2).map(|rows| rows.len()).sum::<usize>() * width as usize, 0);
        }
    }
}
