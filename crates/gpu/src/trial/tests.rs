use super::*;

/// What numbers of 100 bits and more would answer.
fn right() -> Vec<Results> {
    let words = |mut x: i128| {
        [(); 5].map(|()| {
            #[expect(clippy::cast_precision_loss, reason = "the next 24 bits")]
            let word = x as f32;
            #[expect(clippy::cast_possible_truncation, reason = "whole")]
            let rest = x - word as i128;
            x = rest;
            word
        })
    };
    #[expect(clippy::cast_possible_truncation, reason = "each the next 24 bits")]
    let float = |x: f64| {
        let a = x as f32;
        let b = (x - f64::from(a)) as f32;
        [a, b, (x - f64::from(a) - f64::from(b)) as f32, 0.0, 0.0]
    };
    pairs()
        .iter()
        .map(|&[a, b, c, d]| {
            let [x, y] = [[a, b], [c, d]].map(|[high, low]| i128::from(high) << 24 | i128::from(low));
            Results {
                conversion: words(x),
                sum: words(x + y),
                difference: words(x - y),
                product: words(x * y),
                quotient: float(x as f64 / y as f64),
                root: float((x as f64).sqrt()),
                order: words((x - y).abs()),
                size: words((x - y).abs()),
            }
        })
        .collect()
}

#[test]
fn what_is_off_by_more_than_promised_is_named() {
    for width in [Width::Double, Width::PairOfF32, Width::PairOfF64] {
        assert_eq!(judge(width, &right()), Verdict::Kept, "{width:?}");
        let off = 2.0_f32.powi(3 - i32::try_from(promise(width)).expect("small"));
        type Damage = fn(&mut Results, f32);
        let damages: [(&str, Damage); 8] = [
            ("conversion", |r, _| r.conversion[1] += 1.0),
            ("sum", |r, off| r.sum[2] += (r.sum[0] * off).ceil()),
            ("difference", |r, off| r.difference[2] += (r.difference[0].abs() * off).ceil()),
            ("product", |r, off| r.product[4] += r.product[0] * off),
            ("quotient", |r, off| r.quotient[1] += r.quotient[0] * (off + 2.0_f32.powi(-48))),
            ("square root", |r, off| r.root[1] += r.root[0] * (off + 2.0_f32.powi(-48))),
            ("minimum", |r, _| r.order[0] = -r.order[0]),
            ("comparison", |r, _| r.size[0] = -r.size[0]),
        ];
        for (name, damage) in damages {
            let mut results = right();
            damage(&mut results[77], off);
            let Verdict::Broken { operation, wrong: 1, .. } = judge(width, &results) else {
                panic!("{width:?}: a wrong {name} passes")
            };
            assert!(operation.starts_with(name), "{width:?}: {operation} instead of {name}");
        }
    }
}

/// What Mesa 25 gave in `f64` before numbers were rounded to 24 bits by arithmetic: `x - f64(f32(x))` is 0.
#[test]
fn a_conversion_that_is_folded_away_is_named() {
    let mut results = right();
    for r in &mut results {
        for words in [&mut r.conversion, &mut r.sum, &mut r.product] {
            words[1..].fill(0.0);
        }
    }
    let verdict = judge(Width::Double, &results);
    assert!(verdict.to_string().starts_with("conversion to f32 and back wrong in 40"), "{verdict}");
}
