//! From numbers to colours. Every scale here can be told apart by people who see fewer colours.

use glam::Vec3;

/// Red, green and blue, as stored in the picture.
pub(crate) type Rgb = [u8; 3];

/// Where there is nothing: a quiet grey.
pub(crate) const BACKGROUND: Rgb = [32, 32, 36];
/// An answer that exact arithmetic contradicts.
pub(crate) const WRONG: Rgb = [230, 30, 40];
/// Decided in `f32`, in double width, exactly.
pub(crate) const TIERS: [Rgb; 3] = [[38, 60, 96], [240, 160, 40], [230, 30, 40]];

/// A scale from dark violet at 0 over green to yellow at 1.
pub(crate) fn viridis(x: f64) -> Rgb {
    colorous::VIRIDIS.eval_continuous(x.clamp(0.0, 1.0)).into_array()
}

/// A scale from dark blue at 0 to yellow at 1, the same to red-green blind eyes.
pub(crate) fn cividis(x: f64) -> Rgb {
    colorous::CIVIDIS.eval_continuous(x.clamp(0.0, 1.0)).into_array()
}

/// The colour of fractions of full light.
pub(crate) fn from_unit(color: Vec3) -> Rgb {
    (color.clamp(Vec3::ZERO, Vec3::ONE) * 255.0).round().to_array().map(byte)
}

/// A colour of its own for a number: its bits are mixed (the finaliser of MurmurHash3), so that neighbours differ.
pub(crate) fn distinct(id: u32) -> Rgb {
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
}
