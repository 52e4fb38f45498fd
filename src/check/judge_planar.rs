//! Answers the criteria of planar experiments.

use super::judge::Answer;
use super::{Criterion, CriterionKind, CriterionSpec, PlanarSettings};
use crate::planar::{Case, Guidance, Method, Movement, PlanarOutcome, Side};

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
        CriterionKind::PlanarSidesPassed { method, settings, side_told, min_m } => {
            let guidance = if *side_told { Guidance::WithSide } else { Guidance::WithoutSide };
            let cases = outcome.cases.iter().filter(|case| case.guidance == guidance && asked(case, *settings));
            let sides = cases.flat_map(|case| case.ideals.iter().map(move |ideal| passed(case, *method, ideal.side)));
            Answer::at_least(sides.reduce(f64::min).unwrap_or(f64::NAN), *min_m, "m")
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

/// The largest distance with which a movement of the method passes on that side (m); minus the obstacle's size where none passes there.
fn passed(case: &Case, method: Method, side: Side) -> f64 {
    let there = case.of(method).filter(|movement| movement.side == Some(side)).map(|movement| movement.clearance_m);
    there.reduce(f64::max).unwrap_or_else(|| -case.obstacle.half_axes_m[0])
}

fn asked(case: &Case, settings: PlanarSettings) -> bool {
    match settings {
        PlanarSettings::All => true,
        PlanarSettings::Taught => case.taught,
        PlanarSettings::New => !case.taught && case.extrapolation <= 0.0,
        PlanarSettings::Beyond => !case.taught && case.extrapolation > 0.0,
    }
}
