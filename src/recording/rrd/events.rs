//! What happened, in words: one line per event, in the order of time.

use rerun::TextDocument;

use super::entity_path::{EVENTS, EVENTS_SO_FAR};
use super::lanes::{CLOSED, beta_in_words, holds};
use super::recorder::{Fault, Recorder};
use crate::simulation::{RunOutcome, StepRecord};
use crate::world::{NEAR_M, nearest_of_each};

/// Something worth a line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Event {
    pub time_s: f64,
    pub kind: Kind,
    pub text: String,
}

/// How much attention it deserves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Note,
    Fault,
}

/// Logs the events of a run that come after `after_s` (s), or all of them.
pub(super) fn log_events(recorder: &Recorder, outcome: &RunOutcome, after_s: Option<f64>) -> Result<(), Fault> {
    let all = events(outcome);
    let events: Vec<&Event> = all.iter().filter(|event| after_s.is_none_or(|after_s| event.time_s > after_s)).collect();
    let times: Vec<f64> = events.iter().map(|event| event.time_s).collect();
    let level = |event: &&Event| match event.kind {
        Kind::Note => rerun::TextLogLevel::INFO,
        Kind::Fault => rerun::TextLogLevel::ERROR,
    };
    let log = rerun::TextLog::update_fields()
        .with_many_text(events.iter().map(|event| format!("{:.2} s: {}", event.time_s, event.text)))
        .with_many_level(events.iter().map(level));
    recorder.at_times(EVENTS.path(), &times, log.columns_of_unit_batches()?)?;
    log_so_far(recorder, &all, after_s)
}

/// Logs of each moment in which something happens what has happened until then: beside a scene the viewer's own list shows what is to come, too.
fn log_so_far(recorder: &Recorder, events: &[Event], after_s: Option<f64>) -> Result<(), Fault> {
    let mut times: Vec<f64> = events.iter().map(|event| event.time_s).collect();
    times.dedup();
    times.retain(|time_s| after_s.is_none_or(|after_s| *time_s > after_s));
    let pages = TextDocument::update_fields().with_many_text(times.iter().map(|time_s| until(events, *time_s)));
    recorder.at_times(EVENTS_SO_FAR.path(), &times, pages.columns_of_unit_batches()?)
}

/// The events until a time (s), a line each, the last one first.
fn until(events: &[Event], time_s: f64) -> String {
    let line = |event: &Event| match event.kind {
        Kind::Note => format!("{:.2} s: {}", event.time_s, event.text),
        Kind::Fault => format!("ERROR {:.2} s: {}", event.time_s, event.text),
    };
    events.iter().rev().filter(|event| event.time_s <= time_s).map(line).collect::<Vec<_>>().join("\n")
}

/// The events of a run, in the order of time.
pub(super) fn events(outcome: &RunOutcome) -> Vec<Event> {
    let records = &outcome.steps;
    let mut events = Vec::new();
    let note = |time_s: f64, text: String| Event { time_s, kind: Kind::Note, text };
    if let Some(first) = records.first() {
        events.push(note(first.time_s, format!("the skill starts, {}", beta_in_words(first.beta))));
    }
    for pair in records.windows(2) {
        let (before, now) = (&pair[0], &pair[1]);
        events.extend(changes(before, now).into_iter().map(|text| note(now.time_s, text)));
        if holds(before) && !holds(now) {
            events.push(note(now.time_s, format!("the person lets go (peak {:.1} N)", peak_of_hold(records, before.step))));
        }
    }
    for clearance in nearest_of_each(&outcome.clearances).into_iter().filter(|c| c.min_distance_m < NEAR_M) {
        let text = format!("closest to {}: {} at {:.0} mm", clearance.b, clearance.a, clearance.min_distance_m * 1e3);
        events.push(note(clearance.time_s, text));
    }
    for contact in outcome.collisions.iter().filter(|contact| !contact.allowed) {
        let text = format!("{} touches {}{}", contact.a, contact.b, hard_and_deep(contact.max_force_n, contact.max_depth_m));
        events.push(Event { time_s: contact.first_time_s, kind: Kind::Fault, text });
    }
    events.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    events
}

/// Depths below this (m) would be written as nothing.
const LEAST_DEPTH_M: f64 = 0.05e-3;

/// How hard something touches (N), and how deep (m), as far as it is known.
pub(super) fn hard_and_deep(force_n: f64, depth_m: f64) -> String {
    let force = (!force_n.is_nan()).then(|| format!("up to {force_n:.1} N"));
    let depth = (depth_m >= LEAST_DEPTH_M).then(|| format!("{:.1} mm deep", depth_m * 1e3));
    let known: Vec<String> = force.into_iter().chain(depth).collect();
    if known.is_empty() { String::new() } else { format!(": {}", known.join(", ")) }
}

/// What differs between two neighbouring records.
fn changes(before: &StepRecord, now: &StepRecord) -> Vec<String> {
    let mut texts = Vec::new();
    match (before.gripper_command < CLOSED, now.gripper_command < CLOSED) {
        (false, true) => texts.push("the gripper closes".into()),
        (true, false) => texts.push("the gripper opens".into()),
        _ => {}
    }
    if holds(now) && !holds(before) {
        texts.push("the person takes hold".into());
    }
    if before.time_fraction < 1.0 && now.time_fraction >= 1.0 {
        texts.push("the skill ends".into());
    }
    if before.acting_beta() != now.acting_beta() {
        texts.push(match beta_in_words(now.acting_beta()) {
            "complies" => format!("the arm complies from here (state {})", now.state),
            "stiff" => format!("the arm is stiff from here (state {})", now.state),
            other => format!("the arm {other} from here (state {})", now.state),
        });
    }
    texts
}

/// The largest force of the hold that ended at `step` (N).
fn peak_of_hold(records: &[StepRecord], step: u64) -> f64 {
    let until = records.iter().rev().skip_while(|record| record.step > step);
    until.take_while(|record| holds(record)).map(|record| record.human.force.norm()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::hard_and_deep;

    #[test]
    fn a_depth_that_would_be_written_as_nothing_is_not_written() {
        assert_eq!(hard_and_deep(401.3, 0.04e-3), ": up to 401.3 N");
        assert_eq!(hard_and_deep(243.0, 2.4e-3), ": up to 243.0 N, 2.4 mm deep");
        assert_eq!(hard_and_deep(f64::NAN, 0.06e-3), ": 0.1 mm deep");
        assert_eq!(hard_and_deep(f64::NAN, 0.0), "");
    }
}
