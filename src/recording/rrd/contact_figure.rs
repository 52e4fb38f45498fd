//! What touches, and what nearly does.

use rerun::{LineStrips3D, Points3D};

use super::camera::Camera;
use super::convert;
use super::entity_path::{CONTACT, NEAREST, NEAREST_LABEL};
use super::palette;
use super::recorder::{Fault, Recorder};
use crate::simulation::RunOutcome;
use crate::world::{ContactEpisode, NEAR_M, nearest_of_each};

/// What happens in a moment is shown from so long before it to so long after it (s).
const SHOWN_S: [f64; 2] = [0.4, 0.8];

/// Logs contacts, and smallest distances that are near ones, when they happen, in words above those of the active state.
pub(super) fn log_contacts(recorder: &Recorder, outcome: &RunOutcome, camera: &Camera) -> Result<(), Fault> {
    let near: Vec<_> = nearest_of_each(&outcome.clearances).into_iter().filter(|clearance| clearance.min_distance_m < NEAR_M).collect();
    let lines = lines(&near.iter().map(|clearance| clearance.time_s).collect::<Vec<f64>>());
    for (clearance, line_of_words) in near.iter().zip(lines) {
        let entity = NEAREST.of(&[&clearance.b]);
        let look = LineStrips3D::update_fields().with_colors([palette::TOUCH]).with_radii([0.003 * camera.share as f32]);
        recorder.always(entity.clone(), &look)?;
        let line = [convert::vector(&clearance.point_a.coords), convert::vector(&clearance.point_b.coords)];
        let times = [(clearance.time_s - SHOWN_S[0]).max(0.0), clearance.time_s + SHOWN_S[1]];
        recorder.at_times(entity, &times, LineStrips3D::update_fields().with_strips([line]).columns([1, 0])?)?;
        let label = NEAREST_LABEL.of(&[&clearance.b]);
        let look = Points3D::update_fields().with_colors([palette::TOUCH]).with_radii([0.0]).with_show_labels(true);
        recorder.always(label.clone(), &look)?;
        let text = format!("{} {:.0} mm from {}", clearance.a, clearance.min_distance_m * 1e3, clearance.b);
        let words = Points3D::update_fields().with_positions([convert::vector(&camera.words(line_of_words))]).with_labels([text]);
        recorder.at_times(label, &times, words.columns([1, 0])?)?;
    }
    log_touches(recorder, &outcome.collisions, camera)
}

/// Lines of words for what is shown around some moments (s): the lowest ones above line 0 in which no two are shown at one time.
fn lines(moments_s: &[f64]) -> Vec<usize> {
    let mut lines: Vec<usize> = Vec::new();
    for (index, moment_s) in moments_s.iter().enumerate() {
        let together = |other: usize| (moment_s - moments_s[other]).abs() <= SHOWN_S[0] + SHOWN_S[1];
        let taken = |line: usize| (0..index).any(|other| lines[other] == line && together(other));
        let free = (1..).find(|line| !taken(*line)).unwrap_or(1);
        lines.push(free);
    }
    lines
}

/// Contacts are points where and when they were deepest.
fn log_touches(recorder: &Recorder, contacts: &[ContactEpisode], camera: &Camera) -> Result<(), Fault> {
    recorder.always(CONTACT.path(), &Points3D::update_fields().with_radii([0.008 * camera.share as f32]))?;
    let shown = |contact: &ContactEpisode| [(contact.deepest_time_s - SHOWN_S[0]).max(0.0), contact.deepest_time_s + SHOWN_S[1]];
    let mut moments: Vec<f64> = contacts.iter().flat_map(shown).collect();
    moments.sort_by(f64::total_cmp);
    moments.dedup();
    let during = |time_s: &f64| -> Vec<&ContactEpisode> {
        let seen = |contact: &&ContactEpisode| (shown(contact)[0]..shown(contact)[1]).contains(time_s);
        contacts.iter().filter(seen).collect()
    };
    let sets: Vec<Vec<&ContactEpisode>> = moments.iter().map(during).collect();
    let all = || sets.iter().flatten();
    let points = Points3D::update_fields()
        .with_positions(all().map(|contact| convert::vector(&contact.deepest_point.coords)))
        .with_colors(all().map(|contact| if contact.allowed { palette::TOUCH } else { palette::FAULT }));
    let lengths: Vec<usize> = sets.iter().map(Vec::len).collect();
    recorder.at_times(CONTACT.path(), &moments, points.columns(lengths)?)
}

#[cfg(test)]
mod tests {
    use super::lines;

    #[test]
    fn words_that_are_shown_at_one_time_have_lines_of_their_own() {
        assert_eq!(lines(&[1.0, 2.0, 3.0, 10.0, 1.5]), [1, 2, 1, 1, 3]);
        assert!(lines(&[]).is_empty());
    }
}
