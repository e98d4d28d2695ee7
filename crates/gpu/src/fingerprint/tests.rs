use super::*;

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
    let faults: [Fault; 9] = [
        (|r| r.sum = r.sum.next_up(), |f| f.sum_wrong),
        (|r| r.sum_error = 0.0, |f| f.sum_error_wrong),
        (|r| r.product = r.product.next_down(), |f| f.product_wrong),
        (|r| r.product_error = 0.0, |f| f.product_error_wrong),
        (|r| r.contracted += 1.0, |f| f.contracted),
        (|r| r.quotient = r.quotient.next_up(), |f| f.quotient_wrong),
        (|r| r.root = r.root.next_up(), |f| f.root_wrong),
        (|r| r.comparisons ^= 4, |f| f.comparisons_wrong),
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
        r.fma_error = x.mul_add(*y, -(x * y));
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
        r.fma_error = x.mul_add(*y, -(x * y));
        if i % 6 == 0 && r.root > 0.0 {
            r.root = r.root.next_down();
        }
    }
    let f = Fingerprint::judge(Route::ExactSpirv, &pairs, &results);
    assert!(f.keeps_errors() && !f.is_ieee(), "{f}");
    let kept = f.sum_wrong + f.product_wrong + f.contracted + f.quotient_wrong + f.subnormals_wrong;
    assert_eq!(kept, 0, "{f}");
    assert!(f.root_wrong > PAIRS / 10 && f.root_ulp == 1, "{f}");
    assert_eq!(f.comparisons_wrong, 35, "as many as there: {f}");
    // The comparisons alone are enough.
    for (r, [x, _]) in results.iter_mut().zip(&pairs) {
        r.root = x.abs().sqrt();
    }
    assert!(!Fingerprint::judge(Route::ExactSpirv, &pairs, &results).is_ieee());
}
