//! What a person should know about their data and the skill that came of it.

use nalgebra::{DMatrix, DVector};

use super::cpdmp::Compliance;
use super::ends::EndRule;
use super::learn::lwr_basis;
use super::parameters::mean_and_deviations;
use super::phmm::{Fit, FitStatus};
use super::prepare::Prepared;
use super::{Features, LearningSettings, ShapingKind};
use crate::demonstration::{Dataset, ParameterSource};
use crate::math::{LeastSquares, solve_normal_equations};

/// A gap in a recording counts as one from this length (s).
const LONG_GAP_S: f64 = 0.5;
/// A window counts as widened from this factor on (-): less is rounding to whole samples.
const WIDENED: f64 = 1.5;
/// Condition number of the parameters' correlations from which they count as collinear (-): the square of Belsley's index of 30.
const LARGE_CONDITION: f64 = 900.0;

/// Parameters that say too little, gaps in recordings, and a setting that these data leave without effect.
pub(super) fn about_data(dataset: &Dataset, prepared: &[Prepared], settings: &LearningSettings) -> Vec<String> {
    let mut warnings = Vec::new();
    let (lwr, told) = (settings.shaping == ShapingKind::Lwr, settings.lwr_ends == EndRule::Regression);
    if lwr && told && dataset.parameter_source != ParameterSource::Given {
        let source = dataset.parameter_source.word();
        warnings.push(format!("lwr_ends has no effect with theta = \"{source}\": the ends follow from the parameters"));
    }
    for (key, features, parameters) in [
        ("motion.features", settings.motion.features, dataset.parameters_m()),
        ("force.features", settings.force.features, dataset.parameters_f()),
    ] {
        if !lwr && features != Features::Linear && parameters.is_empty() && (key == "motion.features" || !dataset.wrench.is_empty()) {
            warnings.push(format!("{key} has no effect: the demonstrations have no parameters for it"));
        }
    }
    let basis = lwr_basis(prepared, settings);
    if lwr && basis < settings.lwr_basis {
        let (asked, rate) = (settings.lwr_basis, settings.rate_hz);
        warnings.push(format!(
            "the baseline has {basis} basis functions instead of {asked}: at {rate} Hz the shortest demonstration has about twice as many samples"
        ));
    }
    if prepared.len() == 1 {
        let unknown = "where people do it differently, and so where to comply, is unknown";
        warnings.push(format!("there is one demonstration only: {unknown}; show more"));
    }
    let thetas = |of: fn(&Prepared) -> &DVector<f64>| prepared.iter().map(of).collect::<Vec<_>>();
    warnings.extend(about_parameters("theta_m", &dataset.parameters_m(), &thetas(|p| &p.theta_m)));
    warnings.extend(about_parameters("theta_f", &dataset.parameters_f(), &thetas(|p| &p.theta_f)));
    for (what, has) in [("an orientation", orientation as fn(&Prepared) -> bool), ("a gripper", gripper)] {
        let with = prepared.iter().filter(|p| has(p)).count();
        if with != 0 && with != prepared.len() {
            warnings.push(format!("only {with} of {} demonstrations have {what}: the skill has none", prepared.len()));
        }
    }
    for (demonstration, p) in dataset.demonstrations.iter().zip(prepared) {
        if p.window_s > WIDENED * settings.smoothing_window_s {
            let (name, window, asked) = (&demonstration.name, p.window_s, settings.smoothing_window_s);
            let why = "a polynomial takes so many samples";
            warnings.push(format!("{name}: smoothed over {window:.3} s instead of {asked} s, since {why}: what is faster is lost"));
        }
        if p.largest_gap_s > LONG_GAP_S {
            warnings.push(format!("{}: {:.2} s without a sample are bridged by a straight line", demonstration.name, p.largest_gap_s));
        }
    }
    warnings
}

fn orientation(p: &Prepared) -> bool {
    p.trajectory.orientations().is_some()
}

fn gripper(p: &Prepared) -> bool {
    p.trajectory.gripper().is_some()
}

/// Rank and condition of the parameters over the demonstrations.
fn about_parameters(kind: &str, names: &[String], thetas: &[&DVector<f64>]) -> Option<String> {
    let p = names.len();
    if p == 0 {
        return None;
    }
    let (_, deviations) = mean_and_deviations(thetas);
    let scatter = deviations.tr_mul(&deviations);
    let LeastSquares { rank, condition, .. } = solve_normal_equations(&scatter, &DMatrix::zeros(p, 0));
    let listed = names.join(", ");
    if rank < p {
        let (constant, changing): (Vec<usize>, Vec<usize>) = (0..p).partition(|j| scatter[(*j, *j)] == 0.0);
        let named = |which: &[usize]| which.iter().map(|j| names[*j].as_str()).collect::<Vec<_>>().join(", ");
        let still = format!("{} never changes and has no effect", named(&constant));
        let together = format!("{} change together, and only their combination is learned", named(&changing));
        let consequence = match (constant.is_empty(), rank < changing.len()) {
            (false, true) => format!("{still}; {together}"),
            (false, false) => still,
            (true, _) => together,
        };
        return Some(format!("{kind} [{listed}]: the demonstrations vary {rank} of {p} parameters; {consequence}"));
    }
    (condition > LARGE_CONDITION)
        .then(|| format!("{kind} [{listed}]: nearly collinear over the demonstrations (condition {condition:.1e})"))
}

/// Fits that did not settle, and compliance that decides nothing.
pub(super) fn about_models(fits: &[(&str, Option<&Fit>)], compliance: &Compliance, noise_m2: f64) -> Vec<String> {
    let mut warnings = Vec::new();
    for (name, fit) in fits {
        let ended = match fit.map(|f| f.status) {
            Some(FitStatus::IterationLimit) => "used all iterations without converging",
            Some(FitStatus::Fell) => "stopped because its likelihood fell",
            Some(FitStatus::Degenerate) => "stopped because a covariance collapsed",
            Some(FitStatus::Converged) | None => continue,
        };
        warnings.push(format!("the {name} model {ended}"));
    }
    let complying = compliance.beta.iter().filter(|beta| **beta != 0.0).count();
    let (states, sigma) = (compliance.beta.len(), compliance.threshold_m2);
    if states > 0 && (complying == 0 || complying == states) {
        let who = if complying == 0 { "no state" } else { "every state" };
        let (least, most) = compliance.values_m2.iter().fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(*v), b.max(*v)));
        warnings.push(format!("{who} complies: values from {least:.1e} to {most:.1e} m^2, threshold {sigma:.1e} m^2"));
    }
    if states > 0 && sigma < noise_m2 {
        warnings
            .push(format!("the compliance threshold {sigma:.1e} m^2 lies below the sensor noise in the forcing term, {noise_m2:.1e} m^2"));
    }
    warnings
}
