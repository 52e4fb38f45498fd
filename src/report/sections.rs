//! The sections of a report, each from what the rooms below say.

use super::{
    AnswerStatus, ClearanceReport, CollisionReport, ComplianceReport, ComplianceState, CriterionReport, HumanReport, LearningSection,
    PhaseReport, Window,
};
use crate::check::{Criterion, Expectation, compliance_windows};
use crate::learning::LearningReport;
use crate::learning::cpdmp::Statistic;
use crate::learning::phmm::FitStatus;
use crate::simulation::{PhaseSummary, RunOutcome, StepRecord};
use crate::world::{Clearance, ContactEpisode, NEAR_M, Object, Permission};

/// Force below which a hand does not count as touching (N): a hundredth of what a person feels at the wrist.
const TOUCH_N: f64 = 0.05;

pub(super) fn criterion(criterion: &Criterion) -> CriterionReport {
    CriterionReport {
        name: criterion.name.clone(),
        required: criterion.expect != Expectation::Report && criterion.not_judged.is_none(),
        expect: criterion.expect.name().into(),
        passed: criterion.passed,
        as_expected: criterion.as_expected(),
        value: finite(criterion.value),
        limit: finite(criterion.limit),
        unit: criterion.unit.into(),
        margin: finite(criterion.margin),
        first_failed_time_s: criterion.first_failed_time_s.and_then(finite),
        place: None,
        status: if criterion.not_judged.is_some() { AnswerStatus::NotJudged } else { AnswerStatus::Judged },
        not_judged_because: criterion.not_judged.map(str::to_owned),
    }
}

pub(super) fn collision(contact: &ContactEpisode) -> CollisionReport {
    let (reason, reason_key) = match &contact.permission {
        None => (None, None),
        Some(Permission::Grasp(object)) => (Some("fingers may touch what can be grasped"), Some(format!("object.{object}"))),
        Some(Permission::Objects) => (Some("objects may touch each other"), None),
        Some(Permission::Scenario(name)) => (Some("the scenario allows it"), Some(format!("allowed_contact.{name}"))),
    };
    CollisionReport {
        a: contact.a.clone(),
        b: contact.b.clone(),
        allowed: contact.allowed,
        first_time_s: contact.first_time_s,
        last_time_s: contact.last_time_s,
        max_depth_m: contact.max_depth_m,
        deepest_time_s: contact.deepest_time_s,
        deepest_point_m: contact.deepest_point.coords.into(),
        max_force_n: finite(contact.max_force_n),
        reason,
        reason_key,
        reason_place: None,
    }
}

/// Everything measured about objects, and of the robot itself what came near.
pub(super) fn clearances(clearances: &[Clearance], objects: &[Object]) -> Vec<ClearanceReport> {
    let told = |one: &&Clearance| {
        let object = objects.iter().any(|object| object.name == one.b);
        one.min_distance_m.is_finite() && (object || one.min_distance_m < NEAR_M)
    };
    let report = |one: &Clearance| ClearanceReport {
        a: one.a.clone(),
        b: one.b.clone(),
        min_distance_m: finite(one.min_distance_m),
        time_s: one.time_s,
        point_a_m: one.point_a.coords.into(),
        point_b_m: one.point_b.coords.into(),
    };
    clearances.iter().filter(told).map(report).collect()
}

pub(super) fn phase(phase: &PhaseSummary) -> PhaseReport {
    PhaseReport { name: phase.name.clone(), steps: phase.steps, wall_s: phase.wall_s }
}

pub(super) fn compliance(outcome: &RunOutcome) -> ComplianceReport {
    let learned = &outcome.learning;
    let statistic = match learned.statistic {
        Statistic::Literal => "literal",
        Statistic::Conditional => "conditional",
        Statistic::BetweenDemonstration => "between_demonstration",
    };
    let states =
        learned.states.iter().map(|state| ComplianceState { index: state.index, value_m2: finite(state.value_m2), beta: state.beta });
    let windows = compliance_windows(&outcome.steps).into_iter().map(|window| Window { start_s: window.start_s, end_s: window.end_s });
    ComplianceReport { statistic, threshold_m2: finite(learned.threshold_m2), states: states.collect(), windows: windows.collect() }
}

/// The motion model's fit; the baseline has none.
pub(super) fn learning(report: &LearningReport) -> LearningSection {
    let fit = report.motion.as_ref();
    LearningSection {
        log_likelihood: fit.map_or(Vec::new(), |fit| fit.log_likelihood.iter().copied().map(finite).collect()),
        states: fit.map_or(0, |fit| fit.states),
        starts: fit.map_or(0, |fit| fit.starts.len()),
        status: fit.map_or("least_squares", |fit| fit_status(fit.status)),
        warnings: report.warnings.clone(),
    }
}

pub(super) fn fit_status(status: FitStatus) -> &'static str {
    match status {
        FitStatus::Converged => "converged",
        FitStatus::IterationLimit => "iteration_limit",
        FitStatus::Fell => "fell",
        FitStatus::Degenerate => "degenerate",
    }
}

/// Peak force, work and contact time of the person, from the logged steps: the work by the trapezoidal rule.
pub(super) fn human(steps: &[StepRecord]) -> HumanReport {
    let mut report = HumanReport { peak_force_n: 0.0, work_j: 0.0, contact_s: 0.0 };
    for step in steps {
        report.peak_force_n = report.peak_force_n.max(step.human.force.norm());
    }
    for pair in steps.windows(2) {
        let (before, after) = (&pair[0].human, &pair[1].human);
        if before.force.norm() > TOUCH_N && after.force.norm() > TOUCH_N {
            report.work_j += 0.5 * (before.force + after.force).dot(&(after.point - before.point));
            report.contact_s += pair[1].time_s - pair[0].time_s;
        }
    }
    report
}

/// Simulated seconds per second of wall time, over the phases that simulate.
pub(super) fn real_time_factor(step_s: f64, phases: &[PhaseSummary]) -> Option<f64> {
    let simulated: f64 = phases.iter().map(|phase| phase.steps as f64 * step_s).sum();
    let wall: f64 = phases.iter().filter(|phase| phase.steps > 0).map(|phase| phase.wall_s).sum();
    finite(simulated / wall)
}

/// JSON has no NaN and no infinity.
fn finite(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}
