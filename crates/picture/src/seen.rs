//! Whether colours that mean different things look different, to eyes that see fewer colours too.

use crate::color::{BACKGROUND, Rgb, STAGES, WRONG, viridis};
use crate::shade::Verdict;

/// What linear red, green and blue look like, to all cones and without one kind of them: Machado, Oliveira and Fernandes,
/// "A Physiologically-based Model for Simulation of Color Vision Deficiency", 2009, severity 1.
const EYES: [(&str, [[f64; 3]; 3]); 4] = [
    ("trichromat", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    (
        "protanope",
        [[0.152_286, 1.052_583, -0.204_868], [0.114_503, 0.786_281, 0.099_216], [-0.003_882, -0.048_116, 1.051_998]],
    ),
    (
        "deuteranope",
        [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_820, 0.042_940, 0.968_881]],
    ),
    (
        "tritanope",
        [[1.255_528, -0.076_749, -0.178_779], [-0.078_411, 0.930_809, 0.147_602], [0.004_733, 0.691_367, 0.303_900]],
    ),
];

/// Colours this far apart in CIELAB are told apart without looking twice; a difference of 2.3 is just noticeable.
const APART: f64 = 15.0;

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum())
}

/// A colour of sRGB in CIELAB, as an eye sees it.
fn lab(color: Rgb, eye: &[[f64; 3]; 3]) -> [f64; 3] {
    const XYZ: [[f64; 3]; 3] = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
    let linear = color.map(|c| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    });
    let [x, y, z] = times(&XYZ, times(eye, linear).map(|c| c.clamp(0.0, 1.0)));
    let f = |t: f64| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    let [x, y, z] = [f(x / 0.95047), f(y), f(z / 1.08883)];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Asserts that all of these are apart from each other.
fn check(what: &str, colors: &[Rgb]) {
    for (eye, matrix) in &EYES {
        let seen: Vec<[f64; 3]> = colors.iter().map(|&color| lab(color, matrix)).collect();
        for (i, a) in seen.iter().enumerate() {
            for (j, b) in seen[..i].iter().enumerate() {
                let distance = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                let [a, b] = [colors[i], colors[j]];
                assert!(distance > APART, "{what}: {a:?} and {b:?} are {distance:.1} apart to a {eye}");
            }
        }
    }
}

#[test]
fn verdicts_and_stages_can_be_told_apart() {
    check("verdicts", &Verdict::ALL.map(Verdict::color));
    check("stages", &STAGES);
}

#[test]
fn wrong_answers_and_misses_are_no_errors() {
    for step in 0..=70 {
        check("errors", &[WRONG, BACKGROUND, viridis(f64::from(step) / 70.0)]);
    }
}
