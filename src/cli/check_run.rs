//! `cpdmp check` of a stored run: its logged movement is judged again, and what it said of itself counts.

use std::path::Path;

use super::changed_scene::Ran;
use super::check_motion::{judged, movement};
use super::check_target::is_samples;
use super::files::{REPORT, STEP_LOG};
use super::progress::Clock;
use super::recorded_run::{RecordedManifest, SCENARIO, as_recorded};
use super::terminal::Terminal;
use crate::check::{Criterion, not_judged};
use crate::report::{Change, Checked, FileCode, InputFault, Outcome, RecordedReport, RunReport};
use crate::scenario::{Diagnostic, LoadOptions, Scenario, Work};

/// What a stored run is called in reports.
const KIND: &str = "run";

/// Judges the run in `folder` again.
pub(super) fn judged_again(folder: &Path, options: &LoadOptions, clock: &Clock, terminal: &Terminal) -> Checked {
    let path = folder.join(SCENARIO);
    let refused = |fault| Checked::refused(folder.display().to_string(), KIND, vec![fault], 0.0);
    let manifest = match RecordedManifest::read(folder) {
        Ok(manifest) => manifest,
        Err(message) => return refused(InputFault::of_file(&folder.join("manifest.json"), FileCode::Unreadable, message)),
    };
    if let Some(message) = manifest.edited(folder) {
        return refused(InputFault::of_file(&path, FileCode::Edited, message));
    }
    if let Some((file, message)) = manifest.altered(folder, &[REPORT, STEP_LOG]) {
        return refused(InputFault::of_file(&file, FileCode::Edited, message));
    }
    if let Some(file) = manifest.changed_inputs().find(|path| !is_samples(path)) {
        let again = format!("cpdmp run {} --out ANOTHER_FOLDER", path.display());
        let what = if file.exists() { "has changed since the run" } else { "is not where it was in the run" };
        let message = format!("it {what}, whose log tells nothing of it: restore it, or make the run again: `{again}`");
        return refused(InputFault::of_file(&file, FileCode::Edited, message));
    }
    let options = manifest.may_use(options);
    judged(folder, KIND, &path, &options, clock, terminal, |scenario| {
        let recorded = as_recorded(&path, &options);
        let ran = Ran::new(&path, recorded.as_ref());
        if let Some(fault) = ran.untold(scenario, &options) {
            return Err(vec![fault]);
        }
        let record = RecordedReport::read(folder).map_err(|fault| vec![fault])?;
        let criteria = recorded.as_ref().map_or(&[][..], |recorded| &recorded.criteria);
        let change = Change { ran: criteria, asked: &scenario.criteria, scene: ran.is_in_another_scene(scenario) };
        let (report, odd) = again(scenario, &record, folder, clock)?;
        Ok((report.with_record(&record, change), odd))
    })
}

/// What its log tells. Of a run that was cut short the log holds only the beginning, if there is one.
fn again(
    scenario: &Scenario,
    record: &RecordedReport,
    folder: &Path,
    clock: &Clock,
) -> Result<(RunReport, Vec<Diagnostic>), Vec<InputFault>> {
    let log = folder.join(STEP_LOG);
    let unjudged = |reason| not_judged(&scenario.criteria, reason);
    let nothing = |criteria: &[Criterion]| RunReport::unjudged(scenario.work.name(), scenario.work.seed(), criteria);
    let Work::Arm(experiment) = &scenario.work else {
        return Ok((nothing(&unjudged("paths in a plane are not judged again")), Vec::new()));
    };
    if record.is_whole() && (record.outcome != Outcome::OutputFailed || log.is_file()) {
        return movement(experiment, scenario, &scenario.criteria, &log, clock);
    }
    let criteria = unjudged(if record.is_whole() { "the run could not write its log" } else { "the run did not come to its end" });
    let begun = log.is_file().then(|| movement(experiment, scenario, &[], &log, clock).ok()).flatten();
    Ok(begun.map_or_else(|| (nothing(&criteria), Vec::new()), |(report, odd)| (report.with_criteria(&criteria), odd)))
}
