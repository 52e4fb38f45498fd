//! `cpdmp teach`: the virtual human teaches, and the dataset is all that is left.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::{Format, Global, Teach};
use super::failure::Failure;
use super::judged_run::outcome_of;
use super::load::load_all;
use super::located::Located;
use super::progress::Shown;
use super::terminal::Terminal;
use crate::demonstration::Dataset;
use crate::report::Outcome;
use crate::scenario::Work;
use crate::simulation::{DemonstrationSource, Experiment, Setup, SimulationError, demonstrate};

/// What programs read about a dataset that was taught.
#[derive(Serialize)]
struct Taught<'a> {
    schema_version: u32,
    outcome: Outcome,
    exit_code: u8,
    scenario: &'a str,
    seed: u64,
    dataset: &'a Path,
    demonstrations: usize,
    motion: &'a [String],
    wrench: &'a [String],
    warnings: Vec<String>,
}

/// Teaches and replays all lessons of a scenario, and writes them to the new folder that `--out` names.
pub(super) fn teach(arguments: &Teach, global: &Global, terminal: &Terminal) -> Outcome {
    match taught(arguments, global, terminal) {
        Ok(outcome) => outcome,
        Err(failure) => failure.tell(terminal),
    }
}

fn taught(arguments: &Teach, global: &Global, terminal: &Terminal) -> Result<Outcome, Failure> {
    let out = free_folder(global.out.as_deref())?;
    let mut ready = match load_all(std::slice::from_ref(&arguments.scenario), global, terminal) {
        Ok(ready) => ready,
        Err(outcome) => return Ok(outcome),
    };
    let scenario = ready.pop().map(|ready| ready.scenario);
    let Some((scenario, Work::Arm(experiment))) = scenario.as_ref().map(|scenario| (scenario, &scenario.work)) else {
        let message = format!("{}: nobody teaches an arm in a [planar] experiment", arguments.scenario.display());
        return Err(Failure::new(Outcome::InvalidInput, [message]));
    };
    if let DemonstrationSource::Dataset(folder) = &experiment.demonstrations {
        let message = format!("{}: its demonstrations are read from {}", arguments.scenario.display(), folder.display());
        return Err(Failure::new(Outcome::InvalidInput, [message]));
    }
    let progress = Shown::new(terminal, global.timeout);
    let taught = lessons(experiment, &progress);
    drop(progress);
    let (dataset, warnings) = taught.map_err(|error| {
        let Located { faults, elsewhere } = Located::of(&error, scenario);
        Failure::new(outcome_of(&error), elsewhere).because(faults)
    })?;
    warnings.iter().for_each(|warning| terminal.note(&format!("warning: {warning}\n")));
    dataset.write(&out).map_err(|error| Failure::new(Outcome::OutputFailed, [error.to_string()]))?;
    let demonstrations = dataset.demonstrations.len();
    let outcome = Outcome::Passed;
    match terminal.format {
        Format::Human => terminal.result(&format!("{demonstrations} demonstrations written to {}\n", out.display())),
        Format::Json => terminal.json(&Taught {
            schema_version: 1,
            outcome,
            exit_code: outcome.exit_code(),
            scenario: &experiment.name,
            seed: experiment.seed,
            dataset: &out,
            demonstrations,
            motion: &dataset.motion,
            wrench: &dataset.wrench,
            warnings,
        }),
    }
    Ok(outcome)
}

/// The folder of the dataset, which must not hold anything: that is known before a minute is spent on teaching.
fn free_folder(out: Option<&Path>) -> Result<PathBuf, Failure> {
    let Some(out) = out else {
        return Err(Failure::new(Outcome::Usage, ["say where the demonstrations go, with --out DIR".to_owned()]));
    };
    let is_free = !out.exists() || std::fs::read_dir(out).is_ok_and(|mut entries| entries.next().is_none());
    if is_free {
        return Ok(out.to_path_buf());
    }
    Err(Failure::new(Outcome::OutputFailed, [format!("{} is there already: name a new folder", out.display())]))
}

/// The lessons, and what is odd about them.
fn lessons(experiment: &Experiment, progress: &Shown) -> Result<(Dataset, Vec<String>), SimulationError> {
    let setup = Setup::unchecked(experiment)?;
    setup.preflight(progress)?;
    let (dataset, history) = demonstrate(&setup, progress)?;
    Ok((dataset, history.warnings()))
}
