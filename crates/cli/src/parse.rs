//! What is typed on the command line: the size of a picture, `1024x768`, and an origin, `1,2,3`.

use std::path::PathBuf;

use clap::builder::{OsStringValueParser, TypedValueParser};
use rayproof::files::Origin;

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

/// The name of an input, whatever it is: an empty one (a script's unset variable) is a bad input, not a bad command line.
pub(crate) fn input() -> impl TypedValueParser<Value = PathBuf> {
    OsStringValueParser::new().map(PathBuf::from)
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

/// `auto`, or three finite numbers `X,Y,Z`.
pub(crate) fn origin(text: &str) -> Result<Origin, String> {
    if text == "auto" {
        return Ok(Origin::Auto);
    }
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|number| number.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    let numbers = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
    numbers.map(Origin::At).ok_or_else(|| "give X,Y,Z, for example 500000,4649776,0, or auto".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origins_are_three_numbers() {
        assert_eq!(origin("auto"), Ok(Origin::Auto));
        assert_eq!(origin("500000, -4649776.5,1e3"), Ok(Origin::At([500_000.0, -4_649_776.5, 1000.0])));
        for bad in ["", "1,2", "1,2,3,4", "1,2,inf", "Auto", "1;2;3"] {
            assert!(origin(bad).is_err(), "{bad:?}");
        }
    }

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
