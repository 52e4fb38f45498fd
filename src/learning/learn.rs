//! From a dataset to a skill.

use nalgebra::{DMatrix, DVector};

use super::alignment::Alignment;
use super::automatic::{filled_in, force_features, motion_features, seen_force, seen_motion, thetas};
use super::cpdmp::{Compliance, ForceModel, Shaping, spatial_columns, state_spreads};
use super::dmp::Lwr;
use super::parts::{forcing_noise, gripper_profile, motion_model, orientation_profile, preparation};
use super::phmm::{Fit, Phmm, PhmmSettings, Sequence, fit_while, refine};
use super::prepare::{Prepared, prepare};
use super::{FOR_EVER, FeatureMap, LearningError, LearningReport, LearningSettings, MayGoOn, ParameterSpace, ShapingKind, Skill, warnings};
use crate::demonstration::Dataset;

/// A skill and how it came about.
#[derive(Debug, Clone)]
pub struct Learned {
    /// The skill.
    pub skill: Skill,
    /// How it came about.
    pub report: LearningReport,
}

/// Learns a skill from a dataset. The same dataset, settings and seed give the same bits, on any number of threads.
///
/// # Errors
/// When settings are outside their ranges, the dataset is not usable, or there are too few samples.
pub fn learn(dataset: &Dataset, settings: &LearningSettings, seed: u64) -> Result<Learned, LearningError> {
    learn_while(dataset, settings, seed, FOR_EVER)
}

/// Learns as [`learn`] while it may go on, which is asked before every iteration of a model.
///
/// # Errors
/// As [`learn`], and [`LearningError::Stopped`] when it may not go on.
pub fn learn_while(dataset: &Dataset, settings: &LearningSettings, seed: u64, may_go_on: MayGoOn) -> Result<Learned, LearningError> {
    learn_with(dataset, settings, (seed, None), may_go_on)
}

/// Learns a skill whose models start from those of `first`, and from nothing else; their numbers of states are kept. With `tolerance = 0`
/// exactly `max_iterations` iterations are made.
///
/// # Errors
/// As [`learn`], or when `first` has other columns, parameters or phase input, or no model to start from.
pub fn learn_from(dataset: &Dataset, settings: &LearningSettings, seed: u64, first: &Skill) -> Result<Learned, LearningError> {
    first.check()?;
    check_first(dataset, settings, first)?;
    learn_with(dataset, settings, (seed, Some(first)), FOR_EVER)
}

/// Learns from a seed, and from a first skill if there is one.
fn learn_with(
    dataset: &Dataset,
    settings: &LearningSettings,
    from: (u64, Option<&Skill>),
    may_go_on: MayGoOn,
) -> Result<Learned, LearningError> {
    let (seed, first) = from;
    settings.check()?;
    dataset.check()?;
    let aligned = settings.align.then(|| Alignment::of(dataset)).transpose()?;
    let (dataset, alignment_shifts_s) = aligned.as_ref().map_or((dataset, Vec::new()), |a| (&a.dataset, a.shifts_s.clone()));
    let prepared = prepare(dataset, settings)?;
    let (features, settings) = motion_features(dataset, &prepared, settings, seed);
    let (settings, [motion_choices, force_choices]) = match first {
        Some(_) => (settings, Default::default()),
        None => filled_in(&prepared, &settings, &features, seed, may_go_on)?,
    };
    let settings = &settings;
    let mut warnings = warnings::about_data(dataset, &prepared, settings);
    warnings.extend(aligned.as_ref().and_then(|a| a.warning.clone()));
    let (motion, force) = rayon::join(
        || motion_fit(dataset, &prepared, settings, &features, from, may_go_on),
        || force_fit(dataset, &prepared, settings, from, may_go_on),
    );
    let ((shaping, motion_fit, compliance), force) = (motion?, force?);
    let (mut motion, ends) = motion_model(dataset, &prepared, settings, shaping, features)?;
    motion.evidence = motion_fit.as_ref().map(|fit| fit.evidence.clone()).unwrap_or_default();
    let (force, force_fit) = force.map_or((None, None), |(model, fit)| (Some(model), Some(fit)));
    let orientation = orientation_profile(&prepared, settings, &motion.parameters.features);
    let gripper = gripper_profile(&prepared, &mut warnings);
    let fits = [("motion", &motion_fit), ("force", &force_fit)];
    let histories = fits.iter().filter_map(|(name, fit)| Some(((*name).to_owned(), fit.as_ref()?.history.clone()))).collect();
    let provenance = vec![
        ("demonstrations".to_owned(), dataset.demonstrations.len().to_string()),
        ("program".to_owned(), format!("cpdmp {}", env!("CARGO_PKG_VERSION"))),
        ("seed".to_owned(), seed.to_string()),
    ];
    let skill =
        Skill { parameter_source: dataset.parameter_source, motion, force, compliance, orientation, gripper, provenance, histories };
    skill.check()?;
    let noise = forcing_noise(&prepared);
    let fits = [("motion", motion_fit.as_ref()), ("force", force_fit.as_ref())];
    warnings.extend(warnings::about_models(&fits, &skill.compliance, noise.max(), &dataset.motion));
    let theta = prepared.iter().map(|p| &p.theta_m).sum::<DVector<f64>>() / prepared.len() as f64;
    let seen = (preparation(&prepared, settings), noise.iter().copied().collect());
    let report = LearningReport::of(&skill, &theta, fits.map(|(_, fit)| fit), seen, warnings)?;
    Ok(Learned { skill, report: LearningReport { ends, alignment_shifts_s, motion_choices, force_choices, ..report } })
}

/// The basis functions of the baseline: no more than half the samples of the shortest demonstration, or nothing would hold them between
/// samples.
pub(super) fn lwr_basis(prepared: &[Prepared], settings: &LearningSettings) -> usize {
    let shortest = prepared.iter().map(|p| p.fractions.len()).min().unwrap_or(0);
    settings.lwr_basis.min(shortest / 2).max(1)
}

type MotionFit = (Shaping, Option<Fit>, Compliance);

fn motion_fit(
    dataset: &Dataset,
    prepared: &[Prepared],
    settings: &LearningSettings,
    features: &FeatureMap,
    (seed, first): (u64, Option<&Skill>),
    may_go_on: MayGoOn,
) -> Result<MotionFit, LearningError> {
    let d = dataset.motion.len();
    if settings.shaping == ShapingKind::Lwr {
        let phases: Vec<f64> = prepared.iter().flat_map(|p| p.fractions.iter().map(|u| (-settings.alpha * u).exp())).collect();
        let all: Vec<_> = prepared.iter().flat_map(|p| p.forcing.row_iter()).collect();
        let lwr = Lwr::fit(&phases, &DMatrix::from_rows(&all), lwr_basis(prepared, settings), settings.alpha)?;
        return Ok((Shaping::Lwr(lwr), None, Compliance::stiff(0, d)));
    }
    let sequences = seen_motion(prepared, settings, features);
    let first = first.and_then(|skill| skill.motion.shaping.phmm());
    let fit = fit_from(first, &sequences, &settings.motion, seed, may_go_on)?;
    let noise = forcing_noise(prepared).max();
    let spreads = state_spreads(&fit.model, &sequences)?;
    let compliance = Compliance::decide(spreads, &spatial_columns(&dataset.motion), &settings.compliance, noise);
    Ok((Shaping::Phmm(fit.model.clone()), Some(fit), compliance))
}

fn force_fit(
    dataset: &Dataset,
    prepared: &[Prepared],
    settings: &LearningSettings,
    (seed, first): (u64, Option<&Skill>),
    may_go_on: MayGoOn,
) -> Result<Option<(ForceModel, Fit)>, LearningError> {
    if dataset.wrench.is_empty() || settings.shaping == ShapingKind::Lwr {
        return Ok(None);
    }
    let features = force_features(prepared, settings, seed);
    let sequences = seen_force(prepared, settings, &features);
    let first = first.and_then(|skill| skill.force.as_ref()).map(|force| &force.phmm);
    let fit = fit_from(first, &sequences, &settings.force, seed, may_go_on)?;
    let model = ForceModel {
        columns: dataset.wrench.clone(),
        parameters: ParameterSpace::of(dataset.parameters_f(), &thetas(prepared, |p| &p.theta_f)).with_features(features),
        phase_input: settings.phase_input,
        phmm: fit.model.clone(),
        evidence: fit.evidence.clone(),
    };
    Ok(Some((model, fit)))
}

/// From the model that was handed in, or from every start of the settings.
fn fit_from(
    first: Option<&Phmm>,
    sequences: &[Sequence],
    settings: &PhmmSettings,
    seed: u64,
    may_go_on: MayGoOn,
) -> Result<Fit, LearningError> {
    match first {
        Some(model) => refine(model, sequences, &PhmmSettings { states: model.states(), ..settings.clone() }),
        None => fit_while(sequences, settings, seed, may_go_on),
    }
}

/// Whether models of `first` can be continued on this dataset: everything that is not, at once.
fn check_first(dataset: &Dataset, settings: &LearningSettings, first: &Skill) -> Result<(), LearningError> {
    let mut faults = Vec::new();
    let mut same = |what: &str, skill: &[String], data: &[String]| {
        if skill != data {
            faults.push(format!("{what} of the first skill are [{}], of the dataset [{}]", skill.join(", "), data.join(", ")));
        }
    };
    same("motion columns", &first.motion.columns, &dataset.motion);
    same("motion parameters", &first.motion.parameters.names, &dataset.parameters_m());
    match &first.force {
        Some(force) => {
            same("wrench columns", &force.columns, &dataset.wrench);
            same("force parameters", &force.parameters.names, &dataset.parameters_f());
        }
        None => same("wrench columns", &[], &dataset.wrench),
    }
    if first.motion.phase_input != settings.phase_input {
        faults.push("the first skill has another phase_input than the settings".to_owned());
    }
    if first.motion.shaping.phmm().is_none() || settings.shaping == ShapingKind::Lwr {
        faults.push("the baseline has no model to start from".to_owned());
    }
    if faults.is_empty() { Ok(()) } else { Err(LearningError::Skill(faults.join("\n"))) }
}
