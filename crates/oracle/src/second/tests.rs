use super::*;
use crate::families;

const SEED: u64 = 20_261_125;

#[test]
fn both_oracles_agree_on_all_families() {
    let mut all = Agreement::default();
    for family in families::all() {
        let mut own = Agreement::default();
        for case in family.cases(SEED, 600) {
            let found = compare(&case.scene, &case.rays);
            own.compared += found.compared;
            own.disagreed += found.disagreed;
            own.beyond += found.beyond;
            own.first = own.first.or(found.first);
        }
        println!("family {:>2}: {} compared, {} beyond", family.number, own.compared, own.beyond);
        assert_eq!(own.disagreed, 0, "family {}:\n{}", family.number, own.first.unwrap_or_default());
        assert!(own.compared > 0, "family {}: nothing was compared", family.number);
        all.compared += own.compared;
        all.beyond += own.beyond;
    }
    println!("{} rays compared, {} beyond the range of expansions", all.compared, all.beyond);
    assert!(all.beyond * 20 < all.compared, "{} of {} are beyond", all.beyond, all.compared);
}

#[test]
fn a_damaged_answer_is_a_disagreement() {
    let case = &families::all()[20].cases(SEED, 64)[0];
    let (first, second) = (Oracle::new(&case.scene), SecondOracle::new(&case.scene));
    for ray in &case.rays {
        let exact = first.closest(ray).expect("is aimed at a vertex").to_hit();
        let (count, answer) = (first.count(ray), second.answer(ray).expect("within range"));
        let judged = |hit: Hit, count: u32| judge(ray, hit, count, Some(answer));
        assert_eq!((judged(exact, count).disagreed, judged(exact, count).compared), (0, 1));
        let damaged = [
            Hit { t: exact.t.next_up(), ..exact },
            Hit { u: exact.u + 1e-7, ..exact },
            Hit { v: exact.v + 1e-7, ..exact },
            Hit { primitive: exact.primitive + 1, ..exact },
            Hit::MISS,
        ];
        for hit in damaged {
            let found = judged(hit, count);
            assert!(found.disagreed == 1 && found.first.is_some(), "{hit:?}");
        }
        assert_eq!(judged(exact, count + 1).disagreed, 1);
    }
}
