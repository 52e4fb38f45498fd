//! One experiment from beginning to end, and its three parts for those who repeat only one of them.

use nalgebra::Vector3;
use rayon::prelude::*;
use twox_hash::XxHash3_64;

use super::execution::execute;
use super::replay::{Replay, replay};
use super::setup::Setup;
use super::teaching::{Lesson, demonstration, settings_of, teach};
use super::{
    DemonstrationSource, Experiment, LessonRecord, PhaseSummary, Progress, RunOutcome, SimulationError, Snapshot, Snapshots, TeachingPlan,
    WorldTrace,
};
use crate::demonstration::{Dataset, Demonstration, ParameterSource};
use crate::learning::{self, Learned, Skill};

/// Carries out `experiment`: teaches or reads the demonstrations, learns, executes.
///
/// # Errors
/// When the robot, the demonstrations or a pose cannot be used, nothing can be learned, or the simulation diverges.
pub fn run(experiment: &Experiment, progress: &dyn Progress) -> Result<RunOutcome, SimulationError> {
    let setup = Setup::unchecked(experiment)?;
    setup.preflight(progress)?;
    let (dataset, mut history) = demonstrate(&setup, progress)?;
    let started = progress.elapsed_s();
    progress.phase("learn", 0);
    let learned = learning::learn_while(&dataset, &experiment.learning, experiment.seed, &|| progress.may_go_on())?;
    history.close("learn", 0, started, progress);
    perform(&setup, &dataset, &learned, history, progress)
}

/// The demonstrations of an experiment: taught and replayed, or read.
///
/// # Errors
/// When a pose cannot be reached, a file cannot be used, or the simulation diverges.
pub fn demonstrate(setup: &Setup, progress: &dyn Progress) -> Result<(Dataset, History), SimulationError> {
    let mut history = History::default();
    let dataset = match &setup.experiment.demonstrations {
        DemonstrationSource::Teach(plan) => taught(setup, plan, progress, &mut history)?,
        DemonstrationSource::Dataset(folder) => {
            let dataset = setup.in_space(Dataset::read(folder)?)?;
            setup.fits(&dataset)?;
            dataset
        }
    };
    Ok((dataset, history))
}

/// Executes a learned skill in the experiment's setting; `history` is what came before.
///
/// # Errors
/// When the skill does not fit the experiment or the arm cannot follow its plan; [`SimulationError::CutShort`] when the simulation diverges or is
/// stopped.
pub fn perform(
    setup: &Setup,
    dataset: &Dataset,
    learned: &Learned,
    mut history: History,
    progress: &dyn Progress,
) -> Result<RunOutcome, SimulationError> {
    let started = progress.elapsed_s();
    let mut outcome = planned(setup, dataset, learned, std::mem::take(&mut history.lessons))?;
    setup.can_follow(&outcome.plan, progress)?;
    progress.planned(&outcome);
    progress.phase("execute", 0);
    let executed = execute(setup, &learned.skill, None, progress)?;
    if setup.experiment.trace.every_steps > 0 {
        history.traces.push(WorldTrace::of_text("learn", "skill", &learned.skill.to_json()?));
    }
    history.hashes.push(executed.state_hash);
    history.traces.extend(WorldTrace::of("execute", 0, executed.trace));
    history.close("execute", executed.steps, started, progress);
    outcome.state_hash = history.hash();
    outcome.steps = executed.records;
    outcome.human_peak_force_n = executed.human_peak_force_n;
    outcome.tool_peak_force_n = executed.tool_peak_force_n;
    outcome.goal = executed.goal;
    outcome.collisions = executed.collisions;
    outcome.clearances = executed.clearances;
    outcome.final_objects = executed.final_objects;
    outcome.snapshots = executed.snapshots;
    outcome.phases = history.phases;
    outcome.traces = history.traces;
    match executed.cut_short {
        None => Ok(outcome),
        Some(reason) if outcome.steps.is_empty() => Err(reason),
        Some(reason) => Err(SimulationError::CutShort { reason: Box::new(reason), left: Box::new(outcome) }),
    }
}

/// What is known before the execution.
fn planned(setup: &Setup, dataset: &Dataset, learned: &Learned, lessons: Vec<LessonRecord>) -> Result<RunOutcome, SimulationError> {
    let question = setup.experiment.question();
    let mut learning = learned.report.clone();
    learning.warnings.extend(warnings(&lessons));
    learning.warnings.extend(extrapolation(setup, &learned.skill)?);
    Ok(RunOutcome {
        robot: setup.robot.clone(),
        robot_warnings: setup.warnings.clone(),
        dataset: dataset.clone(),
        lessons,
        skill: learned.skill.clone(),
        learning,
        plan: setup.with_place(learning::generate(&learned.skill, &question, 1.0 / setup.experiment.log_rate_hz, 1.0)?)?,
        steps: Vec::new(),
        human_peak_force_n: 0.0,
        tool_peak_force_n: 0.0,
        goal: Vector3::zeros(),
        collisions: Vec::new(),
        clearances: Vec::new(),
        phases: Vec::new(),
        state_hash: 0,
        traces: Vec::new(),
        snapshots: Snapshots::new(),
        final_objects: Vec::new(),
        beside: Vec::new(),
    })
}

/// Executes a skill that was learned before, and returns what is kept of the states: of the skill, and of the world in which it was executed.
///
/// # Errors
/// When the robot or the skill cannot be used, the start cannot be reached, or the simulation diverges or is stopped.
pub fn execute_again(experiment: &Experiment, skill: &Skill, progress: &dyn Progress) -> Result<Vec<WorldTrace>, SimulationError> {
    let setup = Setup::new(experiment)?;
    progress.phase("execute", 0);
    let executed = execute(&setup, skill, None, progress)?;
    match executed.cut_short {
        None => {
            let learned = WorldTrace::of_text("learn", "skill", &skill.to_json()?);
            Ok(std::iter::once(learned).chain(WorldTrace::of("execute", 0, executed.trace)).collect())
        }
        Some(reason) => Err(reason),
    }
}

/// Takes up the execution of a skill from `snapshot`, and returns what is kept of the states that come after it.
///
/// # Errors
/// As [`execute_again`], and when the snapshot is not of this experiment and skill.
pub fn resume(
    experiment: &Experiment,
    skill: &Skill,
    snapshot: &Snapshot,
    progress: &dyn Progress,
) -> Result<Vec<WorldTrace>, SimulationError> {
    let setup = Setup::new(experiment)?;
    progress.phase("execute", 0);
    let executed = execute(&setup, skill, Some(snapshot), progress)?;
    match executed.cut_short {
        None => Ok(WorldTrace::of("execute", 0, executed.trace.after(snapshot.step)).into_iter().collect()),
        Some(reason) => Err(reason),
    }
}

/// A warning when the setting lies outside what was demonstrated.
fn extrapolation(setup: &Setup, skill: &Skill) -> Result<Option<String>, SimulationError> {
    let beyond = skill.extrapolation(&setup.experiment.question().theta_m)?;
    let told = setup.experiment.theta_m.join(", ");
    let message = || format!("{told} lies outside the demonstrated range by {:.0} % of it: the skill extrapolates", beyond * 100.0);
    Ok((beyond > 0.0).then(message))
}

/// Teaches all demonstrations, then replays each; both on all cores, the result independent of their number.
fn taught(setup: &Setup, plan: &TeachingPlan, progress: &dyn Progress, history: &mut History) -> Result<Dataset, SimulationError> {
    let settings = settings_of(plan, &setup.experiment.parameters);
    let started = progress.elapsed_s();
    let each = setup.steps(plan.duration_s) + 1;
    progress.phase("teach", each * settings.len() as u64);
    let taught: Vec<(Lesson, LessonRecord)> = settings
        .par_iter()
        .enumerate()
        .map(|(number, parameters)| {
            let mut lesson = teach(setup, plan, parameters, number as u64, progress)?;
            progress.advance(lesson.steps);
            let seen = seen(&mut lesson);
            progress.lesson(&setup.robot, number, &seen);
            Ok((lesson, seen))
        })
        .collect::<Result<_, SimulationError>>()?;
    let (mut lessons, seen): (Vec<Lesson>, Vec<LessonRecord>) = taught.into_iter().unzip();
    history.hashes.extend(lessons.iter().map(|lesson| lesson.state_hash));
    history.traces.extend(lessons.iter_mut().filter_map(|l| WorldTrace::of("teach", l.number, std::mem::take(&mut l.trace))));
    history.close("teach", lessons.iter().map(|lesson| lesson.steps).sum(), started, progress);

    history.lessons = seen;
    progress.taught(&setup.robot, &history.lessons);

    let started = progress.elapsed_s();
    progress.phase("replay", each * lessons.len() as u64);
    let replays: Vec<(Demonstration, Replay)> = lessons
        .par_iter()
        .map(|lesson| {
            let replayed = replay(setup, lesson, progress)?;
            progress.advance(replayed.steps);
            Ok((demonstration(setup, lesson, &replayed.wrench)?, replayed))
        })
        .collect::<Result<_, SimulationError>>()?;
    history.hashes.extend(replays.iter().map(|(_, replayed)| replayed.state_hash));
    history.close("replay", replays.iter().map(|(_, replayed)| replayed.steps).sum(), started, progress);
    let (demonstrations, replays): (Vec<Demonstration>, Vec<Replay>) = replays.into_iter().unzip();
    history.traces.extend((0..).zip(replays).filter_map(|(number, replayed)| WorldTrace::of("replay", number, replayed.trace)));
    Ok(Dataset {
        motion: setup.taught_motion(),
        wrench: ["fx_n", "fy_n", "fz_n"].map(String::from).to_vec(),
        parameter_source: ParameterSource::Given,
        demonstrations,
    })
}

/// What the lesson looked like, taken from it.
fn seen(lesson: &mut Lesson) -> LessonRecord {
    let Lesson { name, parameters, astray, looks, .. } = lesson;
    LessonRecord { name: name.clone(), parameters: parameters.clone(), astray: astray.clone(), looks: std::mem::take(looks) }
}

/// What is odd about lessons.
fn warnings(lessons: &[LessonRecord]) -> impl Iterator<Item = String> {
    lessons.iter().filter_map(|lesson| Some(format!("lesson `{}`: {}", lesson.name, lesson.astray.as_ref()?)))
}

/// What has been simulated so far: the phases, the hashes of all worlds in a fixed order, and what the lessons looked like.
#[derive(Clone, Debug, Default)]
pub struct History {
    phases: Vec<PhaseSummary>,
    hashes: Vec<u64>,
    lessons: Vec<LessonRecord>,
    traces: Vec<WorldTrace>,
}

impl History {
    /// What is odd about the lessons that were taught.
    pub fn warnings(&self) -> Vec<String> {
        warnings(&self.lessons).collect()
    }

    fn close(&mut self, name: &str, steps: u64, started_s: f64, progress: &dyn Progress) {
        let wall_s = progress.elapsed_s() - started_s;
        progress.note(&format!("{name}: {wall_s:.1} s"));
        self.phases.push(PhaseSummary { name: name.into(), steps, wall_s });
    }

    fn hash(&self) -> u64 {
        let bytes: Vec<u8> = self.hashes.iter().flat_map(|hash| hash.to_le_bytes()).collect();
        XxHash3_64::oneshot(&bytes)
    }
}
