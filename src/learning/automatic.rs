//! What models see of the demonstrations, and the settings that are left to it.

use nalgebra::DVector;

use super::phmm::Sequence;
use super::prepare::Prepared;
use super::selection::{Choices, choose};
use super::{FeatureMap, LearningError, LearningSettings, MayGoOn, ShapingKind};

/// The features of `theta_m`, linear for the baseline, which is blind to parameters.
pub(super) fn motion_features(prepared: &[Prepared], settings: &LearningSettings, seed: u64) -> FeatureMap {
    if settings.shaping == ShapingKind::Lwr {
        return FeatureMap::Linear;
    }
    FeatureMap::of(settings.motion.features, &thetas(prepared, |p| &p.theta_m), seed)
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
    seed: u64,
    may_go_on: MayGoOn,
) -> Result<(LearningSettings, [Choices; 2]), LearningError> {
    let mut settings = settings.clone();
    if settings.shaping == ShapingKind::Lwr {
        return Ok((settings, Default::default()));
    }
    let sequences = seen_motion(prepared, &settings, &motion_features(prepared, &settings, seed));
    let (motion, motion_choices) = choose(&sequences, &settings.motion, settings.motion_selection, seed, may_go_on)?;
    let mut force_choices = Choices::default();
    if prepared.iter().all(|p| p.wrench.ncols() > 0) {
        let sequences = seen_force(prepared, &settings, &force_features(prepared, &settings, seed));
        (settings.force, force_choices) = choose(&sequences, &settings.force, settings.force_selection, seed, may_go_on)?;
    }
    settings.motion = motion;
    Ok((settings, [motion_choices, force_choices]))
}
