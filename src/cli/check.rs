//! `cpdmp check`: runs without recording or display and judges, for continuous integrations.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::args::{Check, Global, Printed};
use super::check_motion::judged_trajectory;
use super::check_run::judged_again;
use super::check_target::{Target, targets};
use super::global_flags::command_of;
use super::judged_run::judged_run;
use super::load::options;
use super::progress::Clock;
use super::terminal::Terminal;
use crate::report::{
    CheckReport, Checked, InputFault, Outcome, OutputError, Replaceable, check_text, followed, github, junit, junit_without_verdict,
    lock_beside, remove_file, replace_file,
};
use crate::scenario::{Diagnostic, LoadOptions, Scenario, Severity};
use crate::simulation::Progress;

/// Checks everything that the arguments name, on all cores. One that cannot be run does not keep the others from being checked; the worst
/// outcome counts.
pub(super) fn check(arguments: &Check, global: &Global, terminal: &Terminal) -> Outcome {
    if let Some(device) = arguments.junit.as_deref().filter(|path| is_device(path)) {
        let device = device.display();
        terminal.error(&format!("error: --junit {device}: it is no file that a verdict could be kept in; --format junit prints it\n"));
        return Outcome::Usage;
    }
    // Whether the verdict can be written is known before minutes are spent on it; and until it is written, an earlier one does not stand for it.
    let lock = arguments.junit.as_deref().map(|path| lock_beside(&followed(path))).transpose();
    // Where not even that can be written, no earlier verdict is better than one that is wrong.
    let without = |error: &OutputError| {
        if let (Some(path), OutputError::Io { .. }) = (&arguments.junit, error) {
            remove_file(path, Replaceable::Junit);
        }
        not_written(error, terminal)
    };
    let _held_until_the_end = match lock {
        Ok(lock) => lock,
        Err(error) => return without(&error),
    };
    let write = |text: &str| arguments.junit.as_deref().map_or(Ok(()), |path| replace_file(path, text.as_bytes(), Replaceable::Junit));
    if let Err(error) = write(&junit_without_verdict()) {
        return without(&error);
    }
    let targets = match targets(arguments, terminal) {
        Ok(targets) => targets,
        Err(outcome) => return outcome,
    };
    let clock = Clock::start();
    let options = options(global);
    let checks = targets.par_iter().map(|target| {
        let checked = match target {
            Target::Scenario(path) => simulated(path, &options, global, terminal),
            Target::Run(run) => judged_again(run, &options, &Clock::with_limit(global.timeout), terminal),
            Target::Trajectory(path, scene) => judged_trajectory(path, scene, &options, &Clock::with_limit(global.timeout), terminal),
        };
        terminal.note(&format!("{}: {} ({:.1} s)\n", checked.path, checked.outcome.name().replace('_', " "), checked.wall_s));
        checked
    });
    let report = CheckReport::of(checks.collect(), clock.elapsed_s());
    tell(&report, global, terminal);
    write(&junit(&report)).map_or_else(|error| report.outcome.max(not_written(&error, terminal)), |()| report.outcome)
}

/// An earlier verdict does not stand for a check whose command line made no sense, which nobody has read to its end: the files that follow
/// `--junit` say so from here on, if there are any. `words` are those after the program's name.
pub(super) fn withdraw_verdict(words: impl Iterator<Item = OsString>) {
    let words: Vec<OsString> = words.collect();
    if command_of(&words) != Some("check") {
        return;
    }
    let attached = words.iter().filter_map(|word| word.to_str()?.strip_prefix("--junit=").map(PathBuf::from));
    let after = words.windows(2).filter(|pair| pair[0] == "--junit").map(|pair| PathBuf::from(&pair[1]));
    for file in attached.chain(after).filter(|file| file.is_file()) {
        // What is no JUnit is left alone.
        if replace_file(&file, junit_without_verdict().as_bytes(), Replaceable::Junit).is_err() {
            remove_file(&file, Replaceable::Junit);
        }
    }
}

/// A pipe, a terminal, or what the program writes its results to, by whatever name: a verdict could not be replaced there.
fn is_device(path: &Path) -> bool {
    let Ok(about) = path.metadata() else { return false };
    (!about.is_file() && !about.is_dir()) || is_standard_stream(&about)
}

#[cfg(unix)]
fn is_standard_stream(about: &std::fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    let streams = ["/dev/stdout", "/dev/stderr"].into_iter().filter_map(|stream| std::fs::metadata(stream).ok());
    streams.into_iter().any(|stream| (stream.dev(), stream.ino()) == (about.dev(), about.ino()))
}

#[cfg(not(unix))]
fn is_standard_stream(_: &std::fs::Metadata) -> bool {
    false
}

fn not_written(error: &OutputError, terminal: &Terminal) -> Outcome {
    terminal.error(&format!("error: {error}\n"));
    error.outcome()
}

fn simulated(path: &Path, options: &LoadOptions, global: &Global, terminal: &Terminal) -> Checked {
    let clock = Clock::with_limit(global.timeout);
    let name = path.display().to_string();
    match Scenario::load_with_sweep(path, options) {
        Err(invalid) => {
            terminal.faults(&invalid.0);
            Checked::refused(name, "scenario", faults(&invalid.0), clock.elapsed_s())
        }
        Ok(scenario) => {
            let mut run = judged_run(&scenario, &clock);
            run.report.warnings().for_each(|warning| terminal.note(&format!("{name}: warning: {warning}\n")));
            if global.deny_warnings {
                run.report.deny_warnings();
            }
            let warnings = [faults(&scenario.warnings), faults(&run.odd)].concat();
            if run.report.outcome == Outcome::InvalidInput && !run.refusal.is_empty() {
                terminal.faults(&run.refusal.faults);
                return Checked::refused(name, "scenario", [run.refusal.for_report(path), warnings].concat(), clock.elapsed_s());
            }
            Checked::judged(name, "scenario", run.report, warnings, clock.elapsed_s())
        }
    }
}

/// The faults of a scenario for the report.
pub(super) fn faults(diagnostics: &[Diagnostic]) -> Vec<InputFault> {
    let fault = |found: &Diagnostic| InputFault {
        code: found.code.describe().0.to_owned(),
        warning: found.severity == Severity::Warning,
        file: found.file.clone(),
        line: found.line,
        column: found.column,
        message: told(found),
    };
    diagnostics.iter().map(fault).collect()
}

/// What is wrong, what was expected, and how to mend it.
fn told(found: &Diagnostic) -> String {
    let expected = found.expected.as_ref().map(|expected| format!("expected {expected}"));
    let parts = [Some(found.message.clone()), expected, found.help.clone()];
    parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
}

fn tell(report: &CheckReport, global: &Global, terminal: &Terminal) {
    match global.format {
        Printed::Human => terminal.result(&check_text(report, global.verbose > 0)),
        Printed::Json => terminal.json(report),
        Printed::Junit => terminal.result(&junit(report)),
        Printed::Github => terminal.result(&github(report)),
    }
}
