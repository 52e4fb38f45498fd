//! Which state is active when, and in which windows the skill complies.

use super::ShapingFunction;

/// A stretch of the movement in which one state is the most responsible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// The state.
    pub state: usize,
    /// Time fraction at which it begins (-).
    pub start: f64,
    /// Time fraction at which it ends (-).
    pub end: f64,
}

/// A stretch of the movement in which the skill yields to forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComplianceWindow {
    /// Time fraction at which it begins (-).
    pub start: f64,
    /// Time fraction at which it ends (-).
    pub end: f64,
}

/// Moments at which the active state is looked up: 14 ms of a movement of 28 s. Shorter segments may be missed.
const GRID: usize = 2000;
/// Halvings of a grid step when an edge is sought: to 2e-16 of the duration.
const HALVINGS: usize = 42;

/// The active states over the movement, in order, without gaps from 0 to 1.
#[must_use]
pub fn segments(shaping: &mut ShapingFunction) -> Vec<Segment> {
    let mut found = vec![Segment { state: shaping.active_state(0.0), start: 0.0, end: 1.0 }];
    for i in 1..=GRID {
        let (mut before, mut after) = ((i - 1) as f64 / GRID as f64, i as f64 / GRID as f64);
        let state = shaping.active_state(after);
        let Some(last) = found.last_mut().filter(|last| last.state != state) else { continue };
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + after);
            if shaping.active_state(middle) == last.state { before = middle } else { after = middle }
        }
        last.end = after;
        found.push(Segment { state, start: after, end: 1.0 });
    }
    found
}

/// Neighbouring segments whose states comply, joined.
#[must_use]
pub fn compliance_windows(segments: &[Segment], beta: &[f64]) -> Vec<ComplianceWindow> {
    let mut windows: Vec<ComplianceWindow> = Vec::new();
    for segment in segments.iter().filter(|s| beta.get(s.state).is_some_and(|b| *b != 0.0)) {
        match windows.last_mut() {
            Some(window) if window.end == segment.start => window.end = segment.end,
            _ => windows.push(ComplianceWindow { start: segment.start, end: segment.end }),
        }
    }
    windows
}
