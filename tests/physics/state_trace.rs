//! Traces of worlds: what they keep, and that a difference is found in the step and body in which it was made.

use cpdmp::check::{DifferenceKind, exact_difference, first_difference};
use cpdmp::recording::{read_state_log, write_state_log};
use cpdmp::simulation::WorldTrace;
use cpdmp::world::{HandWrench, StateTrace};
use nalgebra::{Point3, Vector3};

use crate::support::{LEFT_POSTURE, baxter, cube, table, world};

const STEPS: u64 = 55;
const EVERY: u64 = 10;

/// Fifty-five steps of a limp arm over a table; `push_in` is the step in which a hand pushes the arm with 1 N.
fn traced(push_in: Option<u64>) -> StateTrace {
    let mut world = world(&baxter(), &LEFT_POSTURE, &[table(0.5), cube(0.5)], [0.0, 0.0, -9.81], 0.0);
    world.trace(EVERY, Some(1..=STEPS), STEPS);
    for step in 1..=STEPS {
        let force = if push_in == Some(step) { Vector3::x() } else { Vector3::zeros() };
        world.push(HandWrench { point: Point3::new(0.6, 0.2, 0.1), force, moment: Vector3::zeros() });
        world.advance().expect("finite");
    }
    world.take_trace()
}

fn alone(trace: StateTrace) -> Vec<WorldTrace> {
    vec![WorldTrace { phase: "execute".to_owned(), number: 0, trace }]
}

#[test]
fn hashes_are_kept_every_few_steps_and_at_the_end() {
    let trace = traced(None);
    assert_eq!(trace.steps, [10, 20, 30, 40, 50, 55]);
    assert_eq!((trace.hashes.len(), trace.quantities.len()), (6, 6 * trace.bodies.len()));
    assert!(trace.bodies.contains(&"cube".to_owned()) && trace.bodies.contains(&"left_wrist".to_owned()), "{:?}", trace.bodies);
    assert_eq!(trace, traced(None), "two worlds of the same kind are the same to the bit");
}

#[test]
fn a_difference_is_found_in_the_step_in_which_it_was_made() {
    let plain = traced(None);
    for step in [1, 10, 11, 37, 55] {
        let pushed = traced(Some(step));
        let between = first_difference(&alone(plain.clone()), &alone(pushed.clone())).expect("a difference").what;
        let DifferenceKind::Between { equal_up_to, step: seen, parts } = between else { panic!("{between:?}") };
        assert!(equal_up_to.unwrap_or(0) < step && step <= seen, "{step} is after {equal_up_to:?} and up to {seen}");
        assert!(parts.iter().all(|(body, _)| body != "cube"), "nobody touched the cube: {parts:?}");
        let exact = exact_difference(&plain, &pushed).expect("a difference");
        let DifferenceKind::Exact { step: found, body, by, .. } = exact else { panic!("{exact:?}") };
        assert_eq!(found, step);
        assert!(body.starts_with("left_") && by > 0.0, "{body}");
    }
    assert_eq!(first_difference(&alone(plain.clone()), &alone(plain.clone())), None);
    assert_eq!(exact_difference(&plain, &plain), None);
}

#[test]
fn a_state_log_is_read_as_it_was_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("state_hashes.parquet");
    let mut worlds = alone(StateTrace { states: Vec::new(), ..traced(None) });
    worlds.extend(alone(StateTrace { states: Vec::new(), ..traced(Some(3)) }).into_iter().map(|world| WorldTrace { number: 1, ..world }));
    write_state_log(&path, &worlds).expect("written");
    assert_eq!(read_state_log(&path).expect("read"), worlds);
    let bytes = std::fs::read(&path).expect("there");
    for length in [0, 4, bytes.len() / 2, bytes.len() - 1] {
        std::fs::write(&path, &bytes[..length]).expect("written");
        assert!(read_state_log(&path).is_err(), "{length} bytes");
    }
}
