//! Why a criterion or a contact is not as it should be, in one sentence that every format shares.

use super::table::figure;
use super::{AnswerStatus, CollisionReport, CriterionReport};

/// The criterion's answer: `0.0187 m, limit 0.005 m, margin +0.0137 m`; or why there is none.
pub(super) fn numbers(criterion: &CriterionReport) -> String {
    if let Some(reason) = &criterion.not_judged_because {
        return format!("not judged: {reason}");
    }
    let unit = if criterion.unit == "1" { String::new() } else { format!(" {}", criterion.unit) };
    let with_unit = |number: Option<f64>| number.map_or("no answer".to_owned(), |number| format!("{}{unit}", figure(number)));
    let sign = |number: f64| if number < 0.0 { "" } else { "+" };
    let margin = criterion.margin.map_or(String::new(), |number| format!(", margin {}{}{unit}", sign(number), figure(number)));
    let whose = if criterion.status == AnswerStatus::Recorded { " (as the run recorded it)" } else { "" };
    format!("{}, limit {}{margin}{whose}", with_unit(criterion.value), with_unit(criterion.limit))
}

/// What is said of a criterion that is required and holds.
pub(super) const OK: &str = "ok";

/// Whether the criterion is as it should be, in a few words.
pub(super) fn words(criterion: &CriterionReport) -> String {
    let failed_at = criterion.first_failed_time_s.map_or(String::new(), |time| format!(" at {time:.2} s"));
    match (criterion.as_expected, criterion.required, criterion.passed) {
        (true, true, true) => OK.to_owned(),
        (true, true, false) => format!("ok: fails{failed_at}, as expected"),
        (_, false, true) => "holds".to_owned(),
        (_, false, false) => format!("does not hold{failed_at}"),
        (false, true, false) => format!("FAILED{failed_at}"),
        (false, true, true) => "FAILED: holds, but should not".to_owned(),
    }
}

/// What is said of a required criterion without an answer.
const NO_ANSWER: &str = "has no answer: what it asks about never happened, or not for long enough, or is a distance of two things of which \
                         neither can move, or of one that is not there";

/// Why the criterion is not as expected.
pub(super) fn reason(criterion: &CriterionReport) -> String {
    if criterion.not_judged_because.is_some() {
        return numbers(criterion);
    }
    let found = match (criterion.passed, criterion.value) {
        (true, _) => "holds, but should not".to_owned(),
        (false, None) => NO_ANSWER.to_owned(),
        (false, Some(_)) => criterion.first_failed_time_s.map_or("fails".to_owned(), |time| format!("fails first at {time:.3} s")),
    };
    format!("{found}: {}", numbers(criterion))
}

/// The contact: who, when, how deep and where, how hard.
pub(super) fn contact(contact: &CollisionReport) -> String {
    let [x, y, z] = contact.deepest_point_m;
    format!(
        "{} - {}  {:.3} … {:.3} s, {:.2} mm deep at [{x:.4}, {y:.4}, {z:.4}] m at {:.3} s, {}",
        contact.a,
        contact.b,
        contact.first_time_s,
        contact.last_time_s,
        contact.max_depth_m * 1e3,
        contact.deepest_time_s,
        contact.max_force_n.map_or("force not measured".to_owned(), |force| format!("{force:.1} N"))
    )
}

/// Why the contact is allowed, and where that stands: `the scenario allows it (allowed_contact.leaning, a.toml:12:8)`.
pub(super) fn permission(contact: &CollisionReport) -> String {
    let place = contact.reason_place.as_ref().map(|place| format!("{}:{}:{}", place.file, place.line, place.column));
    let said: Vec<String> = contact.reason_key.iter().cloned().chain(place).collect();
    let said = if said.is_empty() { String::new() } else { format!(" ({})", said.join(", ")) };
    format!("{}{said}", contact.reason.unwrap_or("not allowed"))
}
