//! What happened, in words: one line per event, in the order of time.

use rerun::TextDocument;

use super::entity_path::{EVENTS, EVENTS_SO_FAR};
use super::lanes::{CLOSED, beta_in_words, holds};
use super::recorder::{Fault, Recorder};
use super::touch_stretches::{Stretch, hard_and_deep, stretches};
use crate::simulation::{RunOutcome, StepRecord};
use crate::world::{ContactEpisode, NEAR_M, nearest_of_each};

/// Something worth a line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Event {
    pub time_s: f64,
    /// From when on a later event tells it, too (s).
    pub told_until_s: f64,
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

/// So many lines of events have room beside the scene, each of so many characters.
const LINES: usize = 8;
const CHARACTERS: usize = 54;

/// The last events until a time (s), as many as there is room for, the last one first.
fn until(events: &[Event], time_s: f64) -> String {
    let line = |event: &Event| match event.kind {
        Kind::Note => format!("{:.2} s: {}", event.time_s, event.text),
        Kind::Fault => format!("ERROR {:.2} s: {}", event.time_s, event.text),
    };
    let told = |event: &&Event| event.time_s <= time_s && time_s < event.told_until_s;
    let past: Vec<String> = events.iter().rev().filter(told).map(line).collect();
    let mut used = 0;
    let has_room = |line: &&String| {
        used += line.chars().count().div_ceil(CHARACTERS);
        used <= LINES
    };
    let mut shown: Vec<&str> = past.iter().take_while(has_room).map(String::as_str).collect();
    shown.extend((shown.len() < past.len()).then_some("earlier: see All events"));
    shown.join("\n")
}

/// The events of a run, in the order of time.
pub(super) fn events(outcome: &RunOutcome) -> Vec<Event> {
    let records = &outcome.steps;
    let mut events = Vec::new();
    let note = |time_s: f64, text: String| Event { time_s, told_until_s: f64::INFINITY, kind: Kind::Note, text };
    if let Some(first) = records.first() {
        events.push(note(first.time_s, format!("the skill starts, {}", beta_in_words(first.acting_beta()))));
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
    // What lies on something from the first step on is no event.
    let begins = |contact: &&ContactEpisode| contact.allowed && records.get(1).is_some_and(|early| contact.first_time_s > early.time_s);
    let begun = outcome.collisions.iter().filter(begins);
    events.extend(begun.map(|contact| note(contact.first_time_s, format!("{} touches {}", contact.a, contact.b))));
    let refused = outcome.collisions.iter().enumerate().filter(|(_, contact)| !contact.allowed);
    events.extend(refused.flat_map(|(index, contact)| touches(records, index, contact)));
    events.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    events
}

/// What two parts that must not touch do in a run that is over: when they begin, and when they end how hard and deep it was. Both are faults, as the
/// second takes the place of the first beside the scene.
fn touches(records: &[StepRecord], index: usize, contact: &ContactEpisode) -> Vec<Event> {
    let (a, b) = (&contact.a, &contact.b);
    let fault = |time_s: f64, text: String| Event { time_s, told_until_s: f64::INFINITY, kind: Kind::Fault, text };
    let all = stretches(records, index);
    if all.is_empty() {
        // It was after the last record.
        let how = hard_and_deep(contact.max_force_n, contact.max_depth_m);
        return vec![fault(contact.first_time_s, format!("{a} touches {b}{how}"))];
    }
    let end_s = records.last().map_or(0.0, |record| record.time_s);
    let told = |stretch: &Stretch| match stretch.hard_and_deep() {
        how if stretch.from_s == stretch.until_s => vec![fault(stretch.from_s, format!("{a} touches {b}{how}"))],
        how => {
            let (from_s, until_s) = (stretch.from_s, stretch.until_s);
            let begins = Event { told_until_s: until_s, ..fault(from_s, format!("{a} touches {b}")) };
            let over = if until_s < end_s { format!("touched {b} from {from_s:.2} s") } else { format!("touches {b} since {from_s:.2} s") };
            vec![begins, fault(until_s, format!("{a} {over}{how}"))]
        }
    };
    all.iter().flat_map(told).collect()
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
            "stiff" if now.is_over() => "the arm is stiff from here: the skill is over".to_owned(),
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
