//! When two parts touched: a pair may do so again and again, and each time is told for itself.

use nalgebra::Point3;

use crate::simulation::StepRecord;

/// What must not be is shown for so long after its end (s), and what comes back before that has not ended: most touches are over before they could
/// be seen.
pub(super) const AFTER_S: f64 = 0.8;

/// A stretch of time in which two parts touched, at most with short breaks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stretch {
    /// The first and the last logged step that tells of it (s).
    pub from_s: f64,
    pub until_s: f64,
    /// The smallest distance in it (m), negative inside, and where that was (m, world).
    pub distance_m: f64,
    pub point: Point3<f64>,
    /// The largest normal force in it (N); NaN where the engine told none.
    pub force_n: f64,
}

/// The stretches in which the parts of contact number `episode` touched, in the order of time.
pub(super) fn stretches(steps: &[StepRecord], episode: usize) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    let touches = steps.iter().flat_map(|step| step.touches.iter().map(move |touch| (step.time_s, touch)));
    for (time_s, touch) in touches.filter(|(_, touch)| touch.episode == episode) {
        match found.last_mut().filter(|last| time_s - last.until_s <= AFTER_S) {
            Some(last) => {
                last.until_s = time_s;
                last.force_n = last.force_n.max(touch.force_n);
                if touch.distance_m < last.distance_m {
                    (last.distance_m, last.point) = (touch.distance_m, touch.point);
                }
            }
            None => found.push(Stretch {
                from_s: time_s,
                until_s: time_s,
                distance_m: touch.distance_m,
                point: touch.point,
                force_n: touch.force_n,
            }),
        }
    }
    found
}

impl Stretch {
    /// How hard they touched, and how deep, as far as it is known: `: peak 10.8 N, 0.7 mm deep`.
    pub(super) fn hard_and_deep(&self) -> String {
        hard_and_deep(self.force_n, (-self.distance_m).max(0.0))
    }
}

/// Depths below this (m) would be written as nothing.
const LEAST_DEPTH_M: f64 = 0.05e-3;

/// How hard something touches (N), and how deep (m), as far as it is known.
pub(super) fn hard_and_deep(force_n: f64, depth_m: f64) -> String {
    let force = (!force_n.is_nan()).then(|| format!("peak {force_n:.1} N"));
    let depth = (depth_m >= LEAST_DEPTH_M).then(|| format!("{:.1} mm deep", depth_m * 1e3));
    let known: Vec<String> = force.into_iter().chain(depth).collect();
    if known.is_empty() { String::new() } else { format!(": {}", known.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::hard_and_deep;

    #[test]
    fn a_depth_that_would_be_written_as_nothing_is_not_written() {
        assert_eq!(hard_and_deep(401.3, 0.04e-3), ": peak 401.3 N");
        assert_eq!(hard_and_deep(243.0, 2.4e-3), ": peak 243.0 N, 2.4 mm deep");
        assert_eq!(hard_and_deep(f64::NAN, 0.06e-3), ": 0.1 mm deep");
        assert_eq!(hard_and_deep(f64::NAN, 0.0), "");
    }
}
