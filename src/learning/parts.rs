//! The parts of a skill that follow from prepared demonstrations without a search: ends, orientation, gripper, noise.

use nalgebra::DVector;

use super::automatic::{motion_features, thetas};
use super::cpdmp::{MotionModel, Shaping};
use super::ends::{EndRule, Ends, EndsReport, ends};
use super::orientation::OrientationSample;
use super::prepare::Prepared;
use super::{GripperProfile, LearningError, LearningSettings, OrientationProfile, ParameterSpace, Preparation, ShapingKind};
use crate::demonstration::Dataset;

pub(super) fn motion_model(
    dataset: &Dataset,
    prepared: &[Prepared],
    settings: &LearningSettings,
    shaping: Shaping,
    seed: u64,
) -> Result<(MotionModel, Option<EndsReport>), LearningError> {
    let features = motion_features(prepared, settings, seed);
    let parameters = ParameterSpace::of(dataset.parameters_m(), &thetas(prepared, |p| &p.theta_m)).with_features(features);
    let given = if settings.shaping == ShapingKind::Lwr { settings.lwr_ends } else { EndRule::Regression };
    let Ends { start, goal, report } = ends(dataset, prepared, &parameters, given)?;
    let model = MotionModel {
        stiffness: settings.stiffness,
        duration_s: prepared.iter().map(|p| p.duration_s).sum::<f64>() / prepared.len() as f64,
        alpha: settings.alpha,
        phase_input: settings.phase_input,
        gate_start: settings.gate_start,
        columns: dataset.motion.clone(),
        start,
        goal,
        parameters,
        shaping,
        evidence: Vec::new(),
    };
    Ok((model, report))
}

pub(super) fn orientation_profile(prepared: &[Prepared], settings: &LearningSettings) -> Option<OrientationProfile> {
    let (nothing, blind) = (DVector::zeros(0), settings.shaping == ShapingKind::Lwr);
    let samples = prepared.iter().map(|p| {
        let theta = if blind { &nothing } else { &p.theta_m };
        Some(OrientationSample { fractions: &p.fractions, orientations: p.trajectory.orientations()?, theta })
    });
    let samples = samples.collect::<Option<Vec<_>>>()?;
    let profile = OrientationProfile::fit(&samples, settings.orientation_basis, settings.motion.ridge);
    Some(if blind { profile.blind_to(prepared[0].theta_m.len()) } else { profile })
}

pub(super) fn gripper_profile(prepared: &[Prepared], warnings: &mut Vec<String>) -> Option<GripperProfile> {
    let openings = prepared.iter().map(|p| Some(p.trajectory.gripper()?.iter().copied().collect()));
    let (profile, warning) = GripperProfile::fit(&openings.collect::<Option<Vec<Vec<f64>>>>()?);
    warnings.extend(warning);
    Some(profile)
}

pub(super) fn preparation(prepared: &[Prepared], settings: &LearningSettings) -> Preparation {
    let windows = prepared.iter().map(|p| p.window_s);
    let window_s = [windows.clone().fold(f64::INFINITY, f64::min), windows.fold(0.0, f64::max)];
    Preparation { rate_hz: settings.rate_hz, window_s, degree: settings.smoothing_degree }
}

/// Mean estimated variance of sensor noise in the forcing term, per column.
pub(super) fn forcing_noise(prepared: &[Prepared]) -> DVector<f64> {
    prepared.iter().map(|p| &p.noise).sum::<DVector<f64>>() / prepared.len() as f64
}
