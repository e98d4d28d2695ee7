//! The 42 families, each precision on each device.

use rayproof::Precision;
use rayproof::scene::{FlatHit, Undecided};
use rayproof_oracle::families;

use super::case::{Asked, errors};
use super::subject::{Subject, Walk};
use super::tally::Tally;
use super::{Error, Run, plan::Progress};
use crate::model::{Decided, Family, FamilyRow};

pub(crate) fn measure(run: &mut Run<'_>, progress: &mut dyn Progress) -> Result<Vec<Family>, Error> {
    progress.stage("families", families::all().len());
    let mut all = Vec::new();
    for family in families::all() {
        all.push(one(run, family)?);
        progress.step();
    }
    Ok(all)
}

fn one(run: &mut Run<'_>, family: &families::Family) -> Result<Family, Error> {
    let cases = family.cases(run.plan.seed, run.plan.family);
    let asked: Vec<Asked> = cases.into_iter().map(|case| run.ask(case.scene, case.rays)).collect();
    let mut undecided = Undecided::default();
    let mut rows = Vec::new();
    let mut first_hits: Vec<(Precision, Vec<Vec<FlatHit>>)> = Vec::new();
    for subject in run.bench.subjects.clone() {
        let hits = answers(run, subject, &asked, &mut undecided)?;
        let mut tally = Tally::default();
        for (i, (asked, hits)) in asked.iter().zip(&hits).enumerate() {
            tally.add(i, &asked.scene, &asked.rays, &asked.truth, hits);
        }
        let same_bits = first_hits
            .iter()
            .find(|(precision, _)| *precision == subject.precision)
            .map(|(_, first)| first.iter().flatten().zip(hits.iter().flatten()).all(|(a, b)| a.same_bits(b)));
        let errors = errors(&run.bench, subject, &asked, tally)?;
        rows.push(FamilyRow { precision: subject.id(), device: subject.device, errors, same_bits });
        if subject.device == 0 {
            first_hits.push((subject.precision, hits));
        }
    }
    let rays = asked.iter().map(|a| a.rays.len() as u64).sum();
    let hits = asked.iter().flat_map(|a| &a.truth).filter(|truth| truth.hit.is_hit()).count() as u64;
    Ok(Family {
        number: family.number,
        name: family.name.to_owned(),
        stresses: family.stresses.to_owned(),
        rays,
        hits,
        decided: decided(rays, undecided),
        rows,
    })
}

/// The answers to each scene's rays; on the first device the precision `exact` also tells what it left open.
fn answers(
    run: &Run<'_>,
    subject: Subject,
    asked: &[Asked],
    undecided: &mut Undecided,
) -> Result<Vec<Vec<FlatHit>>, Error> {
    let mut all = Vec::with_capacity(asked.len());
    for asked in asked {
        let mut hits = vec![FlatHit::MISS; asked.rays.len()];
        let open = run.bench.ready(subject, &asked.scene, Walk::Tree)?.closest(&asked.rays, &mut hits)?;
        if subject.device == 0 {
            *undecided += open;
        }
        all.push(hits);
    }
    Ok(all)
}

/// Each ray by the last stage that had a say.
pub(crate) fn decided(rays: u64, open: Undecided) -> Decided {
    let resolved = open.resolved_on_cpu;
    let refined = open.first_stage.saturating_sub(resolved);
    Decided { rays, first: rays - refined - resolved, refined, resolved }
}
