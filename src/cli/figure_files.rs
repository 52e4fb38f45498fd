//! Figures as files.

use std::fs;
use std::path::{Path, PathBuf};

use crate::figure::{ArmRun, Figure, arm_compliance, arm_forces, arm_forcing, arm_motion, arm_paths, arm_settings, arm_states, svg};
use crate::learning::LearningError;
use crate::palette::meaning;
use crate::report::{OutputError, write_file};
use crate::simulation::{Experiment, RunOutcome};

/// A figure and the name of its files, without what follows the dot.
pub(super) type Named = (&'static str, Figure);

/// The figures of an arm's run. Those that a skill has nothing for, such as states of one without states, are left out.
pub(super) fn of_arm(run: &ArmRun) -> Result<Vec<Named>, LearningError> {
    let mut figures =
        vec![("motion", arm_motion(run)), ("compliance", arm_compliance(run)), ("forces", arm_forces(run)), ("forcing", arm_forcing(run)?)];
    figures.extend(arm_paths(run).map(|figure| ("paths", figure)));
    figures.extend(arm_settings(run)?.map(|figure| ("forcing_settings", figure)));
    figures.extend(arm_states(run)?.map(|figure| ("states", figure)));
    Ok(figures)
}

/// The run that was just carried out, for drawing.
pub(super) fn arm_run<'a>(experiment: &'a Experiment, left: &'a RunOutcome) -> Result<ArmRun<'a>, LearningError> {
    let learned = (&left.skill, &left.dataset, &experiment.learning);
    let run = ArmRun::new(title(&experiment.name, experiment.seed), &left.steps, learned, experiment.question())?;
    let colors = meaning::beside(left.beside.iter().map(|one| one.difference));
    let others = left.beside.iter().zip(colors).map(|(one, (color, _))| (one.name.as_str(), color, &one.outcome.steps[..])).collect();
    Ok(run.in_scene(&experiment.objects, &experiment.parameters).beside(others))
}

/// What the figures of a run are called.
pub(super) fn title(name: &str, seed: u64) -> String {
    format!("{name}, seed {seed}")
}

/// What a figure is written as: a drawing and, with the feature `png`, a picture.
const KINDS: &[&str] = if cfg!(feature = "png") { &["svg", "png"] } else { &["svg"] };

/// The names of the files of some figures.
pub(super) fn names(figures: &[Named]) -> Vec<String> {
    figures.iter().flat_map(|(name, _)| KINDS.iter().map(move |kind| format!("{name}.{kind}"))).collect()
}

/// Writes figures into a folder that is made when it is not there. Returns what could not be drawn or written.
pub(super) fn draw(figures: &[Named], folder: &Path) -> Vec<String> {
    if let Err(error) = fs::create_dir_all(folder) {
        return vec![format!("{}: {error}", folder.display())];
    }
    let written = |(name, figure): &Named| -> Result<(), String> {
        let drawing = svg(figure).map_err(|error| error.to_string())?;
        replace(&folder.join(format!("{name}.svg")), drawing.as_bytes()).map_err(|error| error.to_string())?;
        #[cfg(feature = "png")]
        let picture = crate::figure::png(&drawing).map_err(|error| error.to_string())?;
        #[cfg(feature = "png")]
        replace(&folder.join(format!("{name}.png")), &picture).map_err(|error| error.to_string())?;
        Ok(())
    };
    figures.iter().filter_map(|figure| written(figure).err()).collect()
}

/// The same, all of them or none, with what went wrong in one sentence.
pub(super) fn drawn(figures: &[Named], folder: &Path) -> Result<(), String> {
    let failures = draw(figures, folder);
    failures.first().map_or(Ok(()), |first| Err(format!("{} (all figures): {first}", folder.display())))
}

/// Writes a file beside its place and renames it: there is never half a figure.
fn replace(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    let beside: PathBuf = path.with_added_extension("partial");
    write_file(&beside, content).map_err(|error| match error {
        OutputError::Io { source, .. } => OutputError::Io { path: path.to_path_buf(), source },
        other => other,
    })?;
    fs::rename(&beside, path).map_err(|source| OutputError::Io { path: path.to_path_buf(), source })
}
