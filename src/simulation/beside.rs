//! What is executed beside a run: the same lessons, scene, seed and person, with another skill or another way to execute it. Of what such a
//! variation does, as of everything else, the simulated world has the last word.

use rayon::prelude::*;

use super::run::{History, perform};
use super::setup::Setup;
use super::{Experiment, Progress, RunOutcome, SimulationError, TraceSettings};
use crate::demonstration::{Dataset, Demonstration};
use crate::learning::{self, Learned, ShapingKind};
use crate::palette::meaning::Difference;

/// Another way to learn or to execute what was taught in a run.
#[derive(Clone, Debug)]
pub struct Variation {
    /// Its name.
    pub name: String,
    /// What it changes of the run's scenario, as `KEY=VALUE` each.
    pub changes: Vec<String>,
    /// The run's experiment with these changes.
    pub experiment: Experiment,
}

impl Variation {
    /// What makes it another than the run of an experiment, however its changes are written.
    #[must_use]
    pub fn difference(&self, run: &Experiment) -> Difference {
        let is_baseline = |experiment: &Experiment| experiment.learning.shaping == ShapingKind::Lwr;
        let listens = |experiment: &Experiment| experiment.execution.coupling.enabled;
        if is_baseline(&self.experiment) && !is_baseline(run) {
            Difference::Method
        } else if listens(run) && !listens(&self.experiment) {
            Difference::Coupling
        } else {
            Difference::Other
        }
    }
}

/// What came of a variation.
#[derive(Clone, Debug)]
pub struct Beside {
    /// The variation's name.
    pub name: String,
    /// What it changes, as `KEY=VALUE` each.
    pub changes: Vec<String>,
    /// What makes it another than the run.
    pub difference: Difference,
    /// Its execution, with the skill behind it; lessons are those of the run.
    pub outcome: RunOutcome,
}

/// Executes `variations` with the demonstrations of a run of an experiment, on all cores. A skill is learned again only where a variation
/// learns otherwise. The run itself is neither changed nor repeated, and none depends on another.
///
/// # Errors
/// Of each variation, those of [`learning::learn_while`] and [`perform`].
pub fn execute_beside(
    (experiment, run): (&Experiment, &RunOutcome),
    variations: &[Variation],
    progress: &dyn Progress,
) -> Vec<Result<Beside, SimulationError>> {
    progress.phase("beside", 0);
    variations.par_iter().map(|variation| execute_one((experiment, run), variation, &Unseen(progress))).collect()
}

fn execute_one(
    (experiment, run): (&Experiment, &RunOutcome),
    variation: &Variation,
    progress: &dyn Progress,
) -> Result<Beside, SimulationError> {
    // Nobody repeats a variation from its middle.
    let trace = TraceSettings { every_steps: 0, snapshot_every_steps: 0, detail: None };
    let setup = Setup::new(&Experiment { trace, ..variation.experiment.clone() })?;
    let dataset = told(run, &setup.experiment);
    setup.fits(&dataset)?;
    let learned = if setup.experiment.learning == experiment.learning && dataset == run.dataset {
        Learned { skill: run.skill.clone(), report: run.learning.clone() }
    } else {
        learning::learn_while(&dataset, &setup.experiment.learning, setup.experiment.seed, &|| progress.may_go_on())?
    };
    let outcome = perform(&setup, &dataset, &learned, History::default(), progress)?;
    let difference = variation.difference(experiment);
    Ok(Beside { name: variation.name.clone(), changes: variation.changes.clone(), difference, outcome })
}

/// The demonstrations of a run with the parameters that another experiment tells its skill.
fn told(run: &RunOutcome, experiment: &Experiment) -> Dataset {
    let mut dataset = run.dataset.clone();
    for (number, demonstration) in dataset.demonstrations.iter_mut().enumerate() {
        // A lesson knows its whole setting, a demonstration that was read what stands in its file.
        let known = match run.lessons.get(number) {
            Some(lesson) => lesson.parameters.0.clone(),
            None => demonstration.theta_m.iter().chain(&demonstration.theta_f).cloned().collect(),
        };
        let theta = |names: &[String]| -> Vec<(String, f64)> {
            names.iter().filter_map(|name| known.iter().find(|(known, _)| known == name).cloned()).collect()
        };
        *demonstration =
            Demonstration { theta_m: theta(&experiment.theta_m), theta_f: theta(&experiment.theta_f), ..demonstration.clone() };
    }
    dataset
}

/// A listener's clock and its word on whether to go on: who listens to a run is told of that run alone.
struct Unseen<'a>(&'a dyn Progress);

impl Progress for Unseen<'_> {
    fn phase(&self, _name: &str, _steps: u64) {}

    fn advance(&self, _steps: u64) {}

    fn note(&self, _text: &str) {}

    fn elapsed_s(&self) -> f64 {
        self.0.elapsed_s()
    }

    fn may_go_on(&self) -> bool {
        self.0.may_go_on()
    }
}
