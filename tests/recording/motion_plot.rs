//! Contract: lines that lie on each other are all seen: what was taught is wider than the plan where it is on it, and thin, as there is much of it,
//! where it is not.

use cpdmp::recording::entity_path::{self, Entity};
use cpdmp::recording::write_recording;
use cpdmp::simulation::skill_duration_s;
use rerun::log::Chunk;
use tempfile::TempDir;

use super::made_up_run::outcome;
use super::read_rrd::{chunks, experiment, rows};

fn widths(chunks: &[Chunk], entity: &Entity, names: &[&str]) -> Vec<(i64, f32)> {
    let width = rerun::SeriesLines::descriptor_widths();
    let read = |chunk: &Chunk| chunk.iter_slices::<f32>(width.component).map(|widths| widths[0]).collect();
    rows(chunks, &entity.of(names), &width, read)
}

#[test]
fn taught_lines_are_wide_on_the_plan_and_thin_beside_it() {
    let outcome = outcome();
    let folder = TempDir::new().expect("a folder can be made");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment(), &outcome, "").expect("the recording is written");
    let chunks = chunks(&path);
    let duration_ns = 1e9 * skill_duration_s(&outcome.steps).unwrap_or(outcome.plan.duration_s());
    let scalars = rerun::Scalars::descriptor_scalars();
    let mut seen = [0, 0];
    for (axis, column) in [("x", "x_m"), ("y", "y_m"), ("z", "z_m")] {
        let plan = outcome.plan.column(column).expect("the plan has a place");
        let planned = |ns: i64| plan[((ns as f64 / duration_ns * (plan.len() - 1) as f64).round() as usize).min(plan.len() - 1)];
        let steepest = plan.as_slice().windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        for demonstration in &outcome.dataset.demonstrations {
            let names = [axis, demonstration.name.as_str()];
            let read = |chunk: &Chunk| chunk.iter_slices::<f64>(scalars.component).map(|values| values[0]).collect();
            let values: Vec<(i64, f64)> = rows(&chunks, &entity_path::TAUGHT_MOTION.of(&names), &scalars, read);
            let widths = widths(&chunks, &entity_path::TAUGHT_MOTION, &names);
            assert_eq!(values.len(), widths.len());
            for ((ns, value), (at, width)) in values.into_iter().zip(widths) {
                assert_eq!(ns, at);
                let away_m = (planned(ns) - value).abs();
                if away_m + steepest < 0.003 {
                    seen[0] += 1;
                    assert!(width > 7.0, "{names:?}: {width} so near to the plan: {away_m} m");
                } else if away_m - steepest > 0.003 {
                    seen[1] += 1;
                    assert!(width < 2.0, "{names:?}: {width} so far from the plan: {away_m} m");
                }
            }
        }
    }
    assert!(seen.iter().all(|times| *times > 100), "{seen:?}");
}
