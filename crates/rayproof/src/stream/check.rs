use rayon::prelude::*;

use super::Sample;

/// Samples between two calls of `progress`.
const CHUNK: usize = 256;

/// What a judge says of an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// It is the exact answer, its `t` off by so many ULP; `None` where an answer has no `t`.
    Exact {
        /// How far `t` is from the exact one, rounded.
        ulps: Option<u64>,
    },
    /// It is not the exact answer, but one that the precision allows.
    WithinPromise,
    /// It is wrong, and why.
    Wrong(String),
}

/// What a check came to: the answers that are exact but for `t`, and the other three, add up to those checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Checked {
    /// How many answers were judged.
    pub checked: u64,
    /// The exact answer, with `t` rounded to the nearest.
    pub correctly_rounded: u64,
    /// How far `t` is off at most among the answers with the exact primitive; `None` where no answer has a `t`.
    pub worst_ulp: Option<u64>,
    /// Not the exact answer, but one that the precision allows.
    pub within_promise: u64,
    /// Wrong.
    pub disagreed: u64,
}

/// Asks a judge about every sample, in parallel. `wrong` hears of each wrong answer and why it is, in the samples' order;
/// `progress`, of how many more are judged.
pub fn check<A: Sync>(
    samples: &[Sample<A>],
    judge: impl Fn(&Sample<A>) -> Judgement + Sync,
    mut wrong: impl FnMut(&Sample<A>, String),
    mut progress: impl FnMut(usize),
) -> Checked {
    let mut checked = Checked::default();
    for chunk in samples.chunks(CHUNK) {
        let judgements: Vec<Judgement> = chunk.par_iter().map(&judge).collect();
        for (sample, judgement) in chunk.iter().zip(judgements) {
            checked.checked += 1;
            match judgement {
                Judgement::Exact { ulps } => {
                    checked.correctly_rounded += u64::from(ulps.unwrap_or(0) == 0);
                    checked.worst_ulp = checked.worst_ulp.max(ulps);
                }
                Judgement::WithinPromise => checked.within_promise += 1,
                Judgement::Wrong(why) => {
                    checked.disagreed += 1;
                    wrong(sample, why);
                }
            }
        }
        progress(chunk.len());
    }
    checked
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use rayproof_scene::Ray;

    use super::*;

    #[test]
    fn every_sample_is_judged_once_and_the_wrong_ones_are_told_in_order() {
        let ray = Ray::new(Vec3::ZERO, Vec3::X);
        let samples: Vec<Sample<u64>> = (0..1000).map(|i| Sample { index: i * 3, ray, answer: i % 5 }).collect();
        let judge = |sample: &Sample<u64>| match sample.answer {
            0 => Judgement::Exact { ulps: Some(0) },
            1 => Judgement::Exact { ulps: Some(sample.index) },
            2 => Judgement::Exact { ulps: None },
            3 => Judgement::WithinPromise,
            _ => Judgement::Wrong(format!("{} is wrong", sample.index)),
        };
        let (mut told, mut done) = (Vec::new(), 0);
        let checked = check(&samples, judge, |sample, why| told.push((sample.index, why)), |more| done += more);
        let want = Checked {
            checked: 1000,
            correctly_rounded: 400,
            worst_ulp: Some(996 * 3),
            within_promise: 200,
            disagreed: 200,
        };
        assert_eq!((checked, done), (want, 1000));
        let want: Vec<(u64, String)> = (4..1000).step_by(5).map(|i| (i * 3, format!("{} is wrong", i * 3))).collect();
        assert_eq!(told, want);
    }
}
