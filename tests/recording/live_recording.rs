//! A recording that grows with its run: it says what the one says that is written afterwards, can be read wherever it is cut off, and
//! neither a viewer that hangs nor one that is not there keeps the run waiting.

use std::collections::BTreeSet;
use std::net::{SocketAddr, TcpListener};
use std::path::Path;
use std::time::{Duration, Instant};

use cpdmp::recording::entity_path::{self, Entity};
use cpdmp::recording::{LiveRecording, write_recording};
use cpdmp::simulation::RunOutcome;
use cpu_time::ThreadTime;
use rerun::EntityPath;
use rerun::external::re_log_encoding::DecoderApp;
use rerun::log::Chunk;

use super::made_up_run::{STEPS, outcome};
use super::read_rrd::{chunks, experiment, rows, texts};

/// Longer than any machine needs for the recording.
const PATIENCE: Duration = Duration::from_secs(60);

/// The run as it goes on: nothing is known before it happens.
fn tell(recording: &LiveRecording, run: &RunOutcome) {
    recording.taught(&run.robot, &run.lessons);
    recording.planned(&RunOutcome { steps: Vec::new(), collisions: Vec::new(), clearances: Vec::new(), state_hash: 0, ..run.clone() });
    run.steps.iter().for_each(|record| recording.stepped(record));
}

fn grown(path: &Path, run: &RunOutcome) -> Vec<Chunk> {
    let recording = LiveRecording::to_file(path, &experiment());
    tell(&recording, run);
    assert!(recording.finish(PATIENCE), "the recording catches up");
    chunks(path)
}

/// A port at which nobody listens.
fn free_port() -> SocketAddr {
    TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr()).expect("a free port")
}

#[test]
fn it_says_what_the_recording_says_that_is_written_afterwards() {
    let folder = tempfile::tempdir().expect("a folder");
    // What is only known at the end is in the recording of the end: here nothing is.
    let run = RunOutcome { clearances: Vec::new(), ..outcome() };
    let live = grown(&folder.path().join("live.rrd"), &run);
    let path = folder.path().join("whole.rrd");
    write_recording(&path, &experiment(), &run, "").expect("it is written");
    let whole = chunks(&path);

    let scalars = rerun::Scalars::descriptor_scalars();
    let read = |chunk: &Chunk| chunk.iter_slices::<f64>(scalars.component).map(|values| values[0].to_bits()).collect::<Vec<u64>>();
    let curves: BTreeSet<EntityPath> = whole.iter().filter(|chunk| !read(chunk).is_empty()).map(|c| c.entity_path().clone()).collect();
    let of_steps = |entity: &&EntityPath| rows(&whole, entity, &scalars, read).len() == STEPS;
    let compared: Vec<&EntityPath> = curves.iter().filter(of_steps).collect();
    assert!(compared.len() > 20, "{compared:?}");
    for entity in compared {
        assert_eq!(rows(&live, entity, &scalars, read), rows(&whole, entity, &scalars, read), "{entity}");
    }
    let state = rerun::StateChange::descriptor_state();
    let text = rerun::TextLog::descriptor_text();
    let lanes = [entity_path::COMPLIANCE_LANE, entity_path::STATE_LANE, entity_path::GRIPPER_LANE, entity_path::PERSON_LANE];
    let told = lanes.iter().map(|lane| (lane, &state)).chain([(&entity_path::EVENTS, &text)]);
    for (entity, component) in told.collect::<Vec<(&Entity, _)>>() {
        let expected = texts(&whole, entity, component);
        assert!(!expected.is_empty());
        assert_eq!(texts(&live, entity, component), expected, "{}", entity.pattern);
    }
    let translation = rerun::Transform3D::descriptor_translation();
    let read = |chunk: &Chunk| chunk.iter_slices::<[f32; 3]>(translation.component).map(|points| points[0]).collect::<Vec<[f32; 3]>>();
    let entity = entity_path::ROBOT_BODY.of(&["left_hand"]);
    assert_eq!(rows(&live, &entity, &translation, read), rows(&whole, &entity, &translation, read));
}

/// What an entity says over the time of the teaching, in the order of time.
fn taught(chunks: &[Chunk], entity: &Entity, names: &[&str]) -> Vec<(i64, u64)> {
    let timeline = rerun::TimelineName::try_new("teaching_time").expect("a good name");
    let component = rerun::Scalars::descriptor_scalars().component;
    let of_entity = chunks.iter().filter(|chunk| *chunk.entity_path() == entity.of(names) && !chunk.is_static());
    let timed = of_entity.flat_map(|chunk| {
        let times = chunk.iter_component_indices(timeline, component).map(|(time, _)| time.as_i64()).collect::<Vec<_>>();
        times.into_iter().zip(chunk.iter_slices::<f64>(component).map(|values| values[0].to_bits()).collect::<Vec<_>>())
    });
    let mut rows: Vec<(i64, u64)> = timed.collect();
    rows.sort_unstable();
    rows
}

/// Contract: lessons are in the file as they are made, in whatever order they end, each where it stands among all; a run that is killed before the
/// last one leaves those that were made.
#[test]
fn lessons_are_there_as_soon_as_they_are_made() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = outcome();
    let path = folder.path().join("whole.rrd");
    write_recording(&path, &experiment(), &run, "").expect("it is written");
    let whole = taught(&chunks(&path), &entity_path::TEACHING_MOTION, &["x"]);
    let told = |name: &str, order: &[usize], all: bool| {
        let path = folder.path().join(name);
        let recording = LiveRecording::to_file(&path, &experiment());
        order.iter().for_each(|number| recording.lesson(&run.robot, *number, &run.lessons[*number]));
        if all {
            recording.taught(&run.robot, &run.lessons);
        }
        assert!(recording.finish(PATIENCE), "the recording catches up");
        taught(&chunks(&path), &entity_path::TEACHING_MOTION, &["x"])
    };
    let each = whole.len() / run.lessons.len();
    assert!(each > 5 && run.lessons.len() == 2, "{} rows", whole.len());
    assert_eq!(told("first.rrd", &[0], false), whole[..each]);
    assert_eq!(told("second.rrd", &[1], false), whole[each..]);
    assert_eq!(told("both.rrd", &[1, 0], false), whole);
    assert_eq!(told("one_was_lost.rrd", &[1], true), whole);
}

/// A recording that was cut off gives back everything before the cut.
#[test]
fn it_can_be_read_wherever_it_is_cut_off() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("live.rrd");
    grown(&path, &outcome());
    let whole = std::fs::read(&path).expect("it is there");
    let messages = |bytes: &[u8]| DecoderApp::decode_lazy(bytes).take_while(Result::is_ok).count();
    let counts: Vec<usize> = (1..=20).map(|part| messages(&whole[..whole.len() * part / 20])).collect();
    assert!(counts.is_sorted() && counts[0] < counts[10] && counts[10] < counts[19], "{counts:?}");
}

/// Contract: telling takes less than a millisecond whatever the viewer does, and a run that is over waits no longer than it wants to.
#[test]
fn a_viewer_that_hangs_or_is_not_there_keeps_nobody_waiting() {
    let run = outcome();
    // Connections are taken up by the system, and never answered.
    let hangs = TcpListener::bind("127.0.0.1:0").expect("a port");
    for address in [hangs.local_addr().expect("its address"), free_port()] {
        let recording = LiveRecording::to_viewer(address, &experiment());
        tell(&recording, &run);
        let (mut waits, mut worked, waited) = (Vec::with_capacity(20_000), Duration::ZERO, waits_so_far());
        for record in run.steps.iter().cycle().take(20_000) {
            let (started, working) = (Instant::now(), ThreadTime::now());
            recording.stepped(record);
            worked = worked.max(working.elapsed());
            waits.push(started.elapsed());
        }
        let waited = waits_so_far().zip(waited).map(|(after, before)| after - before);
        waits.sort();
        // Of the longest call what this thread did itself: the rest is the machine's.
        assert!(worked < Duration::from_millis(1), "{worked:?}");
        println!("longest call {:?}, of which the thread worked at most {worked:?}; it waited {waited:?} times", waits[waits.len() - 1]);
        // It waits for nothing. Locks of the allocator, which all tests share, are held now and then; who waits for room does so thousands of times.
        assert!(waited.is_none_or(|waited| waited < 200), "{waited:?}");
        // A machine that does something else for a moment is not the recording's fault.
        assert!(waits[waits.len() * 99 / 100] < Duration::from_millis(1), "{:?}", &waits[waits.len() - 30..]);
        let started = Instant::now();
        recording.finish(Duration::from_millis(300));
        assert!(started.elapsed() < Duration::from_secs(2), "{:?}", started.elapsed());
    }
}

/// How often this thread has waited for something so far; what interrupts it does not count. `None` where the system does not say.
fn waits_so_far() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/thread-self/status").ok()?;
    status.lines().find_map(|line| line.strip_prefix("voluntary_ctxt_switches:"))?.trim().parse().ok()
}

/// Contract: as long as a run goes on its recording says so, and one that ends before its execution says how.
#[test]
fn a_recording_that_ends_early_says_how() {
    let (folder, run) = (tempfile::tempdir().expect("a folder"), outcome());
    let told = |result: Option<&str>| -> Vec<String> {
        let path = folder.path().join("live.rrd");
        let recording = LiveRecording::to_file(&path, &experiment());
        recording.lesson(&run.robot, 0, &run.lessons[0]);
        result.into_iter().for_each(|result| recording.ended(result));
        assert!(recording.finish(PATIENCE), "the recording catches up");
        let text = rerun::TextDocument::descriptor_text().component;
        let of_result = chunks(&path).into_iter().filter(|chunk| *chunk.entity_path() == entity_path::RESULT.path());
        of_result.flat_map(|chunk| chunk.iter_slices::<String>(text).map(|texts| texts[0].to_string()).collect::<Vec<_>>()).collect()
    };
    let not_over = format!("{}, seed {}: not over", experiment().name, experiment().seed);
    assert_eq!(told(None), std::slice::from_ref(&not_over));
    assert_eq!(told(Some("time limit")), [not_over, "time limit".to_owned()]);
}
