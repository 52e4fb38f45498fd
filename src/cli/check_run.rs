//! `cpdmp check` of a stored run: its logged movement is judged again, and what it said of itself counts.

use std::path::Path;

use super::check_motion::{judged, movement, whole_file};
use super::recorded_run::RecordedManifest;
use super::terminal::Terminal;
use crate::check::{Criterion, not_judged};
use crate::report::{Checked, InputFault, Outcome, RecordedReport, RunReport};
use crate::scenario::{LoadOptions, Scenario, Work};

/// What a stored run is called in reports.
const KIND: &str = "run";

/// The log of a run, whose movement is judged.
const STEP_LOG: &str = "steps.parquet";

/// Judges the run in `folder` again; `changed` says whether the options make its scenario another one.
pub(super) fn judged_again(folder: &Path, changed: bool, options: &LoadOptions, terminal: &Terminal) -> Checked {
    let options = match RecordedManifest::read(folder) {
        Ok(manifest) => manifest.may_use(options),
        Err(message) => {
            let fault = whole_file(&folder.join("manifest.json"), "unreadable", message);
            return Checked::refused(folder.display().to_string(), KIND, vec![fault], 0.0);
        }
    };
    judged(folder, KIND, &folder.join("scenario.toml"), &options, terminal, |scenario| {
        let record = RecordedReport::read(folder).map_err(|fault| vec![fault])?;
        Ok(again(scenario, &record, folder)?.with_record(&record, changed))
    })
}

/// What its log tells. Of a run that was cut short the log holds only the beginning, if there is one.
fn again(scenario: &Scenario, record: &RecordedReport, folder: &Path) -> Result<RunReport, Vec<InputFault>> {
    let log = folder.join(STEP_LOG);
    let unjudged = |reason| not_judged(&scenario.criteria, reason);
    let nothing = |criteria: &[Criterion]| RunReport::unjudged(scenario.work.name(), scenario.work.seed(), criteria);
    let Work::Arm(experiment) = &scenario.work else {
        return Ok(nothing(&unjudged("paths in a plane are not judged again")));
    };
    if record.is_whole() && (record.outcome != Outcome::OutputFailed || log.is_file()) {
        return movement(experiment, scenario, &scenario.criteria, &log);
    }
    let criteria = unjudged(if record.is_whole() { "the run could not write its log" } else { "the run did not come to its end" });
    let begun = log.is_file().then(|| movement(experiment, scenario, &[], &log).ok()).flatten();
    Ok(begun.map_or_else(|| nothing(&criteria), |report| report.with_criteria(&criteria)))
}
