//! What touches, and what nearly does.

use rerun::{LineStrips3D, Points3D};

use super::convert;
use super::entity_path::{CONTACT, NEAREST};
use super::palette;
use super::recorder::{Fault, Recorder};
use crate::simulation::RunOutcome;
use crate::world::ContactEpisode;

/// The line of a smallest distance is shown from so long before it to so long after it (s).
const SHOWN_S: [f64; 2] = [0.4, 0.8];

/// Logs contacts while they last and smallest distances while they happen.
pub(super) fn log_contacts(recorder: &Recorder, outcome: &RunOutcome) -> Result<(), Fault> {
    for clearance in outcome.clearances.iter().filter(|clearance| clearance.min_distance_m.is_finite()) {
        let entity = NEAREST.of(&[&clearance.b]);
        let look = LineStrips3D::update_fields().with_colors([palette::TOUCH]).with_radii([0.003]).with_show_labels(true);
        recorder.always(entity.clone(), &look)?;
        let line = [convert::vector(&clearance.point_a.coords), convert::vector(&clearance.point_b.coords)];
        let label = format!("{:.0} mm", clearance.min_distance_m * 1e3);
        let shown = LineStrips3D::update_fields().with_strips([line]).with_labels([label]);
        let times = [(clearance.time_s - SHOWN_S[0]).max(0.0), clearance.time_s + SHOWN_S[1]];
        recorder.at_times(entity, &times, shown.columns([1, 0])?)?;
    }
    log_touches(recorder, &outcome.collisions)
}

/// One set of points per moment at which something begins or ends to touch.
fn log_touches(recorder: &Recorder, contacts: &[ContactEpisode]) -> Result<(), Fault> {
    recorder.always(CONTACT.path(), &Points3D::update_fields().with_radii([0.008]))?;
    let mut times: Vec<f64> = contacts.iter().flat_map(|contact| [contact.first_time_s, contact.last_time_s]).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    // At the last moment of a contact it still touches: what is gone is gone just after.
    let after = |time_s: &f64| time_s + 1e-3;
    let moments: Vec<f64> = times.iter().flat_map(|time_s| [*time_s, after(time_s)]).collect();
    let during = |time_s: &f64| -> Vec<&ContactEpisode> {
        contacts.iter().filter(|contact| (contact.first_time_s..=contact.last_time_s).contains(time_s)).collect()
    };
    let shown: Vec<Vec<&ContactEpisode>> = moments.iter().map(during).collect();
    let all = || shown.iter().flatten();
    let points = Points3D::update_fields()
        .with_positions(all().map(|contact| convert::vector(&contact.point.coords)))
        .with_colors(all().map(|contact| if contact.allowed { palette::TOUCH } else { palette::FAULT }));
    let lengths: Vec<usize> = shown.iter().map(Vec::len).collect();
    recorder.at_times(CONTACT.path(), &moments, points.columns(lengths)?)
}
