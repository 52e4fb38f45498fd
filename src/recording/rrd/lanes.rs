//! What is the case when: coloured lanes over time.

use rerun::{Color, StateChange, StateConfiguration};

use super::entity_path::{COMPLIANCE_LANE, Entity, GRIPPER_LANE, PERSON_LANE, STATE_LANE};
use super::palette;
use super::recorder::{Fault, Recorder};
use crate::learning::Skill;
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
        b if b > 0.0 => "minimises force error",
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

/// What the lane of the states shows when the skill is over.
const OVER: &str = "over";

/// What a lane may show, and in which colour.
type Legend = Vec<(String, Color)>;

/// Whether a skill has the gripper both open and closed: else the lane would show one word.
fn grips(skill: &Skill) -> bool {
    let openings = skill.gripper.iter().flat_map(|gripper| &gripper.openings);
    let [closed, open] = openings.fold([false; 2], |[closed, open], opening| [closed || *opening < CLOSED, open || *opening >= CLOSED]);
    closed && open
}

/// Logs all lanes: that of the states for a skill that has some, with these betas, and that of the gripper for one that opens or closes it.
pub(super) fn log_lanes(recorder: &Recorder, records: &[StepRecord], skill: &Skill, betas: &[f64]) -> Result<(), Fault> {
    let lane = |entity: &Entity, legend: Legend, value: &dyn Fn(&StepRecord) -> String| {
        let values: Vec<String> = records.iter().map(value).collect();
        let changed = |i: &usize| *i == 0 || values[*i] != values[i - 1];
        let changes = (recorder.first()..values.len()).filter(changed).map(|i| (records[i].time_s, values[i].clone()));
        let (times, changes): (Vec<f64>, Vec<String>) = changes.unzip();
        let configuration =
            StateConfiguration::new().with_values(legend.iter().map(|l| l.0.as_str())).with_colors(legend.iter().map(|l| l.1));
        recorder.always(entity.path(), &configuration)?;
        recorder.at_times(entity.path(), &times, StateChange::new().with_state(changes).columns_of_unit_batches()?)
    };
    let of_two = |(on, color): (&str, Color), off: &str| vec![(on.to_owned(), color), (off.to_owned(), palette::IDLE)];
    let pick = |yes: bool, on: &str, off: &str| if yes { on.to_owned() } else { off.to_owned() };
    let meanings = [0.0, -1.0, 1.0].map(|beta| (beta_in_words(beta).to_owned(), beta_color(beta)));
    lane(&COMPLIANCE_LANE, meanings.to_vec(), &|r| beta_in_words(r.acting_beta()).to_owned())?;
    if !betas.is_empty() {
        let states = betas.iter().enumerate().map(|(state, beta)| (state.to_string(), shade(beta_color(*beta), state)));
        let legend = states.chain([(OVER.to_owned(), palette::IDLE)]).collect();
        lane(&STATE_LANE, legend, &|r| if r.is_over() { OVER.to_owned() } else { r.state.to_string() })?;
    }
    lane(&PERSON_LANE, of_two(("holds", palette::PERSON), "hands off"), &|r| pick(holds(r), "holds", "hands off"))?;
    if !grips(skill) {
        return Ok(());
    }
    let closed = |r: &StepRecord| r.gripper_command < CLOSED;
    lane(&GRIPPER_LANE, of_two(("closed", palette::EXECUTED), "open"), &|r| pick(closed(r), "closed", "open"))
}

/// Neighbouring states of one colour, told apart by a shade.
fn shade(color: Color, state: usize) -> Color {
    let [r, g, b, a] = color.to_array();
    let darker = |c: u8| if state.is_multiple_of(2) { c } else { (f32::from(c) * 0.75) as u8 };
    Color::from_unmultiplied_rgba(darker(r), darker(g), darker(b), a)
}
