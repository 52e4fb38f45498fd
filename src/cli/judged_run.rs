//! One scenario from its settings to its report.

use super::located::Located;
use super::terminal::Terminal;
use crate::check::{allow, judge, judge_planar};
use crate::demonstration::DemonstrationError;
use crate::learning::LearningError;
use crate::planar::PlanarOutcome;
use crate::report::{Outcome, RunReport};
use crate::scenario::{Diagnostic, PlanarRun, Scenario, Work};
use crate::simulation::{self, Experiment, Progress, RunOutcome, SimulationError};
use crate::world::WorldError;

/// A run, as far as it came, with its report.
pub(super) struct JudgedRun {
    /// What it left behind; nothing if it could not be finished.
    pub left: Option<Left>,
    pub report: RunReport,
    /// What keeps it from being run, where it stands in the scenario; the report's error tells the same.
    pub refusal: Located,
    /// What is odd about the robot's file; the report's warnings tell the same.
    pub odd: Vec<Diagnostic>,
}

/// What a run left behind.
pub(super) enum Left {
    /// A simulated world.
    Arm(Box<RunOutcome>),
    /// Paths in a plane.
    Planar(Box<PlanarOutcome>),
}

impl JudgedRun {
    /// Input that cannot be used leaves nothing on the disk.
    pub fn wants_folder(&self) -> bool {
        self.report.outcome != Outcome::InvalidInput
    }

    /// Says why it was not run: each fault with the lines that it is about, if it is about any.
    pub fn tell_refusal(&self, terminal: &Terminal) {
        match &self.refusal.faults[..] {
            [] => terminal.error(&format!("error: {}\n", self.report.error.as_deref().unwrap_or_default())),
            faults => {
                terminal.faults(faults);
                self.refusal.elsewhere.iter().for_each(|told| terminal.error(&format!("error: {told}\n")));
            }
        }
    }
}

/// Runs a scenario and judges it.
pub(super) fn judged_run(scenario: &Scenario, progress: &dyn Progress) -> JudgedRun {
    let mut run = match &scenario.work {
        Work::Arm(experiment) => arm(experiment, scenario, progress),
        Work::Planar(planar) => plane(planar, scenario, progress),
    };
    run.report.locate(|key| scenario.places.get(key));
    if let Some(left) = &run.left {
        if let Left::Arm(left) = left {
            run.odd = Located::default().with(&left.robot_warnings).faults;
        }
        run.report.warnings.extend(run.odd.iter().chain(&scenario.warnings).map(ToString::to_string));
    }
    run
}

fn arm(experiment: &Experiment, scenario: &Scenario, progress: &dyn Progress) -> JudgedRun {
    match simulation::run(experiment, progress) {
        Ok(mut left) => {
            allow(&mut left.collisions, &scenario.allowed_contacts);
            let criteria = judge(&left, experiment, &scenario.criteria);
            JudgedRun {
                report: RunReport::finished(experiment, &left, &criteria),
                left: Some(Left::Arm(Box::new(left))),
                refusal: Located::default(),
                odd: Vec::new(),
            }
        }
        Err(SimulationError::CutShort { reason, mut left }) => {
            allow(&mut left.collisions, &scenario.allowed_contacts);
            let report = RunReport::cut_short(experiment, &left, outcome_of(&reason), &reason.to_string());
            JudgedRun { report, left: Some(Left::Arm(left)), refusal: Located::default(), odd: Vec::new() }
        }
        Err(error) => {
            let refusal = Located::of(&error, scenario);
            let run = failed(scenario, outcome_of(&error), &refusal.text());
            JudgedRun { refusal, ..run }
        }
    }
}

fn plane(planar: &PlanarRun, scenario: &Scenario, progress: &dyn Progress) -> JudgedRun {
    progress.phase("learn", 0);
    let started_s = progress.elapsed_s();
    match planar.run(&|| progress.may_go_on()) {
        Ok(left) => {
            let criteria = judge_planar(&left, &scenario.criteria);
            let wall_s = progress.elapsed_s() - started_s;
            let report = RunReport::of_planar(&planar.name, planar.seed, &left, &criteria, wall_s);
            JudgedRun { report, left: Some(Left::Planar(Box::new(left))), refusal: Located::default(), odd: Vec::new() }
        }
        Err(error) => failed(scenario, of_learning(&error), &error.to_string()),
    }
}

fn failed(scenario: &Scenario, outcome: Outcome, error: &str) -> JudgedRun {
    JudgedRun {
        left: None,
        report: RunReport::failed(scenario.work.name(), scenario.work.seed(), outcome, error),
        refusal: Located::default(),
        odd: Vec::new(),
    }
}

/// How a command ends that cannot learn.
pub(super) fn of_learning(error: &LearningError) -> Outcome {
    match error {
        LearningError::Settings(_) | LearningError::Demonstration(_) | LearningError::Skill(_) | LearningError::Io { .. } => {
            Outcome::InvalidInput
        }
        LearningError::Stopped { .. } => Outcome::TimeLimit,
        _ => Outcome::LearningFailed,
    }
}

/// How a command ends that meets this error.
pub(super) fn outcome_of(error: &SimulationError) -> Outcome {
    match error {
        SimulationError::World(WorldError::Diverged { .. }) => Outcome::Diverged,
        SimulationError::Stopped { .. } | SimulationError::StoppedBefore { .. } => Outcome::TimeLimit,
        SimulationError::CutShort { reason, .. } => outcome_of(reason),
        SimulationError::Learning(error) => of_learning(error),
        SimulationError::At { error, .. } => outcome_of(error),
        SimulationError::Several(errors) => errors.iter().map(outcome_of).max().unwrap_or(Outcome::InvalidInput),
        SimulationError::Demonstrations(DemonstrationError::Io { .. } | DemonstrationError::Invalid(_))
        | SimulationError::Urdf(_)
        | SimulationError::Arm(_)
        | SimulationError::Snapshot(_)
        | SimulationError::Unreachable { .. }
        | SimulationError::Swing { .. }
        | SimulationError::JointLimits(_)
        | SimulationError::World(_)
        | SimulationError::Scene(_)
        | SimulationError::Wrench(_)
        | SimulationError::Mismatch(_)
        | SimulationError::Trajectory(_) => Outcome::InvalidInput,
    }
}
