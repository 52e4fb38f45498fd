//! Why the arm complies: the statistic of the active state against sigma, eq. (20), as roots in millimetres.

use rerun::Scalars;

use super::entity_path::{SPREAD, THRESHOLD};
use super::palette;
use super::paths::style;
use super::recorder::{Fault, Recorder};
use crate::learning::Skill;
use crate::learning::cpdmp::spread_unit;
use crate::simulation::StepRecord;

/// Logs both for some records; a skill without states has none.
pub(super) fn log_spread(recorder: &Recorder, skill: &Skill, records: &[StepRecord]) -> Result<(), Fault> {
    let compliance = &skill.compliance;
    if compliance.values_m2.is_empty() {
        return Ok(());
    }
    let millimetres = |value_m2: f64| value_m2.max(0.0).sqrt() * 1e3;
    let of_state = |state: usize| compliance.values_m2.get(state).map_or(f64::NAN, |value| millimetres(*value));
    let spread: Vec<f64> = records.iter().map(|record| of_state(record.state)).collect();
    recorder.always(
        SPREAD.path(),
        &style(&format!("spread of the active state ({})", spread_unit(&skill.motion.columns)), palette::EXECUTED, 2.0),
    )?;
    recorder.every_step(SPREAD.path(), Scalars::new(spread).columns_of_unit_batches()?)?;
    // Without a threshold no state complies.
    let ends: Vec<f64> = [records.first(), records.last()].into_iter().flatten().map(|record| record.time_s).collect();
    if compliance.threshold_m2.is_finite() {
        let sigma = vec![millimetres(compliance.threshold_m2); ends.len()];
        recorder.always(THRESHOLD.path(), &style("sigma: above it states comply", palette::TOUCH, 1.5))?;
        recorder.at_times(THRESHOLD.path(), &ends, Scalars::new(sigma).columns_of_unit_batches()?)?;
    }
    Ok(())
}
