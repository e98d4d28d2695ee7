//! The words of the command line that are more than a number: `1024x768`, `3/8`.

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

/// One of `of` contiguous shares of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    pub(crate) index: u64,
    pub(crate) of: u64,
}

impl Shard {
    pub(crate) const WHOLE: Self = Self { index: 0, of: 1 };

    /// The rows of this share of `total`: the shares of one `of` join without a gap and differ by at most one row.
    pub(crate) fn rows(self, total: u64) -> std::ops::Range<u64> {
        share(self.index, self.of, total)..share(self.index + 1, self.of, total)
    }
}

/// `i * total / of` without overflow, rounded down.
pub(crate) fn share(i: u64, of: u64, total: u64) -> u64 {
    let exact = u128::from(i) * u128::from(total) / u128::from(of);
    u64::try_from(exact).unwrap_or(u64::MAX)
}

/// `I/N` with `I` from 0 to `N - 1`.
pub(crate) fn shard(text: &str) -> Result<Shard, String> {
    let number = |s: &str| s.bytes().all(|b| b.is_ascii_digit()).then(|| s.parse::<u64>().ok()).flatten();
    text.split_once('/')
        .and_then(|(i, n)| Some(Shard { index: number(i)?, of: number(n)? }))
        .filter(|s| s.index < s.of)
        .ok_or_else(|| "give I/N with I from 0 to N-1, for example 0/4 for the first of four shares".to_owned())
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

    #[test]
    fn shards_are_strict() {
        assert_eq!(shard("0/1"), Ok(Shard::WHOLE));
        assert_eq!(shard("3/8"), Ok(Shard { index: 3, of: 8 }));
        for bad in ["", "/", "1", "1/1", "8/8", "0/0", "-1/4", "+1/4", "1/4/2", "1/ 4", "a/b", "0x1/4"] {
            assert!(shard(bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn shards_join_without_gap_or_overlap() {
        for (total, of) in [(0, 3), (1, 3), (10, 3), (1_000_003, 7), (5, 9), (u64::MAX, 5)] {
            let mut next = 0;
            for index in 0..of {
                let rows = Shard { index, of }.rows(total);
                assert_eq!(rows.start, next, "share {index} of {of} of {total}");
                assert!((rows.end - rows.start).abs_diff(total / of) <= 1);
                next = rows.end;
            }
            assert_eq!(next, total);
        }
    }
}
