//! What touches, and what nearly does.

use nalgebra::Vector3;
use rerun::{Color, EntityPath, LineStrips3D, Points3D, Radius};

use super::camera::Camera;
use super::convert;
use super::entity_path::{CONTACT, FORBIDDEN, FORBIDDEN_LABEL, NEAREST, NEAREST_LABEL};
use super::palette;
use super::recorder::{Fault, Recorder};
use super::scene_key::Contacts;
use super::touch_stretches::{AFTER_S, Stretch, stretches};
use crate::simulation::{RunOutcome, StepRecord};
use crate::world::{Clearance, ContactEpisode, NEAR_M, TouchPoint, nearest_of_each};

/// A smallest distance is shown from so long before it to [`AFTER_S`] after it (s).
const BEFORE_S: f64 = 0.4;

/// Radius of a smallest distance's line, seen from far (m).
const NEAR_RADIUS_M: f64 = 0.005;

/// Radii of points on the screen (pt), from wherever they are seen: of what touches, and of what must not where it is deepest.
const TOUCH_PT: f32 = 3.0;
const FAULT_PT: f32 = 7.0;

/// Logs what must not touch, and smallest distances that are near ones, when they happen, in words above so many lines of others.
pub(super) fn log_contacts(recorder: &Recorder, outcome: &RunOutcome, (camera, below): (&Camera, usize)) -> Result<(), Fault> {
    let near = near(outcome);
    let refused = outcome.collisions.iter().enumerate().filter(|(_, contact)| !contact.allowed);
    let faults: Vec<(&ContactEpisode, Vec<Stretch>)> =
        refused.map(|(index, contact)| (contact, stretches(&outcome.steps, index))).collect();
    // What must not touch comes first, and has the lowest lines.
    let times = faults.iter().flat_map(|(_, stretches)| stretches).map(shown).chain(near.iter().map(|clearance| around(clearance)));
    let mut lines = lines(&times.collect::<Vec<_>>(), below).into_iter();
    for (contact, stretches) in &faults {
        let places: Vec<_> = lines.by_ref().take(stretches.len()).map(|line| camera.words(line)).collect();
        log_fault(recorder, contact, (stretches, &places))?;
    }
    near.iter().zip(lines).try_for_each(|(clearance, line)| log_nearest(recorder, clearance, line, camera))
}

/// Which contacts and distances a run that is over has.
pub(super) fn contacts_of(outcome: &RunOutcome) -> Contacts {
    let any = |allowed: bool| outcome.collisions.iter().any(|contact| contact.allowed == allowed);
    Contacts { allowed: any(true), refused: any(false), near: !near(outcome).is_empty() }
}

/// The smallest distances that are near ones.
fn near(outcome: &RunOutcome) -> Vec<&Clearance> {
    nearest_of_each(&outcome.clearances).into_iter().filter(|clearance| clearance.min_distance_m < NEAR_M).collect()
}

/// When a smallest distance is shown (s).
fn around(clearance: &Clearance) -> [f64; 2] {
    [(clearance.time_s - BEFORE_S).max(0.0), clearance.time_s + AFTER_S]
}

/// When a touch that must not be is shown (s): as long as it lasts, and a little longer.
fn shown(stretch: &Stretch) -> [f64; 2] {
    [stretch.from_s, stretch.until_s + AFTER_S]
}

/// Logs a smallest distance: a line, and in words how near and what.
fn log_nearest(recorder: &Recorder, clearance: &Clearance, line: usize, camera: &Camera) -> Result<(), Fault> {
    let (entity, times) = (NEAREST.of(&[&clearance.b]), around(clearance));
    let look = LineStrips3D::update_fields().with_colors([palette::TOUCH]).with_radii([(NEAR_RADIUS_M * camera.share) as f32]);
    recorder.always(entity.clone(), &look)?;
    let strip = [convert::vector(&clearance.point_a.coords), convert::vector(&clearance.point_b.coords)];
    recorder.at_times(entity, &times, LineStrips3D::update_fields().with_strips([strip]).columns([1, 0])?)?;
    let words = format!("{} {:.0} mm from {}", clearance.a, clearance.min_distance_m * 1e3, clearance.b);
    let label = NEAREST_LABEL.of(&[&clearance.b]);
    log_words(recorder, label, palette::TOUCH, &[(times, camera.words(line), words)])
}

/// Logs the touches of two parts that must not: where each is deepest, and in words at its place what touches and how hard.
fn log_fault(recorder: &Recorder, contact: &ContactEpisode, (stretches, places): (&[Stretch], &[Vector3<f64>])) -> Result<(), Fault> {
    let names = [contact.a.as_str(), contact.b.as_str()];
    let entity = FORBIDDEN.of(&names);
    let look = Points3D::update_fields().with_colors([palette::FAULT]).with_radii([Radius::new_ui_points(FAULT_PT)]);
    recorder.always(entity.clone(), &look)?;
    let points = Points3D::update_fields().with_positions(stretches.iter().map(|stretch| convert::vector(&stretch.point.coords)));
    let times: Vec<f64> = stretches.iter().flat_map(shown).collect();
    recorder.at_times(entity, &times, points.columns(there_and_gone(stretches.len()))?)?;
    let words = |stretch: &Stretch| format!("{} touches {}{}", contact.a, contact.b, stretch.hard_and_deep());
    let said: Vec<_> = stretches.iter().zip(places).map(|(stretch, place)| (shown(stretch), *place, words(stretch))).collect();
    log_words(recorder, FORBIDDEN_LABEL.of(&names), palette::for_words(palette::FAULT), &said)
}

/// Logs words beside the scene, each from one time to another (s) at a place (m, world).
fn log_words(recorder: &Recorder, entity: EntityPath, color: Color, said: &[([f64; 2], Vector3<f64>, String)]) -> Result<(), Fault> {
    let look = Points3D::update_fields().with_colors([color]).with_radii([0.0]).with_show_labels(true);
    recorder.always(entity.clone(), &look)?;
    let words = Points3D::update_fields()
        .with_positions(said.iter().map(|(_, place, _)| convert::vector(place)))
        .with_labels(said.iter().map(|(.., words)| words.clone()));
    let times: Vec<f64> = said.iter().flat_map(|(times, ..)| *times).collect();
    recorder.at_times(entity, &times, words.columns(there_and_gone(said.len()))?)
}

/// Of so many things, one after the other, each there and then gone: how many are there.
fn there_and_gone(things: usize) -> Vec<usize> {
    (0..2 * things).map(|i| usize::from(i % 2 == 0)).collect()
}

/// Lines of words for what is shown from one time to another (s): from `first` on the lowest ones in which no two are shown at one time.
fn lines(shown: &[[f64; 2]], first: usize) -> Vec<usize> {
    let mut lines: Vec<usize> = Vec::new();
    for (index, [from, to]) in shown.iter().enumerate() {
        let together = |other: usize| shown[other][0] <= *to && *from <= shown[other][1];
        let taken = |line: usize| (0..index).any(|other| lines[other] == line && together(other));
        let free = (first..).find(|line| !taken(*line)).unwrap_or(first);
        lines.push(free);
    }
    lines
}

/// Logs what touches at each of some steps of a run, where it is deepest: red what must not, as far as that is told.
pub(super) fn log_touches(recorder: &Recorder, outcome: &RunOutcome, records: &[StepRecord]) -> Result<(), Fault> {
    recorder.always(CONTACT.path(), &Points3D::update_fields().with_radii([Radius::new_ui_points(TOUCH_PT)]))?;
    let all = || records.iter().flat_map(|step| &step.touches);
    let must_not = |touch: &TouchPoint| outcome.collisions.get(touch.episode).is_some_and(|contact| !contact.allowed);
    let points = Points3D::update_fields()
        .with_positions(all().map(|touch| convert::vector(&touch.point.coords)))
        .with_colors(all().map(|touch| if must_not(touch) { palette::FAULT } else { palette::TOUCH }));
    let lengths: Vec<usize> = records.iter().map(|step| step.touches.len()).collect();
    recorder.every_step(CONTACT.path(), points.columns(lengths)?)
}

#[cfg(test)]
mod tests {
    use super::lines;

    #[test]
    fn words_that_are_shown_at_one_time_have_lines_of_their_own() {
        let at = |moment_s: f64| [moment_s - 0.4, moment_s + 0.8];
        assert_eq!(lines(&[at(1.0), at(2.0), at(3.5), at(10.0), at(1.5)], 1), [1, 2, 1, 1, 3]);
        assert_eq!(lines(&[[0.0, 20.0], at(3.0), at(5.0), at(21.0)], 0), [0, 1, 1, 0]);
        assert!(lines(&[], 1).is_empty());
    }
}
