//! The recording: read back by rerun's own decoder it holds what the records say, its entities are those that are documented, and a file
//! that is cut off is told.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use cpdmp::recording::entity_path::{self, Entity, TIMELINES};
use cpdmp::recording::{RecordingError, write_recording};
use cpdmp::simulation::{Help, RunOutcome, skill_duration_s};
use nalgebra::{Matrix2, Vector2};
use rerun::external::re_log_types::LogMsg;
use rerun::log::Chunk;
use tempfile::TempDir;

use super::made_up_run::{CLOSED, COMPLIES, HOLDS, outcome, outcome_of_the_baseline};
use super::read_rrd::{chunks, experiment, messages, rows, texts};

fn written(outcome: &RunOutcome) -> (TempDir, PathBuf) {
    let folder = TempDir::new().expect("a folder can be made");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment(), outcome, "").expect("the recording is written");
    (folder, path)
}

fn nanoseconds(step: usize) -> i64 {
    50_000_000 * step as i64
}

#[test]
fn the_executed_path_is_that_of_the_records() {
    let outcome = outcome();
    let (_folder, path) = written(&outcome);
    let chunks = chunks(&path);
    let scalars = rerun::Scalars::descriptor_scalars();
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let read = |chunk: &Chunk| chunk.iter_slices::<f64>(scalars.component).map(|values| values[0].to_bits()).collect();
        let found = rows(&chunks, &entity_path::EXECUTED_MOTION.of(&[name]), &scalars, read);
        let expected = outcome.steps.iter().enumerate().map(|(i, r)| (nanoseconds(i), r.tool.translation.vector[axis].to_bits()));
        assert_eq!(found, expected.collect::<Vec<_>>(), "{name}");
    }
    let translation = rerun::Transform3D::descriptor_translation();
    let read = |chunk: &Chunk| chunk.iter_slices::<[f32; 3]>(translation.component).map(|points| points[0]).collect();
    let found = rows(&chunks, &entity_path::TOOL.path(), &translation, read);
    let place = |r: &cpdmp::simulation::StepRecord| [r.tool.translation.x as f32, r.tool.translation.y as f32, r.tool.translation.z as f32];
    assert_eq!(found, outcome.steps.iter().enumerate().map(|(i, r)| (nanoseconds(i), place(r))).collect::<Vec<_>>());
}

#[test]
fn lanes_change_when_the_records_do() {
    let (_folder, path) = written(&outcome());
    let chunks = chunks(&path);
    let state = rerun::StateChange::descriptor_state();
    let lane = |range: std::ops::Range<usize>, on: &str, off: &str| {
        [(0, off), (range.start, on), (range.end, off)].map(|(step, text)| (nanoseconds(step), text.to_owned())).to_vec()
    };
    assert_eq!(texts(&chunks, &entity_path::COMPLIANCE_LANE, &state), lane(COMPLIES, "complies", "stiff"));
    assert_eq!(texts(&chunks, &entity_path::PERSON_LANE, &state), lane(HOLDS, "holds", "hands off"));
    assert_eq!(texts(&chunks, &entity_path::GRIPPER_LANE, &state), lane(CLOSED, "closed", "open"));
}

/// Contract: a skill that leaves the gripper as it is has no lane of it.
#[test]
fn a_gripper_that_stays_as_it_is_has_no_lane() {
    let mut outcome = outcome();
    let gripper = outcome.skill.gripper.as_mut().expect("the skill moves it");
    gripper.openings.fill(0.0);
    let (_folder, path) = written(&outcome);
    let chunks = chunks(&path);
    assert!(chunks.iter().all(|chunk| *chunk.entity_path() != entity_path::GRIPPER_LANE.path()));
    assert!(chunks.iter().any(|chunk| *chunk.entity_path() == entity_path::PERSON_LANE.path()));
}

#[test]
fn events_tell_what_happened_in_order() {
    let (_folder, path) = written(&outcome());
    let found = texts(&chunks(&path), &entity_path::EVENTS, &rerun::TextLog::descriptor_text());
    let expected = [
        (0, "the skill starts, stiff"),
        (20, "closest to block_1: left_hand at 20 mm"),
        (COMPLIES.start, "the arm complies from here (state 1)"),
        (HOLDS.start, "the person takes hold"),
        (CLOSED.start, "the gripper closes"),
        (HOLDS.end, "the person lets go (peak 10.8 N)"),
        (COMPLIES.end, "the arm is stiff from here (state 3)"),
        (CLOSED.end, "the gripper opens"),
        (110, "the skill ends"),
    ];
    let timed = expected.map(|(step, text)| (nanoseconds(step), format!("{:.2} s: {text}", 0.05 * step as f64)));
    assert_eq!(found, timed);
    // Beside the scene stands what has happened until then, the last one first, as much as there is room for.
    let so_far = texts(&chunks(&path), &entity_path::EVENTS_SO_FAR, &rerun::TextDocument::descriptor_text());
    let until = |now: i64| {
        let past: Vec<&str> = timed.iter().rev().filter(|event| event.0 <= now).map(|(_, text)| text.as_str()).collect();
        let earlier = (past.len() > 8).then_some("earlier: see All events");
        past.into_iter().take(8).chain(earlier).collect::<Vec<_>>().join("\n")
    };
    let mut moments = timed.each_ref().map(|event| event.0).to_vec();
    moments.dedup();
    assert_eq!(so_far, moments.iter().map(|now| (*now, until(*now))).collect::<Vec<_>>());
}

/// Contract: the page below the scene says how the run ended, in the words that were given.
#[test]
fn the_result_is_told() {
    let folder = TempDir::new().expect("a folder can be made");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment(), &outcome(), "made_up, seed 1: passed").expect("the recording is written");
    let result = chunks(&path).into_iter().filter(|chunk| *chunk.entity_path() == entity_path::RESULT.path());
    let text = rerun::TextDocument::descriptor_text().component;
    let told: Vec<String> =
        result.flat_map(|chunk| chunk.iter_slices::<String>(text).map(|texts| texts[0].to_string()).collect::<Vec<_>>()).collect();
    assert_eq!(told, ["made_up, seed 1: passed"]);
}

/// Contract: all states of a plot are one entity, of each the upper and the lower half of its ellipse: at two standard deviations of the
/// model's Gaussian, at times that are rounded to nanoseconds.
#[test]
fn outlines_over_the_phase_are_the_gaussians_of_the_model() {
    let outcome = outcome();
    let (_folder, path) = written(&outcome);
    let (motion, scalars) = (&outcome.skill.motion, rerun::Scalars::descriptor_scalars());
    let (phmm, experiment) = (motion.phmm().expect("states"), experiment());
    let phi = motion.parameters.features.at(&outcome.skill.request(&experiment.question()).expect("answered").theta);
    let duration_s = skill_duration_s(&outcome.steps).expect("it ends");
    let chunks = chunks(&path);
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let read = |chunk: &Chunk| chunk.iter_slices::<f64>(scalars.component).map(<[f64]>::to_vec).collect();
        let found: Vec<(i64, Vec<f64>)> = rows(&chunks, &entity_path::FORCING_OUTLINES.of(&[name]), &scalars, read);
        let mut on_each = vec![0; phmm.states()];
        for (time_ns, values) in &found {
            assert_eq!(values.len(), 2 * phmm.states());
            for (state, halves) in values.chunks_exact(2).enumerate().filter(|(_, halves)| halves[0].is_finite()) {
                let (mean, all) = (phmm.mean_at(state, &phi), &phmm.covariances[state]);
                let covariance = Matrix2::new(all[(0, 0)], all[(0, axis + 1)], all[(axis + 1, 0)], all[(axis + 1, axis + 1)]);
                let inverse = covariance.try_inverse().expect("regular");
                let input = motion.phase_input.at(*time_ns as f64 * 1e-9 / duration_s, motion.alpha);
                assert!(halves[0] >= halves[1]);
                for value in halves {
                    let away = Vector2::new(input, *value) - Vector2::new(mean[0], mean[axis + 1]);
                    assert!(((away.transpose() * inverse * away)[0].sqrt() - 2.0).abs() < 1e-3, "state {state} along {name}");
                }
                on_each[state] += 1;
            }
        }
        assert!(on_each.iter().all(|rows| *rows > 20), "{on_each:?}");
    }
}

#[test]
fn timelines_are_those_that_are_documented() {
    let (_folder, path) = written(&outcome());
    let chunks = chunks(&path);
    let timelines: BTreeSet<&str> = chunks.iter().flat_map(|chunk| chunk.timelines().keys().map(|name| name.as_str())).collect();
    assert_eq!(timelines, TIMELINES.map(|timeline| timeline.name).into_iter().collect());
}

#[test]
fn the_layout_is_in_the_file() {
    let (_folder, path) = written(&outcome());
    let messages = messages(&path);
    let activation = messages.iter().position(|message| matches!(message, LogMsg::BlueprintActivationCommand(_)));
    let data = messages.iter().position(|message| matches!(message, LogMsg::ArrowMsg(id, _) if id.is_recording()));
    assert!(activation.is_some() && data.is_some());
    let camera = messages.iter().any(|message| match message {
        LogMsg::ArrowMsg(id, message) if id.is_blueprint() => {
            Chunk::from_arrow_msg(message).is_ok_and(|chunk| chunk.entity_path().to_string().ends_with("EyeControls3D"))
        }
        _ => false,
    });
    assert!(camera, "the layout says where the camera stands");
}

#[test]
fn runs_without_states_or_steps_are_recorded_too() {
    written(&outcome_of_the_baseline());
    written(&RunOutcome { steps: Vec::new(), ..outcome() });
}

#[test]
fn a_recording_that_cannot_be_written_names_the_file() {
    let error = write_recording(Path::new("/nowhere/recording.rrd"), &experiment(), &outcome(), "").unwrap_err();
    assert!(matches!(error, RecordingError::Io { .. }) && error.to_string().contains("/nowhere/recording.rrd"), "{error}");
    if cfg!(target_os = "linux") {
        let error = write_recording(Path::new("/dev/full"), &experiment(), &outcome(), "").expect_err("the disk is full");
        assert!(error.to_string().contains("/dev/full"), "{error}");
    }
}

/// What entity `entity` says on the timeline `name`.
fn over<T>(chunks: &[Chunk], name: &str, entity: &Entity, names: &[&str], read: impl Fn(&Chunk) -> Vec<T>) -> Vec<T> {
    let timeline = rerun::TimelineName::try_new(name).expect("a good name");
    let of_entity = chunks.iter().filter(|chunk| *chunk.entity_path() == entity.of(names) && chunk.timelines().contains_key(&timeline));
    of_entity.flat_map(read).collect()
}

/// Contract: nothing is drawn between two demonstrations, which no movement leads from one to the other; numbers and names are those of the
/// demonstrations in their order.
#[test]
fn demonstrations_on_one_timeline_are_apart() {
    let outcome = outcome();
    let (_folder, path) = written(&outcome);
    let chunks = chunks(&path);
    let (scalars, text) = (rerun::Scalars::descriptor_scalars().component, rerun::TextDocument::descriptor_text().component);
    let state = rerun::StateChange::descriptor_state().component;
    let values = |chunk: &Chunk| chunk.iter_slices::<f64>(scalars).map(|values| values[0]).collect::<Vec<_>>();
    let words =
        |component| move |chunk: &Chunk| chunk.iter_slices::<String>(component).map(|texts| texts[0].to_string()).collect::<Vec<_>>();
    let lessons: Vec<&str> = outcome.lessons.iter().map(|lesson| lesson.name.as_str()).collect();
    let replays: Vec<&str> = outcome.dataset.demonstrations.iter().map(|demonstration| demonstration.name.as_str()).collect();
    for (timeline, plot, lane, name, expected) in [
        ("teaching_time", entity_path::TEACHING_MOTION, entity_path::TEACHING_LANE, entity_path::TEACHING_NAME, lessons),
        ("replay_time", entity_path::REPLAY_FORCE, entity_path::REPLAY_LANE, entity_path::REPLAY_NAME, replays),
    ] {
        let drawn = over(&chunks, timeline, &plot, &["x"], values);
        let pieces: Vec<&[f64]> = drawn.split(|value| value.is_nan()).filter(|piece| !piece.is_empty()).collect();
        assert_eq!(pieces.len(), expected.len(), "{timeline}");
        assert!(pieces.iter().all(|piece| piece.len() > 5), "{timeline}");
        let numbers: Vec<String> = (1..=expected.len()).map(|number| number.to_string()).collect();
        assert_eq!(over(&chunks, timeline, &lane, &[], words(state)), numbers);
        assert_eq!(over(&chunks, timeline, &name, &[], words(text)), expected);
    }
}

/// Contract: a smallest distance is shown while it happens, in words that say of what, which stand away from it.
#[test]
fn the_smallest_distance_is_said_in_words_away_from_it() {
    let outcome = outcome();
    let (_folder, path) = written(&outcome);
    let chunks = chunks(&path);
    let labels = rerun::Points3D::descriptor_labels();
    let said = |chunk: &Chunk| {
        chunk.iter_slices::<String>(labels.component).map(|texts| texts.iter().map(ToString::to_string).collect::<Vec<_>>()).collect()
    };
    let found = rows(&chunks, &entity_path::NEAREST_LABEL.of(&["block_1"]), &labels, said);
    let words = vec!["left_hand 20 mm from block_1".to_owned()];
    assert_eq!(found, [(600_000_000, words), (1_800_000_000, Vec::new())]);
    let places = rerun::Points3D::descriptor_positions();
    let place = |chunk: &Chunk| {
        let points = chunk.iter_slices::<[f32; 3]>(places.component);
        points.filter_map(|points| points.first().copied()).collect::<Vec<[f32; 3]>>()
    };
    let found = rows(&chunks, &entity_path::NEAREST_LABEL.of(&["block_1"]), &places, place);
    let distance = |to: [f64; 3]| (nalgebra::Vector3::from(found[0].1.map(f64::from)) - nalgebra::Vector3::from(to)).norm();
    assert!(distance([0.01, 0.0, 0.0]) > 0.2, "{found:?}");
}

/// Contract: where nobody helps, no force of a person is drawn, and the key does not speak of one.
#[test]
fn a_person_who_does_not_help_has_no_force() {
    let folder = TempDir::new().expect("a folder can be made");
    let text = rerun::TextDocument::descriptor_text().component;
    for (help, helps) in [(experiment().execution.help, true), (Help::None, false)] {
        let mut experiment = experiment();
        experiment.execution.help = help;
        let path = folder.path().join(format!("{helps}.rrd"));
        write_recording(&path, &experiment, &outcome(), "").expect("the recording is written");
        let chunks = chunks(&path);
        assert_eq!(chunks.iter().any(|chunk| *chunk.entity_path() == entity_path::PERSON.of(&["x"])), helps);
        let keys = chunks.iter().filter(|chunk| *chunk.entity_path() == entity_path::FORCE_COLORS.path());
        let key: String =
            keys.flat_map(|chunk| chunk.iter_slices::<String>(text).map(|texts| texts[0].to_string()).collect::<Vec<_>>()).collect();
        assert_eq!(key.contains("vermilion: person"), helps, "{key}");
        assert!(key.starts_with("blue: measured, smoothed\nyellow: expected\nwhite: unexpected"), "{key}");
    }
}
