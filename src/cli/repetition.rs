//! A run made again: as a whole, or from where its folder can take it up.

use std::path::Path;

use super::args::Phase;
use super::beginning::Beginning;
use super::files::{DEMONSTRATIONS, SKILL};
use super::judged_run::{Left, judged_run, outcome_of};
use super::recorded_run::last_hash;
use crate::check::planar_traces;
use crate::learning::{LearningError, Skill};
use crate::report::Outcome;
use crate::scenario::{Scenario, Work};
use crate::simulation::{self, DemonstrationSource, Experiment, Progress, SimulationError, WorldTrace};

/// How a run is made again.
pub(super) struct Repetition<'a> {
    /// The folder of the run.
    pub folder: &'a Path,
    /// Where to begin; what comes before it is taken from the folder.
    pub from: Option<&'a Beginning>,
    pub progress: &'a dyn Progress,
}

/// What a repetition left.
pub(super) struct Repeated {
    pub state_hash: String,
    pub traces: Vec<WorldTrace>,
}

impl Repetition<'_> {
    /// The run again, or how the command ends and why.
    pub fn of(&self, scenario: &Scenario) -> Result<Repeated, (Outcome, String)> {
        match (self.from, &scenario.work) {
            (None, _) => self.whole(scenario),
            (Some(_), Work::Arm(experiment)) => {
                let traces = self.traces(experiment).map_err(|error| (outcome_of(&error), error.to_string()))?;
                Ok(Repeated { state_hash: last_hash(&traces), traces })
            }
            (Some(_), Work::Planar(_)) => {
                Err((Outcome::Usage, "an experiment in the plane is made again as a whole: leave --from out".to_owned()))
            }
        }
    }

    fn whole(&self, scenario: &Scenario) -> Result<Repeated, (Outcome, String)> {
        let run = judged_run(scenario, self.progress);
        let (Some(left), Some(state_hash)) = (&run.left, run.report.state_hash) else {
            return Err((run.report.outcome, run.report.error.unwrap_or_else(|| "the run could not be repeated".to_owned())));
        };
        let traces = match left {
            Left::Arm(left) => left.traces.clone(),
            Left::Planar(left) => planar_traces(left, scenario.recording.hash_every_steps),
        };
        Ok(Repeated { state_hash, traces })
    }

    /// What is kept of the states of an arm's run.
    pub fn traces(&self, experiment: &Experiment) -> Result<Vec<WorldTrace>, SimulationError> {
        let run = |experiment: &Experiment| simulation::run(experiment, self.progress).map(|left| left.traces);
        match self.from {
            None => run(experiment),
            Some(Beginning::Phase(Phase::Learn)) => {
                let demonstrations = DemonstrationSource::Dataset(self.folder.join(DEMONSTRATIONS));
                run(&Experiment { demonstrations, ..experiment.clone() })
            }
            Some(Beginning::Phase(Phase::Execute)) => simulation::execute_again(experiment, &self.skill()?, self.progress),
            Some(Beginning::Snapshot(snapshot)) => simulation::resume(experiment, &self.skill()?, snapshot, self.progress),
        }
    }

    /// The skill that the run left.
    fn skill(&self) -> Result<Skill, LearningError> {
        let path = self.folder.join(SKILL);
        Skill::read(&path).map_err(|error| match error {
            LearningError::Skill(message) => LearningError::Skill(format!("{}: {message}", path.display())),
            other => other,
        })
    }
}
