//! From numbers to colours. Every scale here can be told apart by people who see fewer colours.

use glam::Vec3;

/// Red, green and blue, as stored in the picture.
pub type Rgb = [u8; 3];

/// Where there is nothing: a quiet grey.
pub const BACKGROUND: Rgb = [32, 32, 36];
/// An answer that exact arithmetic contradicts.
pub const WRONG: Rgb = [230, 30, 40];
/// Decided in `f32`, in double width, exactly.
pub const STAGES: [Rgb; 3] = [[38, 60, 96], [240, 160, 40], [230, 30, 40]];

/// A scale from dark violet at 0 over green to yellow at 1.
#[must_use]
pub fn viridis(x: f64) -> Rgb {
    colorous::VIRIDIS.eval_continuous(x.clamp(0.0, 1.0)).into_array()
}

/// A scale from dark blue at 0 to yellow at 1, the same to red-green blind eyes.
#[must_use]
pub fn cividis(x: f64) -> Rgb {
    colorous::CIVIDIS.eval_continuous(x.clamp(0.0, 1.0)).into_array()
}

/// The colour of an error in ULP: from none over 1 to a million and more, logarithmic from 1 on; where an end of each decade
/// lies on the scale, [`DECADES`] tells.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "a colour")]
pub fn of_ulps(ulps: u64) -> Rgb {
    viridis(if ulps == 0 { 0.0 } else { ((ulps as f64).log10() + 1.0) / 7.0 })
}

/// The marks of the scale of errors, evenly spaced: none, 1 ULP, and on to a million.
pub const DECADES: [&str; 8] = ["0", "1", "10", "100", "1k", "10k", "100k", "1M"];

/// The colour of fractions of full light.
#[must_use]
pub fn from_unit(color: Vec3) -> Rgb {
    (color.clamp(Vec3::ZERO, Vec3::ONE) * 255.0).round().to_array().map(byte)
}

/// A colour of its own for a number: its bits are mixed (the finaliser of MurmurHash3), so that neighbours differ.
#[must_use]
pub fn distinct(id: u32) -> Rgb {
    let mut h = id.wrapping_add(0x9e37_79b9);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^= h >> 16;
    // Never darker than the background.
    h.to_le_bytes()[..3].try_into().map_or(BACKGROUND, |rgb: Rgb| rgb.map(|c| 64 + c / 4 * 3))
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "rounded, and clamped to 0..=255 above")]
fn byte(x: f32) -> u8 {
    x as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_primitives_differ_and_stand_out_from_the_background() {
        for id in 0..10_000 {
            let [a, b] = [distinct(id), distinct(id + 1)];
            let apart: u32 = a.iter().zip(b).map(|(x, y)| u32::from(x.abs_diff(y))).sum();
            assert!(apart > 0 && a.iter().zip(BACKGROUND).all(|(&c, back)| c > back), "{id}: {a:?} {b:?}");
        }
    }

    #[test]
    fn fractions_of_light_are_clamped() {
        assert_eq!(from_unit(Vec3::new(-1.0, 0.5, 2.0)), [0, 128, 255]);
        assert_eq!([viridis(-1.0), cividis(2.0)], [viridis(0.0), cividis(1.0)]);
    }

    #[test]
    fn the_scale_of_errors_is_logarithmic_and_ends_at_both_ends() {
        assert_eq!([0, 1, 10, 1_000_000, u64::MAX].map(of_ulps), [0.0, 1.0 / 7.0, 2.0 / 7.0, 1.0, 1.0].map(viridis));
    }
}
