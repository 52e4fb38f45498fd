//! Whether a lesson went where the person meant to lead it.

use super::guide_path::GuidePath;
use crate::control::ToolPath;

/// From how far beside a way-point on a lesson is said to have missed it (m): ten times what a person's aim is off.
const ASTRAY_M: f64 = 0.03;

/// How much earlier or later than meant the tool may pass a way-point (s): a hand leads through a spring.
const LATE_S: f64 = 1.0;

/// The way-point of `path` that the tool missed by most when it was led as `led`, in words; nothing when it came to all of them.
pub(super) fn astray(path: &GuidePath, led: &ToolPath) -> Option<String> {
    let missed = path.times_s().iter().enumerate().map(|(index, &time_s)| (index, nearest_m(path, led, time_s)));
    let (index, missed_m) = missed.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, missed_m)| *missed_m > ASTRAY_M)?;
    Some(format!(
        "the tool passed way-point {} {:.0} mm away: something held it, or the hand is too weak (`human.teaching_force_max_n`)",
        index + 1,
        missed_m * 1e3
    ))
}

/// How near the tool came to where it was meant to be at `time_s`, a little earlier or later (m).
fn nearest_m(path: &GuidePath, led: &ToolPath, time_s: f64) -> f64 {
    let meant = path.at(time_s).pose.translation.vector;
    let around = led.times_s.iter().zip(&led.poses).filter(|(t, _)| (*t - time_s).abs() <= LATE_S);
    around.map(|(_, pose)| (pose.translation.vector - meant).norm()).fold(f64::INFINITY, f64::min)
}
