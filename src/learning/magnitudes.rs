//! Whether numbers can be computed with: squares of what is learned must neither overflow nor vanish.

use super::LearningError;
use crate::demonstration::{Dataset, Demonstration, DemonstrationError, Fault};

/// The largest magnitude that is learned from (in the column's own unit): squares and their sums stay finite.
const LARGEST: f64 = 1e100;
/// The smallest change that is learned from (in the column's own unit): its square does not vanish. No change at all is no fault.
const SMALLEST_CHANGE: f64 = 1e-100;
/// Refuses values, parameters and times that arithmetic would turn into infinity or nothing, all of them at once.
pub(super) fn check(dataset: &Dataset, rate_hz: f64) -> Result<(), LearningError> {
    let demonstrations = &dataset.demonstrations;
    let mut faults: Vec<Fault> = demonstrations.iter().flat_map(|d| too_large(d, dataset)).collect();
    faults.extend(demonstrations.iter().filter_map(|d| too_short(d, rate_hz)));
    faults.extend(dataset.motion.iter().chain(&dataset.wrench).filter_map(|name| {
        let of = |d: &Demonstration| d.trajectory.column_index(name).map(|column| range(d.trajectory.values().column(column).iter()));
        too_still(dataset, name, demonstrations.iter().filter_map(of))
    }));
    for (key, of) in [("theta_m", (|d| &d.theta_m) as fn(&Demonstration) -> &Vec<(String, f64)>), ("theta_f", |d| &d.theta_f)] {
        for (index, (name, _)) in demonstrations.first().map_or(&[][..], |d| of(d)).iter().enumerate() {
            let values = demonstrations.iter().filter_map(|d| of(d).get(index)).map(|(_, value)| (*value, *value));
            faults.extend(too_still(dataset, &format!("{key}.{name}"), values));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(DemonstrationError::Invalid(faults).into()) }
}

/// The first value of each learned column that is too large, with its sample, counted from 0, and each parameter that is.
fn too_large(demonstration: &Demonstration, dataset: &Dataset) -> Vec<Fault> {
    let trajectory = &demonstration.trajectory;
    let fault = |column: String, found| {
        let expected = format!("a magnitude up to {LARGEST:e}, so that it can be squared");
        Fault { place: demonstration.name.clone(), column: Some(column), found, expected, ..Fault::default() }
    };
    let column = |name: &String| {
        let values = trajectory.values().column(trajectory.column_index(name)?);
        let sample = values.iter().position(|value| value.abs() > LARGEST)?;
        Some(fault(name.clone(), format!("{:e} in sample {sample}", values[sample])))
    };
    let mut faults: Vec<Fault> = dataset.motion.iter().chain(&dataset.wrench).filter_map(column).collect();
    for (key, theta) in [("theta_m", &demonstration.theta_m), ("theta_f", &demonstration.theta_f)] {
        let large = theta.iter().filter(|(_, value)| value.abs() > LARGEST);
        faults.extend(large.map(|(name, value)| fault(format!("{key}.{name}"), format!("{value:e}"))));
    }
    faults
}

/// A demonstration that is over within one period of the rate that models learn at (Hz).
fn too_short(demonstration: &Demonstration, rate_hz: f64) -> Option<Fault> {
    let (duration_s, period_s) = (demonstration.trajectory.duration_s(), 1.0 / rate_hz);
    let expected =
        format!("at least {period_s:.3} s, one period of rate_hz = {rate_hz}: are its times in seconds, is the rate high enough?");
    let fault = Fault { place: demonstration.name.clone(), column: Some("time_s".to_owned()), expected, ..Fault::default() };
    (duration_s < period_s).then(|| Fault { found: format!("a duration of {duration_s:e} s"), ..fault })
}

/// A column or parameter that changes, over all demonstrations, by less than can be squared.
fn too_still(dataset: &Dataset, name: &str, ranges: impl Iterator<Item = (f64, f64)>) -> Option<Fault> {
    let (least, most) = ranges.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), (least, most)| (a.min(least), b.max(most)));
    let change = most - least;
    let expected = format!("a change of at least {SMALLEST_CHANGE:e}, so that it can be squared (another unit helps), or none at all");
    let place = dataset.demonstrations.first()?.name.clone();
    let found = format!("a change by {change:e} over all demonstrations");
    (0.0 < change && change < SMALLEST_CHANGE).then(|| Fault { place, column: Some(name.to_owned()), found, expected, ..Fault::default() })
}

fn range<'a>(values: impl Iterator<Item = &'a f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| (least.min(*value), most.max(*value)))
}
