//! The size of a picture on the command line: `1024x768`.

/// The size of a picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl Size {
    pub(crate) fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

/// `WxH`, both whole numbers from 1 to 65535.
pub(crate) fn size(text: &str) -> Result<Size, String> {
    let side = |s: &str| {
        let digits = !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
        s.parse::<u16>().ok().filter(|&n| digits && n > 0).map(u32::from)
    };
    text.split_once('x')
        .and_then(|(w, h)| Some(Size { width: side(w)?, height: side(h)? }))
        .ok_or_else(|| "give WxH, both from 1 to 65535, for example 1024x768".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_strict() {
        assert_eq!(size("800x600"), Ok(Size { width: 800, height: 600 }));
        assert_eq!(size("1x65535"), Ok(Size { width: 1, height: 65535 }));
        for bad in ["", "x", "800", "800x", "x600", "0x600", "800x0", "800X600", " 800x600", "800x600 ", "+8x6", "-8x6"]
        {
            assert!(size(bad).is_err(), "{bad:?}");
        }
        for bad in ["800x600x3", "8e2x600", "800.0x600", "65536x1", "99999999999999999999x1", "800×600"] {
            assert!(size(bad).is_err(), "{bad:?}");
        }
    }
}
