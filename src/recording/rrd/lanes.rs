//! What is the case when: coloured lanes over time.

use rerun::{Color, StateChange, StateConfiguration};

use super::entity_path::{COMPLIANCE_LANE, Entity, GRIPPER_LANE, PERSON_LANE, STATE_LANE};
use super::palette;
use super::recorder::{Fault, Recorder};
use crate::simulation::{AppliedForce, StepRecord};

/// Whether the person holds the arm.
pub(super) fn holds(record: &StepRecord) -> bool {
    record.human != AppliedForce::default()
}

/// An opening below this counts as closed, commanded or measured (0 … 1).
pub(super) const CLOSED: f64 = 0.5;

/// What a beta means, in a word.
pub(super) fn beta_in_words(beta: f64) -> &'static str {
    match beta {
        b if b < 0.0 => "complies",
        b if b > 0.0 => "minimises force",
        _ => "stiff",
    }
}

/// Its colour.
pub(super) fn beta_color(beta: f64) -> Color {
    match beta {
        b if b < 0.0 => palette::COMPLIES,
        b if b > 0.0 => palette::MINIMISES,
        _ => palette::STIFF,
    }
}

/// Logs all lanes; that of the states only for a skill that has some.
pub(super) fn log_lanes(recorder: &Recorder, records: &[StepRecord], has_states: bool) -> Result<(), Fault> {
    let lane = |entity: &Entity, value: &dyn Fn(&StepRecord) -> String, color: &dyn Fn(&StepRecord) -> Color| {
        let (mut times, mut values) = (Vec::new(), Vec::new());
        let mut legend: Vec<(String, Color)> = Vec::new();
        for record in records {
            let now = value(record);
            if values.last() == Some(&now) {
                continue;
            }
            if legend.iter().all(|(known, _)| *known != now) {
                legend.push((now.clone(), color(record)));
            }
            times.push(record.time_s);
            values.push(now);
        }
        let configuration =
            StateConfiguration::new().with_values(legend.iter().map(|l| l.0.as_str())).with_colors(legend.iter().map(|l| l.1));
        recorder.always(entity.path(), &configuration)?;
        recorder.at_times(entity.path(), &times, StateChange::new().with_state(values).columns_of_unit_batches()?)
    };
    let closed = |r: &StepRecord| r.gripper_command < CLOSED;
    let pick = |yes: bool, on: &str, off: &str| if yes { on.to_owned() } else { off.to_owned() };
    let tint = |yes: bool, on: Color| if yes { on } else { palette::IDLE };
    lane(&COMPLIANCE_LANE, &|r| beta_in_words(r.beta).to_owned(), &|r| beta_color(r.beta))?;
    if has_states {
        lane(&STATE_LANE, &|r| r.state.to_string(), &|r| shade(beta_color(r.beta), r.state))?;
    }
    lane(&PERSON_LANE, &|r| pick(holds(r), "holds", "hands off"), &|r| tint(holds(r), palette::PERSON))?;
    lane(&GRIPPER_LANE, &|r| pick(closed(r), "closed", "open"), &|r| tint(closed(r), palette::EXECUTED))
}

/// Neighbouring states of one colour, told apart by a shade.
fn shade(color: Color, state: usize) -> Color {
    let [r, g, b, a] = color.to_array();
    let darker = |c: u8| if state.is_multiple_of(2) { c } else { (f32::from(c) * 0.75) as u8 };
    Color::from_unmultiplied_rgba(darker(r), darker(g), darker(b), a)
}
