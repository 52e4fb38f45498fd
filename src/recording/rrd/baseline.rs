//! The counterfactual beside a run: where the way of plain DMPs by locally weighted regression would lead, learned from the same
//! demonstrations. They are not told the parameters; what a run with them does is another scenario's to show.

use super::dashes::{Dashes, Slot};
use super::entity_path::BASELINE_PATH;
use super::palette;
use super::path::Path;
use super::recorder::{Fault, Recorder, Since};
use crate::demonstration::Trajectory;
use crate::learning::{ExecutionSettings, LearningError, LearningSettings, ShapingKind, generate, learn};
use crate::simulation::{Experiment, MotionSpace, RunOutcome};

/// Samples of the path.
const SAMPLES: usize = 280;

/// Whether there is something to compare: the skill is told what the baseline is not.
pub(super) fn compares(experiment: &Experiment) -> bool {
    experiment.learning.shaping != ShapingKind::Lwr && !experiment.theta_m.is_empty() && experiment.space == MotionSpace::Task
}

/// Logs the path in dashes: nothing else is beside the run where it is shown.
pub(super) fn log_baseline(recorder: &Recorder, experiment: &Experiment, outcome: &RunOutcome, dashes: &Dashes) -> Result<(), Fault> {
    // Demonstrations that the baseline cannot learn from have none, and the run stands without it.
    let Ok(way) = plan(experiment, outcome) else { return Ok(()) };
    let Some(places) = Path::new(&way, way.duration_s()).places() else { return Ok(()) };
    recorder.from(Since::Start, BASELINE_PATH.path(), &dashes.whole(&places, Slot::Other(0)).with_colors([palette::BASELINE]))
}

/// What the baseline generates in the setting of `experiment`.
fn plan(experiment: &Experiment, outcome: &RunOutcome) -> Result<Trajectory, LearningError> {
    let settings = LearningSettings { shaping: ShapingKind::Lwr, ..experiment.learning.clone() };
    let baseline = learn(&outcome.dataset, &settings, experiment.seed)?;
    // A skill without states has none that could comply.
    let question = ExecutionSettings { coupling: Default::default(), ..experiment.question() };
    generate(&baseline.skill, &question, outcome.plan.duration_s() / SAMPLES as f64, 1.0)
}
