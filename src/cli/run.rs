//! `cpdmp run`: the main job, one scenario after the other.

use std::path::{Path, PathBuf};

use super::args::{Format, Global, Run};
use super::beside::beside;
use super::files;
use super::judged_run::judged_run;
use super::load::{Ready, load_all};
use super::progress::Shown;
use super::select::select;
use super::terminal::Terminal;
use super::viewer::Open;
#[cfg(feature = "rerun")]
use super::watched::Watched;
#[cfg(feature = "rerun")]
use crate::report::summary;
use crate::report::{Outcome, OutputError, RunFolder, text};
use crate::scenario::Work;

/// Runs every scenario; all are checked before the first one begins. The worst outcome counts.
pub(super) fn run(arguments: &Run, global: &Global, terminal: &Terminal) -> Outcome {
    let ready = match select(&arguments.scenarios.paths, terminal).and_then(|files| load_all(&files, global, terminal)) {
        Ok(ready) => ready,
        Err(outcome) => return outcome,
    };
    let folders: Vec<PathBuf> = ready.iter().map(|one| folder(global.out.as_deref(), ready.len(), &one.scenario.work)).collect();
    if let Some(index) = (1..folders.len()).find(|&index| folders[..index].contains(&folders[index])) {
        let (path, folder) = (ready[index].path.display(), folders[index].display());
        terminal.error(&format!(
            "error: {path} would write to {folder}, as another of these scenarios does: give it a name or seed of its own\n"
        ));
        return Outcome::Usage;
    }
    let outcomes = ready.iter().zip(&folders).map(|(one, folder)| run_one(one, folder, arguments, global, terminal));
    outcomes.max().unwrap_or(Outcome::NothingSelected)
}

fn folder(out: Option<&Path>, scenarios: usize, work: &Work) -> PathBuf {
    let own = format!("{}-{}", work.name(), work.seed());
    match out {
        Some(out) if scenarios == 1 => out.to_path_buf(),
        Some(out) => out.join(own),
        None => Path::new("runs").join(own),
    }
}

fn run_one(ready: &Ready, target: &Path, arguments: &Run, global: &Global, terminal: &Terminal) -> Outcome {
    // Whether the output can be written is known before a minute is spent on it.
    let folder = match RunFolder::open(target) {
        Ok(folder) => folder,
        Err(error) => {
            terminal.error(&format!("error: {error}\n"));
            return error.outcome();
        }
    };
    let started = std::time::SystemTime::now();
    terminal.note(&format!("{}: {}\n", ready.scenario.work.name(), ready.path.display()));
    let viewer = arguments.viewer.then(|| open_viewer(arguments, terminal)).flatten();
    let progress = Shown::new(terminal, global.timeout);
    #[cfg(feature = "rerun")]
    let progress = Watched::new(progress, &ready.scenario, folder.staging(), viewer.as_ref().map(Open::address));
    let mut run = judged_run(&ready.scenario, &progress);
    beside(&mut run, &ready.scenario, &progress);
    if global.deny_warnings {
        run.report.deny_warnings();
    }
    #[cfg(feature = "rerun")]
    let (progress, grown) = progress.end(&summary(&run.report, &ready.scenario.description));
    if !run.wants_folder() {
        drop(progress);
        match terminal.format {
            Format::Human => run.tell_refusal(terminal),
            Format::Json => terminal.result(&(run.report.to_json_line() + "\n")),
        }
        return run.report.outcome;
    }
    let warnings = run.report.warnings.clone();
    #[cfg(feature = "rerun")]
    let lost = files::write(&mut run, &ready.scenario, &folder, started, &|| grown.spare());
    #[cfg(not(feature = "rerun"))]
    let lost = files::write(&mut run, &ready.scenario, &folder, started, &|| {});
    #[cfg(feature = "rerun")]
    grown.settle();
    let unwritten = |error: OutputError| (error.outcome(), folder.in_place(&error.to_string()));
    let written = match lost.map_err(unwritten) {
        Ok(lost) => folder.finish().map(|place| (place, lost)).map_err(|error| (error.outcome(), error.to_string())),
        Err(told) => Err(told),
    };
    drop(progress);
    match terminal.format {
        Format::Human => terminal.result(&text(&run.report)),
        Format::Json => terminal.result(&(run.report.to_json_line() + "\n")),
    }
    tell_warnings(&warnings, global, terminal);
    match written {
        Ok((place, lost)) => {
            lost.iter().for_each(|what| terminal.error(&format!("error: {what}\n")));
            terminal.note(&format!("written to {}\n", place.display()));
            if let Some(Err(message)) = viewer.map(|viewer| viewer.show(&place.join("recording.rrd"))) {
                terminal.note(&format!("{message}\n"));
            }
            run.report.outcome
        }
        Err((outcome, told)) => {
            terminal.error(&format!("error: {told}\n"));
            run.report.outcome.max(outcome)
        }
    }
}

/// That there is no viewer is worth a line and no more.
fn open_viewer<'a>(arguments: &'a Run, terminal: &Terminal) -> Option<Open<'a>> {
    arguments.with.open().map_err(|message| terminal.note(&format!("{message}\n"))).ok()
}

fn tell_warnings(warnings: &[String], global: &Global, terminal: &Terminal) {
    match warnings {
        [] => {}
        _ if global.verbose > 0 => terminal.note(&format!("{}\n", warnings.join("\n"))),
        [warning] => terminal.note(&format!("{warning}\n")),
        _ => terminal.note(&format!("{} warnings: see report.json, or -v\n", warnings.len())),
    }
}
