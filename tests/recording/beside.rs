//! Contract: what was executed beside a run is in its recording under its own name, as its records have it, and in the layout's titles.

use std::path::Path;

use cpdmp::palette::meaning::Difference;
use cpdmp::recording::entity_path::{self, ENTITIES, Entity};
use cpdmp::recording::write_recording;
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::{Beside, RunOutcome, StepRecord};
use nalgebra::Vector3;
use rerun::log::Chunk;
use tempfile::TempDir;

use super::contacts::TOUCHING;
use super::documented::assert_documented;
use super::made_up_run::outcome;
use super::read_rrd::{chunks, experiment, rows};

/// The made-up run with two others beside it that went elsewhere, the second one for a shorter time.
pub fn compared() -> RunOutcome {
    let run = outcome();
    let elsewhere = |name: &str, steps: usize, away_m: f64| {
        let mut other = RunOutcome { steps: run.steps[..steps].to_vec(), ..run.clone() };
        for record in &mut other.steps {
            record.tool.translation.vector += Vector3::new(away_m, 2.0 * away_m, 3.0 * away_m);
            record.wrench *= 1.0 + away_m;
        }
        Beside { name: name.into(), changes: vec!["coupling.enabled=false".into()], difference: Difference::Coupling, outcome: other }
    };
    let beside = vec![elsewhere("uncoupled", run.steps.len(), 0.1), elsewhere("blind", 20, 0.2)];
    RunOutcome { beside, ..run }
}

fn written(outcome: &RunOutcome) -> Vec<Chunk> {
    let folder = TempDir::new().expect("a folder can be made");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment(), outcome, "").expect("the recording is written");
    chunks(&path)
}

/// The numbers of an entity over simulated time (ns).
fn series(chunks: &[Chunk], entity: &Entity, names: &[&str]) -> Vec<(i64, u64)> {
    let scalars = rerun::Scalars::descriptor_scalars();
    let read = |chunk: &Chunk| chunk.iter_slices::<f64>(scalars.component).map(|values| values[0].to_bits()).collect();
    rows(chunks, &entity.of(names), &scalars, read)
}

#[test]
fn what_was_executed_beside_the_run_is_recorded_as_its_records_have_it() {
    let outcome = compared();
    let chunks = written(&outcome);
    let of = |steps: &[StepRecord], value: &dyn Fn(&StepRecord) -> f64| -> Vec<(i64, u64)> {
        steps.iter().map(|record| ((record.time_s * 1e9).round() as i64, value(record).to_bits())).collect()
    };
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let force = |record: &StepRecord| record.wrench[axis];
        let error = |record: &StepRecord| record.wrench[axis] - record.expected_force[axis];
        for one in &outcome.beside {
            let place = |record: &StepRecord| record.tool.translation.vector[axis];
            let steps = &one.outcome.steps;
            assert_eq!(series(&chunks, &entity_path::BESIDE_MOTION, &[name, &one.name]), of(steps, &place));
            assert_eq!(series(&chunks, &entity_path::BESIDE_FORCE, &[name, &one.name]), of(steps, &force));
            assert_eq!(series(&chunks, &entity_path::BESIDE_ERROR, &[name, &one.name]), of(steps, &error));
        }
        assert_eq!(series(&chunks, &entity_path::BESIDE_ERROR, &[name, "executed"]), of(&outcome.steps, &error));
    }
}

/// Contract: the key of force errors names those that have one, the key of the scene says what each changes.
#[test]
fn the_key_of_force_errors_leaves_out_who_expects_no_force() {
    let mut outcome = compared();
    outcome.beside[0].outcome.skill.force = None;
    let chunks = written(&outcome);
    let text = rerun::TextDocument::descriptor_text().component;
    let key = |entity: &Entity| -> String {
        let of_entity = chunks.iter().filter(|chunk| *chunk.entity_path() == entity.path());
        of_entity.flat_map(|chunk| chunk.iter_slices::<String>(text).map(|texts| texts[0].to_string()).collect::<Vec<_>>()).collect()
    };
    assert_eq!(key(&entity_path::BESIDE_COLORS), "orange: executed\n\nmagenta: uncoupled\n\nbrown: blind");
    assert_eq!(key(&entity_path::ERROR_COLORS), "orange: executed\n\nbrown: blind");
    assert!(
        key(&entity_path::SCENE_KEY).ends_with("\nOther runs: uncoupled (coupling.enabled=false), blind (coupling.enabled=false)"),
        "what each changes"
    );
}

/// Runs that are executed say more than the plan of a baseline.
#[test]
fn the_plan_of_the_baseline_gives_way_to_executed_runs() {
    let (with, without) = (written(&compared()), written(&outcome()));
    let has = |chunks: &[Chunk], path: &Entity| chunks.iter().any(|chunk| *chunk.entity_path() == path.path());
    assert!(!has(&with, &entity_path::BASELINE_PATH) && has(&without, &entity_path::BASELINE_PATH));
    let beside = |chunk: &Chunk| chunk.entity_path().to_string().contains("beside");
    assert!(!without.iter().any(beside));
}

/// Together, a recording with and one without a comparison, and one in which something touches that must not, hold everything that is documented, and nothing else.
#[test]
fn entities_are_those_that_are_documented() {
    let chunks: Vec<Chunk> = [written(&compared()), written(&outcome()), TOUCHING.1.clone()].concat();
    assert_documented(&chunks, &ENTITIES.iter().map(|entity| entity.pattern).collect::<Vec<_>>());
}

/// Contract: what makes a variation another than its run is what it does otherwise, not how that is written.
#[test]
fn a_variation_differs_in_what_it_does() {
    let differences = |name: &str| -> Vec<Difference> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(name);
        let scenario = Scenario::load(&path, &LoadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
        let Work::Arm(experiment) = &scenario.work else { panic!("no arm") };
        scenario.beside.iter().map(|one| one.difference(experiment)).collect()
    };
    assert_eq!(differences("pick_and_place.toml"), [Difference::Method, Difference::Coupling]);
    assert_eq!(differences("push_object.toml"), [Difference::Coupling, Difference::Other]);
    assert_eq!(differences("cabinet_door.toml"), [Difference::Method], "its own coupling is off");
}
