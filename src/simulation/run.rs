//! One experiment from beginning to end.

use std::time::Instant;

use rayon::prelude::*;
use twox_hash::XxHash3_64;

use super::execution::{execute, settings};
use super::replay::replay;
use super::setup::Setup;
use super::teaching::{Lesson, demonstration, settings_of, teach};
use super::{DemonstrationSource, Experiment, PhaseSummary, Progress, RunOutcome, SimulationError, TeachingPlan};
use crate::demonstration::{Dataset, Demonstration};
use crate::learning::{self, Learned};

/// Carries out `experiment`: teaches or reads the demonstrations, learns, executes.
///
/// # Errors
/// When the robot, the demonstrations or a pose cannot be used, nothing can be learned, or the simulation diverges.
pub fn run(experiment: &Experiment, progress: &dyn Progress) -> Result<RunOutcome, SimulationError> {
    let setup = Setup::new(experiment)?;
    let mut book = PhaseBook { phases: Vec::new(), hashes: Vec::new() };
    let dataset = match &experiment.demonstrations {
        DemonstrationSource::Teach(plan) => taught(&setup, plan, progress, &mut book)?,
        DemonstrationSource::Dataset(folder) => Dataset::read(folder)?,
    };
    let started = Instant::now();
    progress.phase("learn", 0);
    let Learned { skill, report } = learning::learn(&dataset, &experiment.learning, experiment.seed)?;
    book.close("learn", 0, started, progress);

    let started = Instant::now();
    let plan = learning::generate(&skill, &settings(&setup), 1.0 / experiment.log_rate_hz, 1.0)?;
    progress.phase("execute", 0);
    let executed = execute(&setup, &skill)?;
    book.hashes.push(executed.state_hash);
    book.close("execute", executed.steps, started, progress);
    let state_hash = book.hash();
    Ok(RunOutcome {
        robot: setup.robot,
        robot_warnings: setup.warnings,
        dataset,
        skill,
        learning: report,
        plan,
        steps: executed.records,
        collisions: executed.collisions,
        clearances: executed.clearances,
        phases: book.phases,
        state_hash,
        final_objects: executed.final_objects,
    })
}

/// Teaches all demonstrations, then replays each; both on all cores, the result independent of their number.
fn taught(setup: &Setup, plan: &TeachingPlan, progress: &dyn Progress, book: &mut PhaseBook) -> Result<Dataset, SimulationError> {
    let settings = settings_of(plan, &setup.experiment.parameters);
    let started = Instant::now();
    let each = setup.steps(plan.duration_s) + 1;
    progress.phase("teach", each * settings.len() as u64);
    let lessons: Vec<Lesson> = settings
        .par_iter()
        .enumerate()
        .map(|(number, parameters)| {
            let lesson = teach(setup, plan, parameters, number as u64)?;
            progress.advance(lesson.steps);
            Ok(lesson)
        })
        .collect::<Result<_, SimulationError>>()?;
    book.hashes.extend(lessons.iter().map(|lesson| lesson.state_hash));
    book.close("teach", lessons.iter().map(|lesson| lesson.steps).sum(), started, progress);

    let started = Instant::now();
    progress.phase("replay", each * lessons.len() as u64);
    let replays: Vec<(Demonstration, u64, u64)> = lessons
        .par_iter()
        .map(|lesson| {
            let replayed = replay(setup, lesson)?;
            progress.advance(replayed.steps);
            Ok((demonstration(setup, lesson, &replayed.wrench)?, replayed.state_hash, replayed.steps))
        })
        .collect::<Result<_, SimulationError>>()?;
    book.hashes.extend(replays.iter().map(|(_, hash, _)| *hash));
    book.close("replay", replays.iter().map(|(_, _, steps)| *steps).sum(), started, progress);
    Ok(Dataset {
        motion: ["x_m", "y_m", "z_m"].map(String::from).to_vec(),
        wrench: ["fx_n", "fy_n", "fz_n"].map(String::from).to_vec(),
        demonstrations: replays.into_iter().map(|(demonstration, _, _)| demonstration).collect(),
    })
}

/// What each phase took, and the hashes of all worlds in a fixed order.
struct PhaseBook {
    phases: Vec<PhaseSummary>,
    hashes: Vec<u64>,
}

impl PhaseBook {
    fn close(&mut self, name: &str, steps: u64, started: Instant, progress: &dyn Progress) {
        let wall_s = started.elapsed().as_secs_f64();
        progress.note(&format!("{name}: {wall_s:.1} s"));
        self.phases.push(PhaseSummary { name: name.into(), steps, wall_s });
    }

    fn hash(&self) -> u64 {
        let bytes: Vec<u8> = self.hashes.iter().flat_map(|hash| hash.to_le_bytes()).collect();
        XxHash3_64::oneshot(&bytes)
    }
}
