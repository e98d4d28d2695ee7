//! Comparison bit by bit.

use rayproof_scene::FlatHit;

use crate::judge::{compare_bits, ulp_distance};

#[test]
fn ulps_are_counted_across_zero() {
    assert_eq!(ulp_distance(1.0, 1.0_f32.next_up()), 1);
    assert_eq!(ulp_distance(0.0, -0.0), 0);
    assert_eq!(ulp_distance(f32::from_bits(1), -f32::from_bits(1)), 2);
    assert_eq!(ulp_distance(f32::MAX, f32::INFINITY), 1);
    assert_eq!(ulp_distance(f32::NEG_INFINITY, f32::INFINITY), 2 * 0x7f80_0000);
    assert_eq!(ulp_distance(f32::NAN, f32::NAN), u64::MAX);
}

#[test]
fn every_bit_is_compared() {
    let good = vec![
        FlatHit { t: 1.0, u: 0.25, v: 0.5, primitive: 7 },
        FlatHit::MISS,
        FlatHit { t: 2.0, u: 0.0, v: 0.0, primitive: 0 },
    ];
    let same = compare_bits(&good, &good.clone());
    assert_eq!((same.compared, same.hits, same.different), (3, 2, 0));
    assert!(same.agrees(2) && !same.agrees(3));

    let damaged = |i: usize, hit: FlatHit| {
        let mut rows = good.clone();
        rows[i] = hit;
        compare_bits(&good, &rows)
    };
    for (i, hit) in [
        (0, FlatHit { t: 1.0_f32.next_up(), ..good[0] }),
        (0, FlatHit { u: 0.5, v: 0.25, ..good[0] }),
        (0, FlatHit { primitive: 8, ..good[0] }),
        (0, FlatHit::MISS),
        (1, good[0]),
        (1, FlatHit { t: f32::NAN, ..FlatHit::MISS }),
        (2, FlatHit { u: -0.0, ..good[2] }),
    ] {
        let found = damaged(i, hit);
        let [(row, [a, b])] = found.first[..] else { panic!("{found}") };
        assert!(found.different == 1 && row == i && a.same_bits(&good[i]) && b.same_bits(&hit), "{found}");
        assert!(!found.agrees(0), "{found}");
    }
    assert!(!compare_bits(&good, &good[..2]).agrees(0), "a missing row");
    assert!(!compare_bits(&[], &[]).agrees(1), "nothing was judged");
    let many = compare_bits(&[FlatHit::MISS; 20], &[good[0]; 20]);
    assert_eq!((many.different, many.first.len()), (20, 8));
    let shown = damaged(0, FlatHit { t: 1.0_f32.next_up(), ..good[0] }).to_string();
    assert!(shown.contains("0x3f800000 1.0 against 0x3f800001 1.0000001, 1 ULP"), "{shown}");
}
