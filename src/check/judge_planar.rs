//! Answers the criteria of planar experiments.

use super::judge::Answer;
use super::{Criterion, CriterionKind, CriterionSpec, PlanarSettings};
use crate::planar::{Case, Method, Movement, PlanarOutcome};

/// Answers `specs` for `outcome`, in their order. A question about an arm has no answer here.
#[must_use]
pub fn judge_planar(outcome: &PlanarOutcome, specs: &[CriterionSpec]) -> Vec<Criterion> {
    specs.iter().map(|spec| answer(outcome, &spec.kind).criterion(spec, false)).collect()
}

fn answer(outcome: &PlanarOutcome, kind: &CriterionKind) -> Answer {
    match kind {
        CriterionKind::PlanarClearance { method, settings, min_m } => {
            let clearances = movements(outcome, *method, *settings).map(|movement| movement.clearance_m);
            Answer::at_least(clearances.reduce(f64::min).unwrap_or(f64::NAN), *min_m, "m")
        }
        CriterionKind::PlanarCollides { method, settings } => {
            let collides = |case: &&Case| case.of(*method).any(|movement| movement.collides);
            let known = movements(outcome, *method, *settings).next().is_some();
            let count = outcome.cases.iter().filter(|case| asked(case, *settings)).filter(collides).count();
            Answer::at_least(if known { count as f64 } else { f64::NAN }, 1.0, "settings")
        }
        _ => Answer::at_least(f64::NAN, 0.0, "m"),
    }
}

fn movements(outcome: &PlanarOutcome, method: Method, settings: PlanarSettings) -> impl Iterator<Item = &Movement> {
    outcome.cases.iter().filter(move |case| asked(case, settings)).flat_map(move |case| case.of(method))
}

fn asked(case: &Case, settings: PlanarSettings) -> bool {
    match settings {
        PlanarSettings::All => true,
        PlanarSettings::Taught => case.taught,
        PlanarSettings::New => !case.taught && case.extrapolation <= 0.0,
        PlanarSettings::Beyond => !case.taught && case.extrapolation > 0.0,
    }
}
