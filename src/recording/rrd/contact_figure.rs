//! What touches, and what nearly does.

use rerun::{EntityPath, LineStrips3D, Points3D};

use super::camera::Camera;
use super::convert;
use super::entity_path::{CONTACT, FORBIDDEN, FORBIDDEN_LABEL, NEAREST, NEAREST_LABEL};
use super::events::hard_and_deep;
use super::palette;
use super::recorder::{Fault, Recorder};
use crate::simulation::RunOutcome;
use crate::world::{Clearance, ContactEpisode, NEAR_M, TouchPoint, nearest_of_each};

/// A smallest distance is shown from so long before it to so long after it, and a touch that must not be for so long after its end (s): most are
/// over before they could be seen.
const BEFORE_S: f64 = 0.4;
const AFTER_S: f64 = 0.8;

/// Radius of what touches, and of what must not, seen from far (m).
const TOUCH_M: f64 = 0.006;
const FAULT_M: f64 = 0.016;

/// Logs contacts, and smallest distances that are near ones, when they happen, in words above those of the active state.
pub(super) fn log_contacts(recorder: &Recorder, outcome: &RunOutcome, camera: &Camera) -> Result<(), Fault> {
    log_touches(recorder, outcome, camera)?;
    let near: Vec<_> = nearest_of_each(&outcome.clearances).into_iter().filter(|clearance| clearance.min_distance_m < NEAR_M).collect();
    let faults: Vec<_> = outcome.collisions.iter().filter(|contact| !contact.allowed).collect();
    // What must not touch comes first, and has the lowest lines.
    let times = faults.iter().map(|contact| shown(contact)).chain(near.iter().map(|clearance| around(clearance)));
    let mut lines = lines(&times.collect::<Vec<_>>()).into_iter();
    for (contact, line) in faults.into_iter().zip(lines.by_ref()) {
        log_fault(recorder, contact, line, camera)?;
    }
    near.iter().zip(lines).try_for_each(|(clearance, line)| log_nearest(recorder, clearance, line, camera))
}

/// When a smallest distance is shown (s).
fn around(clearance: &Clearance) -> [f64; 2] {
    [(clearance.time_s - BEFORE_S).max(0.0), clearance.time_s + AFTER_S]
}

/// When a touch that must not be is shown (s): as long as it lasts, and a little longer.
fn shown(contact: &ContactEpisode) -> [f64; 2] {
    [contact.first_time_s, contact.last_time_s + AFTER_S]
}

/// Logs a smallest distance: a line, and in words how near and what.
fn log_nearest(recorder: &Recorder, clearance: &Clearance, line: usize, camera: &Camera) -> Result<(), Fault> {
    let (entity, times) = (NEAREST.of(&[&clearance.b]), around(clearance));
    let look = LineStrips3D::update_fields().with_colors([palette::TOUCH]).with_radii([0.003 * camera.share as f32]);
    recorder.always(entity.clone(), &look)?;
    let strip = [convert::vector(&clearance.point_a.coords), convert::vector(&clearance.point_b.coords)];
    recorder.at_times(entity, &times, LineStrips3D::update_fields().with_strips([strip]).columns([1, 0])?)?;
    let words = format!("{} {:.0} mm from {}", clearance.a, clearance.min_distance_m * 1e3, clearance.b);
    log_words(recorder, NEAREST_LABEL.of(&[&clearance.b]), (words, palette::TOUCH), &times, camera.words(line))
}

/// Logs a touch that must not be: where it is deepest, and in words what touches and how hard.
fn log_fault(recorder: &Recorder, contact: &ContactEpisode, line: usize, camera: &Camera) -> Result<(), Fault> {
    let (names, times) = ([contact.a.as_str(), contact.b.as_str()], shown(contact));
    let entity = FORBIDDEN.of(&names);
    let look = Points3D::update_fields().with_colors([palette::FAULT]).with_radii([(FAULT_M * camera.share) as f32]);
    recorder.always(entity.clone(), &look)?;
    let point = Points3D::update_fields().with_positions([convert::vector(&contact.deepest_point.coords)]);
    recorder.at_times(entity, &times, point.columns([1, 0])?)?;
    let words = format!("{} touches {}{}", contact.a, contact.b, hard_and_deep(contact.max_force_n, contact.max_depth_m));
    log_words(recorder, FORBIDDEN_LABEL.of(&names), (words, palette::light(palette::FAULT)), &times, camera.words(line))
}

/// Logs words beside the scene, from one time to another (s).
fn log_words(
    recorder: &Recorder,
    entity: EntityPath,
    (words, color): (String, rerun::Color),
    times_s: &[f64; 2],
    place: nalgebra::Vector3<f64>,
) -> Result<(), Fault> {
    let look = Points3D::update_fields().with_colors([color]).with_radii([0.0]).with_show_labels(true);
    recorder.always(entity.clone(), &look)?;
    let words = Points3D::update_fields().with_positions([convert::vector(&place)]).with_labels([words]);
    recorder.at_times(entity, times_s, words.columns([1, 0])?)
}

/// Lines of words for what is shown from one time to another (s): the lowest ones above line 0 in which no two are shown at one time.
fn lines(shown: &[[f64; 2]]) -> Vec<usize> {
    let mut lines: Vec<usize> = Vec::new();
    for (index, [from, to]) in shown.iter().enumerate() {
        let together = |other: usize| shown[other][0] <= *to && *from <= shown[other][1];
        let taken = |line: usize| (0..index).any(|other| lines[other] == line && together(other));
        let free = (1..).find(|line| !taken(*line)).unwrap_or(1);
        lines.push(free);
    }
    lines
}

/// Logs what touches at each step, where it is deepest.
fn log_touches(recorder: &Recorder, outcome: &RunOutcome, camera: &Camera) -> Result<(), Fault> {
    recorder.always(CONTACT.path(), &Points3D::update_fields().with_radii([(TOUCH_M * camera.share) as f32]))?;
    let times: Vec<f64> = outcome.steps.iter().map(|step| step.time_s).collect();
    let all = || outcome.steps.iter().flat_map(|step| &step.touches);
    let may = |touch: &TouchPoint| outcome.collisions.get(touch.episode).is_some_and(|contact| contact.allowed);
    let points = Points3D::update_fields()
        .with_positions(all().map(|touch| convert::vector(&touch.point.coords)))
        .with_colors(all().map(|touch| if may(touch) { palette::TOUCH } else { palette::FAULT }));
    let lengths: Vec<usize> = outcome.steps.iter().map(|step| step.touches.len()).collect();
    recorder.at_times(CONTACT.path(), &times, points.columns(lengths)?)
}

#[cfg(test)]
mod tests {
    use super::lines;

    #[test]
    fn words_that_are_shown_at_one_time_have_lines_of_their_own() {
        let at = |moment_s: f64| [moment_s - 0.4, moment_s + 0.8];
        assert_eq!(lines(&[at(1.0), at(2.0), at(3.5), at(10.0), at(1.5)]), [1, 2, 1, 1, 3]);
        assert_eq!(lines(&[[0.0, 20.0], at(3.0), at(5.0), at(21.0)]), [1, 2, 2, 1]);
        assert!(lines(&[]).is_empty());
    }
}
