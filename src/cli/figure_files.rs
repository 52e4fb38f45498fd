//! Figures as files.

use std::fs;
use std::path::{Path, PathBuf};

use crate::figure::{ArmRun, Figure, arm_compliance, arm_forcing, arm_motion, arm_paths, arm_settings, arm_states, svg};
use crate::learning::LearningError;
use crate::report::{OutputError, write_file};
use crate::simulation::{Experiment, RunOutcome};

/// A figure and the name of its file.
pub(super) type Named = (&'static str, Figure);

/// The figures of an arm's run. Those that a skill has nothing for, such as states of one without states, are left out.
pub(super) fn of_arm(run: &ArmRun) -> Result<Vec<Named>, LearningError> {
    let mut figures = vec![("motion.svg", arm_motion(run)), ("compliance.svg", arm_compliance(run)), ("forcing.svg", arm_forcing(run)?)];
    figures.extend(arm_paths(run).map(|figure| ("paths.svg", figure)));
    figures.extend(arm_settings(run)?.map(|figure| ("forcing_settings.svg", figure)));
    figures.extend(arm_states(run)?.map(|figure| ("states.svg", figure)));
    Ok(figures)
}

/// The run that was just carried out, for drawing.
pub(super) fn arm_run<'a>(experiment: &'a Experiment, left: &'a RunOutcome) -> Result<ArmRun<'a>, LearningError> {
    let learned = (&left.skill, &left.dataset, &experiment.learning);
    let run = ArmRun::new(title(&experiment.name, experiment.seed), &left.steps, learned, experiment.question())?;
    Ok(run.in_scene(&experiment.objects, &experiment.parameters))
}

/// What the figures of a run are called.
pub(super) fn title(name: &str, seed: u64) -> String {
    format!("{name}, seed {seed}")
}

/// Writes figures into a folder that is made when it is not there. Returns what could not be drawn or written.
pub(super) fn draw(figures: &[Named], folder: &Path) -> Vec<String> {
    if let Err(error) = fs::create_dir_all(folder) {
        return vec![format!("{}: {error}", folder.display())];
    }
    let written = |(name, figure): &Named| -> Result<(), String> {
        let document = svg(figure).map_err(|error| error.to_string())?;
        replace(&folder.join(name), &document).map_err(|error| error.to_string())
    };
    figures.iter().filter_map(|figure| written(figure).err()).collect()
}

/// Writes a file beside its place and renames it: there is never half a figure.
fn replace(path: &Path, document: &str) -> Result<(), OutputError> {
    let beside: PathBuf = path.with_extension("svg.partial");
    write_file(&beside, document)?;
    fs::rename(&beside, path).map_err(|source| OutputError::Io { path: path.to_path_buf(), source })
}
