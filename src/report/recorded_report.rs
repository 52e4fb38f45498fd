//! What a stored run said of itself in its `report.json`, and what that means for a report that judges it again.

use std::path::Path;

use serde::Deserialize;

use super::{AnswerStatus, CriterionReport, FileCode, InputFault, Outcome, RunReport, read_regular};
use crate::check::{CriterionSpec, Expectation};

/// What a run said of itself.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct RecordedReport {
    /// How it ended.
    pub outcome: Outcome,
    /// Why it could not be finished, if it could not.
    pub error: Option<String>,
    /// Its questions and their answers; none when it could not be finished.
    pub criteria: Vec<CriterionReport>,
    /// What looked odd.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// How learning went.
    #[serde(default)]
    pub learning: Option<RecordedLearning>,
}

/// What is changed in a stored run when it is judged again.
#[derive(Clone, Copy, Debug)]
pub struct Change<'a> {
    /// What the run was asked.
    pub ran: &'a [CriterionSpec],
    /// What is asked.
    pub asked: &'a [CriterionSpec],
    /// Whether something else than the questions is changed.
    pub scene: bool,
}

/// What a run said of its learning.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct RecordedLearning {
    /// What it warned of.
    #[serde(default)]
    pub warnings: Vec<String>,
}

impl RecordedReport {
    /// Reads it from the folder of a run.
    ///
    /// # Errors
    /// When `report.json` cannot be read or is no report of a run.
    pub fn read(folder: &Path) -> Result<Self, InputFault> {
        let path = folder.join("report.json");
        let fault = |message: String| InputFault::of_file(&path, FileCode::Unreadable, message);
        let text = read_regular(&path)
            .and_then(|bytes| String::from_utf8(bytes).map_err(std::io::Error::other))
            .map_err(|error| fault(format!("how the run ended cannot be read: {error}")))?;
        serde_json::from_str(&text).map_err(|error| InputFault {
            line: Some(error.line()),
            column: Some(error.column()),
            ..fault(format!("this is no report of a run: {error}; make the run again"))
        })
    }

    /// Whether the run was executed to its end, whatever came of it.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        matches!(self.outcome, Outcome::Passed | Outcome::CriteriaNotMet | Outcome::OutputFailed)
    }
}

impl RunReport {
    /// The report of a stored run that was judged again, with what the run said of itself: where nothing was judged, its own answers stand,
    /// held against the limits that are asked for. Where `change` makes them those of another scenario there is no answer, which is as bad as a
    /// wrong one where the scenario expects one. What it warned of is told again. A run is never judged better than it was.
    #[must_use]
    pub fn with_record(mut self, record: &RecordedReport, change: Change<'_>) -> Self {
        for criterion in self.criteria.iter_mut().filter(|criterion| criterion.status == AnswerStatus::NotJudged) {
            // Of a run that was cut short there is none, and its outcome says so.
            let Some(known) = record.criteria.iter().find(|one| one.name == criterion.name) else { continue };
            match change.held(known) {
                Some(held) => *criterion = held,
                None => {
                    let reason = criterion.not_judged_because.take().unwrap_or_default();
                    let help = "run it again, or expect nothing of it (`expect=report`)";
                    criterion.not_judged_because = Some(format!("{reason}; the run's own answer is that of another scenario: {help}"));
                    (criterion.required, criterion.as_expected) = (criterion.expect != "report", false);
                }
            }
        }
        self.criteria.push(recorded_criteria(record));
        // Denied warnings end a run with criteria that were not met, and a reason.
        if record.error.is_some() || !matches!(record.outcome, Outcome::Passed | Outcome::CriteriaNotMet) {
            let ended = record.outcome.name().replace('_', " ");
            let reason = record.error.as_ref().map_or(String::new(), |error| format!(": {error}"));
            self.error = Some(format!("the run ended with \"{ended}\"{reason}"));
        }
        let learned = record.learning.iter().flat_map(|learning| &learning.warnings);
        for warning in record.warnings.iter().chain(learned) {
            if !self.warnings.contains(warning) {
                self.warnings.push(warning.clone());
            }
        }
        let judged = if self.criteria.iter().any(CriterionReport::fails) { Outcome::CriteriaNotMet } else { Outcome::Passed };
        self.end_as(judged.max(record.outcome).max(self.outcome));
        self
    }
}

impl Change<'_> {
    /// A run's own answer, held against what is asked; `None` when it is one to another question or in another scene.
    fn held(&self, known: &CriterionReport) -> Option<CriterionReport> {
        let find = |specs: &[CriterionSpec]| specs.iter().find(|spec| spec.name == known.name).cloned();
        let (ran, asked) = (find(self.ran)?, find(self.asked)?);
        if self.scene || !ran.asks_the_same(&asked) {
            return None;
        }
        let mut held = CriterionReport { status: AnswerStatus::Recorded, ..known.clone() };
        if let (true, Some(limit)) = (ran.limit() != asked.limit(), asked.limit()) {
            held.limit = Some(limit.value());
            held.margin = known.value.map(|value| limit.margin(value));
            held.passed = held.margin.is_some_and(|margin| margin >= 0.0);
            // When the value crossed another limit the run does not tell.
            held.first_failed_time_s = None;
        }
        let (expect, required) = (asked.expect.name(), asked.expect != Expectation::Report);
        held.as_expected = match asked.expect {
            Expectation::Pass => held.passed,
            Expectation::Fail => !held.passed && held.value.is_some(),
            Expectation::Report => true,
        };
        (held.expect, held.required) = (expect.into(), required);
        Some(held)
    }
}

/// How many of the run's own criteria were not as expected when it ran.
fn recorded_criteria(record: &RecordedReport) -> CriterionReport {
    let failed = record.criteria.iter().filter(|criterion| criterion.fails()).count();
    CriterionReport {
        name: "recorded_criteria".to_owned(),
        required: true,
        expect: "pass".into(),
        passed: failed == 0,
        as_expected: failed == 0,
        value: Some(failed as f64),
        limit: Some(0.0),
        unit: "criteria".into(),
        margin: Some(-(failed as f64)),
        first_failed_time_s: None,
        place: None,
        status: AnswerStatus::Recorded,
        not_judged_because: None,
    }
}
