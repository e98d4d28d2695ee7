use super::*;

/// What a fused `x y - x y` leaves.
#[expect(clippy::disallowed_methods, reason = "a device that fuses is what is told here")]
fn fused_error(x: f32, y: f32) -> f32 {
    x.mul_add(y, -(x * y))
}

/// What a device that follows IEEE and does not fuse would answer.
fn ieee(pairs: &[[f32; 2]]) -> Vec<Results> {
    pairs
        .iter()
        .map(|&[x, y]| Results {
            sum: x + y,
            sum_error: sum_error(x, y),
            product: x * y,
            product_error: product_error(x, y),
            contracted: x * y - (y * x) * 1.000_000_1,
            quotient: x / y,
            root: x.abs().sqrt(),
            fma_error: 0.0,
            comparisons: comparisons(x, y),
            scaled: x * SMALL,
            lifted: x * LARGE,
            moved: x,
            times_one: x,
            plus_zero: x + 0.0,
            #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "the fraction goes")]
            whole: ((x * 4096.0) as i32) as f32,
            #[expect(clippy::cast_precision_loss, reason = "23 bits")]
            fraction: (x.to_bits() & 0x007f_ffff) as f32,
            absolute: x.abs(),
            least: x.min(y),
            most: x.max(y),
            selected: if x < y { y } else { x },
            packed: x * y + y,
        })
        .collect()
}

#[test]
fn a_faithful_device_passes_and_each_fault_is_seen() {
    let pairs = pairs();
    assert_eq!(pairs.len(), PAIRS);
    let right = Fingerprint::judge(Route::ExactSpirv, &pairs, &ieee(&pairs));
    assert!(right.is_ieee() && right.keeps_errors() && right.fused == 0, "{right}");
    assert!(right.subnormals > 400, "{} subnormal results", right.subnormals);
    type Fault = (fn(&mut Results), fn(&Fingerprint) -> usize);
    let faults: [Fault; 20] = [
        (|r| r.sum = r.sum.next_up(), |f| f.sum_wrong),
        (|r| r.sum_error = 0.0, |f| f.sum_error_wrong),
        (|r| r.product = r.product.next_down(), |f| f.product_wrong),
        (|r| r.product_error = 0.0, |f| f.product_error_wrong),
        (|r| r.contracted += 1.0, |f| f.contracted),
        (|r| r.quotient = r.quotient.next_up(), |f| f.quotient_wrong),
        (|r| r.root = r.root.next_up(), |f| f.root_wrong),
        (|r| r.comparisons ^= 4, |f| f.comparisons_wrong),
        (|r| r.lifted = if r.lifted.abs() < 1.0 { 0.0 } else { r.lifted }, |f| f.subnormal_operands_wrong),
        (|r| r.moved = if r.moved.is_subnormal() { 0.0 } else { r.moved }, |f| f.subnormal_bits_wrong),
        (|r| r.fraction += 1.0, |f| f.subnormal_bits_wrong),
        (|r| r.comparisons = if r.scaled == 0.0 { 7 } else { r.comparisons }, |f| f.subnormal_comparisons_wrong),
        (|r| r.times_one = 0.0, |f| f.folded),
        (|r| r.plus_zero = r.plus_zero.next_up(), |f| f.folded),
        (|r| r.whole += 1.0, |f| f.folded),
        (|r| r.absolute = -r.absolute, |f| f.folded),
        (|r| r.least = r.most, |f| f.folded),
        (|r| r.selected = r.least, |f| f.folded),
        (|r| r.packed = r.packed.next_up(), |f| f.folded),
        (|r| r.scaled = if r.scaled.is_subnormal() { 0.0 } else { r.scaled }, |f| f.subnormals_wrong),
    ];
    for (i, (damage, count)) in faults.into_iter().enumerate() {
        let mut results = ieee(&pairs);
        results.iter_mut().for_each(damage);
        let f = Fingerprint::judge(Route::ExactSpirv, &pairs, &results);
        assert!(count(&f) > 100, "fault {i}: {f}");
        assert!(!(f.is_ieee() && f.keeps_errors()), "fault {i}");
    }
}

#[test]
fn a_fused_device_is_told() {
    let pairs = pairs();
    let mut results = ieee(&pairs);
    for (r, [x, y]) in results.iter_mut().zip(&pairs) {
        r.fma_error = fused_error(*x, *y);
    }
    assert!(Fingerprint::judge(Route::ExactSpirv, &pairs, &results).fused > PAIRS / 2);
}

/// What an NVIDIA H200 gave through SPIR-V with `NoContraction` (driver 580.159): sums, products and quotients to the bit, down to
/// subnormals; but square roots up to 1 ULP off, a subnormal compared as if it were zero, and a fused `fma`.
#[test]
fn a_device_that_keeps_subnormals_but_compares_them_as_zero_is_not_ieee() {
    let pairs = pairs();
    let as_compared = |x: f32| if x.is_subnormal() { 0.0 } else { x };
    let mut results = ieee(&pairs);
    for (i, (r, [x, y])) in results.iter_mut().zip(&pairs).enumerate() {
        r.comparisons = comparisons(as_compared(*x), as_compared(*y));
        r.fma_error = fused_error(*x, *y);
        if i % 6 == 0 && r.root > 0.0 {
            r.root = r.root.next_down();
        }
    }
    let f = Fingerprint::judge(Route::ExactSpirv, &pairs, &results);
    assert!(f.keeps_errors() && !f.is_ieee(), "{f}");
    let kept = f.sum_wrong + f.product_wrong + f.contracted + f.quotient_wrong + f.subnormals_wrong + f.folded;
    assert_eq!(kept, 0, "{f}");
    assert!(f.root_wrong > PAIRS / 10 && f.root_ulp == 1, "{f}");
    assert_eq!((f.comparisons_wrong, f.subnormal_comparisons_wrong), (0, 35), "as many as there: {f}");
    assert_eq!(f.arithmetic(), Arithmetic::NotIeee, "{f}");
    assert!(f.rounds_to_nearest() && !f.keeps_subnormals(), "{f}");
    // The comparisons alone are enough not to be IEEE.
    for (r, [x, _]) in results.iter_mut().zip(&pairs) {
        r.root = x.abs().sqrt();
    }
    let f = Fingerprint::judge(Route::ExactSpirv, &pairs, &results);
    assert_eq!(f.arithmetic(), Arithmetic::IeeeButForSubnormals, "{f}");
}

/// What SwiftShader gives: all is IEEE's but subnormals, which are 0 as operands, as results, and compared; their bits pass.
#[test]
fn a_device_that_flushes_subnormals_is_ieee_but_for_them() {
    let pairs = pairs();
    let flushed = |x: f32| if x.is_subnormal() { 0.0 } else { x };
    let mut results = ieee(&pairs.iter().map(|pair| pair.map(flushed)).collect::<Vec<_>>());
    for (r, right) in results.iter_mut().zip(ieee(&pairs)) {
        (r.product, r.scaled) = (flushed(r.product), flushed(r.scaled));
        (r.moved, r.fraction) = (right.moved, right.fraction);
    }
    let f = Fingerprint::judge(Route::ExactSpirv, &pairs, &results);
    assert_eq!(f.arithmetic(), Arithmetic::IeeeButForSubnormals, "{f}");
    assert_eq!((f.subnormals_wrong, f.subnormal_comparisons_wrong), (626, 35), "as many as there: {f}");
    assert!(f.rounds_to_nearest() && f.keeps_errors() && !f.keeps_subnormals(), "{f}");
}
