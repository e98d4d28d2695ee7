//! A picture in memory, and the file it becomes.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder as _};
use rayproof_picture::color::Rgb;

use crate::exit::{Code, Failure};
use crate::parse::Size;
use crate::target;

/// Pixels, row by row from the top left.
pub(crate) struct Picture {
    pub(crate) size: Size,
    pixels: Vec<Rgb>,
}

impl Picture {
    /// A picture without rows yet; [`push`](Self::push) them.
    pub(crate) fn new(size: Size) -> Result<Self, Failure> {
        let mut pixels = Vec::new();
        let room = usize::try_from(size.pixels()).ok().and_then(|n| pixels.try_reserve_exact(n).ok());
        let Size { width, height } = size;
        room.ok_or_else(|| {
            Failure::new(Code::Running, format!("a picture of {width}x{height} does not fit in memory"))
        })?;
        Ok(Self { size, pixels })
    }

    /// Appends pixels.
    pub(crate) fn push(&mut self, pixels: impl IntoIterator<Item = Rgb>) {
        self.pixels.extend(pixels);
    }

    /// Colours one pixel; nothing happens outside the picture.
    pub(crate) fn set(&mut self, x: u32, y: u32, color: Rgb) {
        if x < self.size.width && y < self.size.height {
            self.pixels[y as usize * self.size.width as usize + x as usize] = color;
        }
    }

    /// How many pixels have a colour.
    #[cfg(test)]
    pub(crate) fn count(&self, color: Rgb) -> u64 {
        self.pixels.iter().filter(|&&pixel| pixel == color).count() as u64
    }

    /// Writes a PNG, by way of a temporary file beside it; `-` is stdout.
    pub(crate) fn save(&self, path: &Path) -> Result<(), Failure> {
        let failed = |e: io::Error| Failure::new(Code::Running, format!("{}: {e}", path.display()));
        if path.as_os_str() == "-" {
            let mut out = io::stdout().lock();
            return self.encode(&mut out).and_then(|()| out.flush()).map_err(failed);
        }
        // A device or a pipe cannot be renamed onto.
        if fs::metadata(path).is_ok_and(|file| !file.is_file() && !file.is_dir()) {
            let file = fs::File::create(path).map_err(failed)?;
            return self.encode(&file).map_err(failed);
        }
        target::replace(path, |file| self.encode(file)).map_err(failed)
    }

    fn encode(&self, out: impl Write) -> io::Result<()> {
        let mut out = BufWriter::new(out);
        let Size { width, height } = self.size;
        PngEncoder::new(&mut out)
            .write_image(self.pixels.as_flattened(), width, height, ExtendedColorType::Rgb8)
            .map_err(io::Error::other)?;
        out.flush()
    }
}
