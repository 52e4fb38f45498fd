//! What a report says of a planar experiment, besides its comparison.

use twox_hash::XxHash3_64;

use super::LearningSection;
use super::sections::fit_status;
use crate::planar::{ModelReport, PlanarOutcome};

/// How a model was learned.
pub(super) fn learning(model: &ModelReport) -> LearningSection {
    LearningSection {
        log_likelihood: model.log_likelihood.iter().map(|value| value.is_finite().then_some(*value)).collect(),
        states: model.states,
        starts: model.starts,
        status: model.status.map_or("least_squares", fit_status),
        warnings: model.warnings.clone(),
    }
}

/// What the other models warn of, each with its method.
pub(super) fn warnings(outcome: &PlanarOutcome) -> Vec<String> {
    let of = |model: &ModelReport| model.warnings.iter().map(|warning| format!("{}: {warning}", model.method.title())).collect::<Vec<_>>();
    outcome.models.iter().skip(1).flat_map(of).collect()
}

/// Hash over the bits of every path, forcing term and likelihood: equal hashes mean equal runs.
pub(super) fn hash(outcome: &PlanarOutcome) -> u64 {
    let shown = outcome.demonstrations.iter().flat_map(|shown| &shown.path_m).flatten();
    let moved = outcome.cases.iter().flat_map(|case| &case.movements).flat_map(|movement| &movement.path_m).flatten();
    let forcing = outcome.forcing.iter().flat_map(|curve| curve.phase.iter().chain(curve.forcing_m.iter().flatten()));
    let fits = outcome.models.iter().flat_map(|model| &model.log_likelihood);
    let bytes: Vec<u8> = shown.chain(moved).chain(forcing).chain(fits).flat_map(|number| number.to_bits().to_le_bytes()).collect();
    XxHash3_64::oneshot(&bytes)
}
