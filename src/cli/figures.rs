//! `cpdmp figures`: draws the figures of a run again, from what its folder holds.

use std::path::Path;

use serde::Serialize;

use super::args::{Format, Global};
use super::failure::Failure;
use super::figure_files::{Named, draw, names, of_arm, title};
use super::files::{BESIDE, DEMONSTRATIONS, SKILL, STEP_LOG};
use super::learn::read_skill;
use super::load::options;
use super::planar_files;
use super::recorded_run::{RecordedManifest, SCENARIO};
use super::terminal::Terminal;
use crate::demonstration::Dataset;
use crate::figure::ArmRun;
use crate::palette::{Rgb, meaning};
use crate::recording::read_step_log;
use crate::report::Outcome;
use crate::scenario::{LoadOptions, PlanarRun, Scenario, Work};
use crate::simulation::{Experiment, StepRecord, Variation};

/// What programs read.
#[derive(Serialize)]
struct Drawn<'a> {
    schema_version: u32,
    folder: &'a Path,
    figures: Vec<String>,
}

/// Draws the figures of the run in `folder` into its `figures/`, or into `--out`.
pub(super) fn figures(folder: &Path, global: &Global, terminal: &Terminal) -> Outcome {
    let figures = match of_folder(folder, global, terminal) {
        Ok(figures) => figures,
        Err(failure) => return failure.tell(terminal),
    };
    let place = global.out.clone().unwrap_or_else(|| folder.join("figures"));
    let failures = draw(&figures, &place);
    if !failures.is_empty() {
        return Failure::new(Outcome::OutputFailed, failures).tell(terminal);
    }
    let names = names(&figures);
    match terminal.format {
        Format::Json => terminal.json(&Drawn { schema_version: 1, folder: &place, figures: names }),
        Format::Human => names.iter().for_each(|name| terminal.result(&format!("{}\n", place.join(name).display()))),
    }
    Outcome::Passed
}

fn of_folder(folder: &Path, global: &Global, terminal: &Terminal) -> Result<Vec<Named>, Failure> {
    let invalid = |message| Failure::new(Outcome::InvalidInput, [message]);
    let manifest = RecordedManifest::read(folder).map_err(invalid)?;
    if let Some(edited) = manifest.edited(folder) {
        return Err(invalid(format!("{}: {edited}", folder.join(SCENARIO).display())));
    }
    // Files of several runs would be drawn as one that never was.
    if let Some((path, altered)) = manifest.altered(folder, &[STEP_LOG, BESIDE, SKILL, DEMONSTRATIONS]) {
        return Err(invalid(format!("{}: {altered}", path.display())));
    }
    // The run is drawn as it was: what would change it is not asked for.
    let asked = LoadOptions { asset_roots: options(global).asset_roots, ..LoadOptions::default() };
    let scenario = Scenario::load(&folder.join(SCENARIO), &asked)?;
    match &scenario.work {
        Work::Arm(experiment) => stored_arm(folder, experiment, &scenario.beside, terminal),
        Work::Planar(run) => repeated_plane(folder, run),
    }
}

fn stored_arm(folder: &Path, experiment: &Experiment, beside: &[Variation], terminal: &Terminal) -> Result<Vec<Named>, Failure> {
    let steps = read(&folder.join(STEP_LOG))?;
    let places = beside.iter().map(|one| (one, folder.join(BESIDE).join(format!("{}.parquet", one.name))));
    let (there, missing): (Vec<_>, Vec<_>) = places.partition(|(_, place)| place.is_file());
    // What could not be executed beside the run left nothing, and has no colour.
    for (one, place) in missing {
        terminal.note(&format!("the run left no {}: its figures are drawn without `{}`\n", place.display(), one.name));
    }
    let colors = meaning::beside(there.iter().map(|(one, _)| one.difference(experiment)));
    let with_steps = there.iter().zip(colors).map(|((one, place), (color, _))| Ok((one.name.as_str(), color, read(place)?)));
    let others: Vec<(&str, Rgb, Vec<StepRecord>)> = with_steps.collect::<Result<_, Failure>>()?;
    let path = folder.join(SKILL);
    let skill = read_skill(&path)?;
    let place = folder.join(DEMONSTRATIONS);
    let dataset = Dataset::read(&place).map_err(|error| Failure::of_data(&place, &error))?;
    let learned = (&skill, &dataset, &experiment.learning);
    let run = ArmRun::new(title(&experiment.name, experiment.seed), &steps, learned, experiment.question());
    let others = others.iter().map(|(name, color, steps)| (*name, *color, &steps[..])).collect();
    run.and_then(|run| of_arm(&run.in_scene(&experiment.objects, &experiment.parameters).beside(others)))
        .map_err(|error| Failure::of_learning(&path, &error))
}

fn read(steps: &Path) -> Result<Vec<StepRecord>, Failure> {
    read_step_log(steps).map_err(|error| Failure::new(Outcome::InvalidInput, [error.to_string()]))
}

/// A planar experiment takes seconds, and its scenario decides every bit of it.
fn repeated_plane(folder: &Path, run: &PlanarRun) -> Result<Vec<Named>, Failure> {
    let left = run.run(&|| true).map_err(|error| Failure::of_learning(folder, &error))?;
    Ok(planar_files::figures(&run.name, &left))
}
