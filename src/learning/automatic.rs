//! What models see of the demonstrations, and the settings that are left to it.

use nalgebra::DVector;

use super::parameters::mean_and_deviations;
use super::phmm::{PhmmSettings, Sequence};
use super::prepare::Prepared;
use super::selection::{Choices, choose};
use super::{FeatureMap, LearningError, LearningSettings, MayGoOn, ShapingKind};
use crate::demonstration::{Dataset, ParameterSource};

/// The features of `theta_m`, linear for the baseline, which is blind to parameters, and the settings that go with them.
pub(super) fn motion_features(
    dataset: &Dataset,
    prepared: &[Prepared],
    settings: &LearningSettings,
    seed: u64,
) -> (FeatureMap, LearningSettings) {
    if settings.shaping == ShapingKind::Lwr {
        return (FeatureMap::Linear, settings.clone());
    }
    let thetas = thetas(prepared, |p| &p.theta_m);
    let factors = scale_factors(dataset, &thetas);
    let features = FeatureMap::scaled(settings.motion.features, &thetas, &factors, seed);
    let motion = PhmmSettings { scale_factors: features.factors(&factors), ..settings.motion.clone() };
    (features, LearningSettings { motion, ..settings.clone() })
}

/// By how many of its own standard deviations a parameter counts as one (p): coordinates of a start or goal share a unit, so one that hardly
/// varies says no more per metre than the others do. Parameters that a person gave have scales of their own (none).
fn scale_factors(dataset: &Dataset, thetas: &[DVector<f64>]) -> Vec<f64> {
    if dataset.parameter_source == ParameterSource::Given {
        return Vec::new();
    }
    let names = dataset.parameters_m();
    let unit = |j: usize| names[j].rsplit('_').next();
    let (_, deviations) = mean_and_deviations(&thetas.iter().collect::<Vec<_>>());
    let spreads: Vec<f64> = deviations.column_iter().map(|column| column.norm()).collect();
    let widest = |j: usize| (0..names.len()).filter(|i| unit(*i) == unit(j)).fold(0.0, |most: f64, i| most.max(spreads[i]));
    (0..names.len()).map(|j| if spreads[j] > 0.0 { widest(j) / spreads[j] } else { 1.0 }).collect()
}

/// The features of `theta_f`.
pub(super) fn force_features(prepared: &[Prepared], settings: &LearningSettings, seed: u64) -> FeatureMap {
    FeatureMap::of(settings.force.features, &thetas(prepared, |p| &p.theta_f), seed)
}

/// A parameter vector of every demonstration.
pub(super) fn thetas(prepared: &[Prepared], of: fn(&Prepared) -> &DVector<f64>) -> Vec<DVector<f64>> {
    prepared.iter().map(|p| of(p).clone()).collect()
}

/// Every demonstration as the motion model sees it.
pub(super) fn seen_motion(prepared: &[Prepared], settings: &LearningSettings, features: &FeatureMap) -> Vec<Sequence> {
    prepared.iter().map(|p| p.motion_sequence(settings).seen_through(features)).collect()
}

/// Every demonstration as the force model sees it.
pub(super) fn seen_force(prepared: &[Prepared], settings: &LearningSettings, features: &FeatureMap) -> Vec<Sequence> {
    prepared.iter().map(|p| p.force_sequence(settings).seen_through(features)).collect()
}

/// The settings with everything filled in that they leave to the data, and how: of the motion model, of the force model.
pub(super) fn filled_in(
    prepared: &[Prepared],
    settings: &LearningSettings,
    features: &FeatureMap,
    seed: u64,
    may_go_on: MayGoOn,
) -> Result<(LearningSettings, [Choices; 2]), LearningError> {
    let mut settings = settings.clone();
    if settings.shaping == ShapingKind::Lwr {
        return Ok((settings, Default::default()));
    }
    let sequences = seen_motion(prepared, &settings, features);
    let (motion, motion_choices) = choose(&sequences, &settings.motion, settings.motion_selection, seed, may_go_on)?;
    let mut force_choices = Choices::default();
    if prepared.iter().all(|p| p.wrench.ncols() > 0) {
        let sequences = seen_force(prepared, &settings, &force_features(prepared, &settings, seed));
        (settings.force, force_choices) = choose(&sequences, &settings.force, settings.force_selection, seed, may_go_on)?;
    }
    settings.motion = motion;
    Ok((settings, [motion_choices, force_choices]))
}
