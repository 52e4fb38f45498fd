//! Stretches of time in step records.

use crate::simulation::StepRecord;

/// A stretch of time (s), both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// First moment.
    pub start_s: f64,
    /// Last moment.
    pub end_s: f64,
}

/// When the coupling let the arm comply.
pub fn compliance_windows(steps: &[StepRecord]) -> Vec<Window> {
    windows(steps, |step| step.activation > 0.0 && step.beta < 0.0)
}

/// When the person pushed.
pub fn human_windows(steps: &[StepRecord]) -> Vec<Window> {
    windows(steps, |step| step.human.force.norm() > 0.0)
}

/// Maximal stretches in which `holds`.
pub(super) fn windows(steps: &[StepRecord], holds: impl Fn(&StepRecord) -> bool) -> Vec<Window> {
    let mut found: Vec<Window> = Vec::new();
    let mut inside = false;
    for step in steps {
        match (holds(step), inside, found.last_mut()) {
            (true, true, Some(window)) => window.end_s = step.time_s,
            (true, _, _) => found.push(Window { start_s: step.time_s, end_s: step.time_s }),
            _ => {}
        }
        inside = holds(step);
    }
    found
}
