//! Answers about the force of the objects on the tool.

use nalgebra::Vector3;

use super::judge::Answer;
use crate::simulation::RunOutcome;

/// How much shorter than asked a window may be for its ends to be rounded (s).
const ROUNDING_S: f64 = 1e-9;

pub(super) fn tool_force(outcome: &RunOutcome, mean_over_s: f64, max_n: f64) -> Answer {
    if mean_over_s == 0.0 {
        let failed = outcome.steps.iter().find(|step| step.tool_force.norm() > max_n).map(|step| step.time_s);
        return Answer::at_most(outcome.tool_peak_force_n, max_n, "N").first_failed(failed);
    }
    let start = std::iter::once((0.0, Vector3::zeros()));
    let given: Vec<_> = start.chain(outcome.steps.iter().map(|step| (step.time_s, step.tool_impulse))).collect();
    let means = mean_forces(&given, mean_over_s);
    let failed = means.iter().find(|(_, mean)| *mean > max_n).map(|(time, _)| *time);
    Answer::at_most(largest_mean(&means), max_n, "N").first_failed(failed)
}

/// The largest of the means (N). A log that is shorter than the window has none, and neither has one without impulses: there is no answer then.
fn largest_mean(means: &[(f64, f64)]) -> f64 {
    let larger = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) };
    means.iter().map(|(_, mean)| *mean).reduce(larger).unwrap_or(f64::NAN)
}

/// Mean forces (N) over every shortest window of at least `window_s`, with the times of the windows' ends (s), from the momentum that was
/// given until each of the rising times (s, N s).
fn mean_forces(given: &[(f64, Vector3<f64>)], window_s: f64) -> Vec<(f64, f64)> {
    let mean = |(first, (from_s, from)): (usize, &(f64, Vector3<f64>))| {
        let last = first + given[first..].partition_point(|(time, _)| time - from_s < window_s - ROUNDING_S);
        given.get(last).map(|(to_s, to)| (*to_s, (to - from).norm() / (to_s - from_s)))
    };
    given.iter().enumerate().filter_map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contract: a steady force is its own mean; a blow adds its momentum over the window, wherever within a logged step it falls.
    #[test]
    fn a_blow_counts_by_its_momentum() {
        let (steady_n, blow_ns) = (4.0, 0.5);
        let at = |k: usize| {
            let time_s = 0.01 * k as f64;
            (time_s, Vector3::new(0.0, steady_n * time_s + if k > 7 { blow_ns } else { 0.0 }, 0.0))
        };
        let given: Vec<_> = (0..=20).map(at).collect();
        for (window_s, spanned_s) in [(0.01, 0.01), (0.02, 0.02), (0.025, 0.03)] {
            let means = mean_forces(&given, window_s);
            let (first_s, largest) = means.iter().fold((f64::NAN, 0.0), |a, b| if b.1 > a.1 + 1e-9 { *b } else { a });
            assert!((largest - steady_n - blow_ns / spanned_s).abs() < 1e-9, "{largest} N over {window_s} s");
            assert!((first_s - 0.08).abs() < 1e-9, "{first_s} s");
            let least = means.iter().map(|m| m.1).fold(f64::INFINITY, f64::min);
            assert!((least - steady_n).abs() < 1e-9);
        }
        // A run of 0.2 s has no mean over 0.3 s: nothing is known of it, least of all that it is 0 N.
        assert!(mean_forces(&given, 0.3).is_empty() && largest_mean(&mean_forces(&given, 0.3)).is_nan());
        assert!((largest_mean(&mean_forces(&given, 0.2)) - steady_n - blow_ns / 0.2).abs() < 1e-9);
    }
}
