//! Contract: what touches is seen where and when it does, and what must not touch is also said in words.

use std::sync::LazyLock;

use cpdmp::recording::entity_path;
use cpdmp::recording::write_recording;
use cpdmp::simulation::{RunOutcome, StepRecord};
use cpdmp::world::TouchPoint;
use nalgebra::Point3;
use rerun::Points3D;
use rerun::log::Chunk;

use super::read_rrd::{chunks, experiment, rows, texts};
use crate::physics::collisions_in_engine::{IN_THE_WAY, run};

/// The run in which something touches that must not, and what its recording holds.
pub static TOUCHING: LazyLock<(RunOutcome, Vec<Chunk>)> = LazyLock::new(|| {
    let (experiment, outcome, _) = run(IN_THE_WAY);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment, &outcome, "").expect("the recording is written");
    let chunks = chunks(&path);
    (outcome, chunks)
});

/// The points of an entity, moment by moment (ns).
fn points(chunks: &[Chunk], entity: &rerun::EntityPath) -> Vec<(i64, Vec<[f32; 3]>)> {
    let component = Points3D::descriptor_positions();
    rows(chunks, entity, &component, |chunk| chunk.iter_slices::<[f32; 3]>(component.component).map(<[_]>::to_vec).collect())
}

fn labels(chunks: &[Chunk], entity: &rerun::EntityPath) -> Vec<(i64, Vec<String>)> {
    let component = Points3D::descriptor_labels();
    let read = |chunk: &Chunk| {
        chunk.iter_slices::<String>(component.component).map(|texts| texts.iter().map(ToString::to_string).collect()).collect()
    };
    rows(chunks, entity, &component, read)
}

fn ns(time_s: f64) -> i64 {
    (time_s * 1e9).round() as i64
}

fn place(point: &Point3<f64>) -> [f32; 3] {
    point.cast::<f32>().coords.into()
}

/// What the viewer shows at a time (ns): the last row until then.
fn at<T: Clone>(rows: &[(i64, Vec<T>)], time: i64) -> Vec<T> {
    rows.iter().rev().find(|row| row.0 <= time).map(|row| row.1.clone()).unwrap_or_default()
}

/// A block that was moved into the arm's way: every step shows what touches in it. At each of them a pair that must not touch is marked and named if it
/// touches or did so in the last 0.8 s, and at no other.
#[test]
fn contacts_are_seen_as_long_as_they_last() {
    let (outcome, chunks) = &*TOUCHING;
    let touches = outcome.steps.iter().map(|step| (ns(step.time_s), step.touches.iter().map(|touch| place(&touch.point)).collect()));
    let touches: Vec<(i64, Vec<[f32; 3]>)> = touches.collect();
    assert!(touches.iter().any(|(_, points)| points.len() > 1));
    assert_eq!(points(chunks, &entity_path::CONTACT.path()), touches);

    let refused: Vec<_> = outcome.collisions.iter().enumerate().filter(|(_, contact)| !contact.allowed).collect();
    assert!(!refused.is_empty());
    for (episode, contact) in refused {
        let [marks, said] = [&entity_path::FORBIDDEN, &entity_path::FORBIDDEN_LABEL].map(|entity| entity.of(&[&contact.a, &contact.b]));
        let (marks, said) = (points(chunks, &marks), labels(chunks, &said));
        let mut last_s = f64::NEG_INFINITY;
        for step in &outcome.steps {
            last_s = if step.touches.iter().any(|touch| touch.episode == episode) { step.time_s } else { last_s };
            let shown = usize::from(step.time_s < last_s + 0.8 - 1e-9);
            let now = ns(step.time_s);
            assert_eq!((at(&marks, now).len(), at(&said, now).len()), (shown, shown), "{} s: {contact:?}", step.time_s);
        }
        let words = format!("{} touches {}: peak {:.1} N", contact.a, contact.b, contact.max_force_n);
        assert!(said[0].1[0].starts_with(&words) && marks[0].1 == [place(&contact.deepest_point)], "{said:?}, {marks:?}, {contact:?}");
    }
}

/// Contract: a pair that touches again, elsewhere and not so hard, is marked there and told so; events tell each touch when it begins, and how hard it was
/// when it is over.
#[test]
fn a_pair_that_touches_again_is_told_again() {
    let mut outcome = TOUCHING.0.clone();
    let episode = outcome.collisions.iter().position(|contact| !contact.allowed).expect("something touches");
    let last = outcome.steps.last().expect("it ran").clone();
    let point = Point3::new(0.1, 0.2, 0.3);
    let again = TouchPoint { episode, distance_m: -1.2e-3, point, force_n: 3.5 };
    for (later_s, touches) in [(3.0, vec![]), (4.0, vec![again]), (4.1, vec![again]), (6.0, vec![])] {
        let step = last.step + (later_s * 1e3) as u64;
        outcome.steps.push(StepRecord { step, time_s: last.time_s + later_s, touches, ..last.clone() });
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment(), &outcome, "").expect("the recording is written");
    let chunks = chunks(&path);
    let contact = &outcome.collisions[episode];
    let [marks, said] = [&entity_path::FORBIDDEN, &entity_path::FORBIDDEN_LABEL].map(|entity| entity.of(&[&contact.a, &contact.b]));
    let [from, until, gone] = [4.0, 4.1, 4.9].map(|later_s| ns(last.time_s + later_s));
    let marks = points(&chunks, &marks);
    assert_eq!(marks[marks.len() - 2..], [(from, vec![place(&point)]), (gone, vec![])]);
    let words = format!("{} touches {}: peak 3.5 N, 1.2 mm deep", contact.a, contact.b);
    assert_eq!(at(&labels(&chunks, &said), from), [words]);
    let events = texts(&chunks, &entity_path::EVENTS, &rerun::TextLog::descriptor_text());
    let told = |time: i64, what: &str| events.iter().any(|(at, text)| *at == time && text.ends_with(what));
    assert!(told(from, &format!("{} touches {}", contact.a, contact.b)), "{events:?}");
    let over = format!("{} touched {} from {:.2} s: peak 3.5 N, 1.2 mm deep", contact.a, contact.b, last.time_s + 4.0);
    assert!(told(until, &over), "{events:?}");
    // Beside the scene a touch that is over is one line.
    let until_now = texts(&chunks, &entity_path::EVENTS_SO_FAR, &rerun::TextDocument::descriptor_text());
    let lines = |time: i64| -> Vec<String> {
        let (_, page) = until_now.iter().rfind(|(at, _)| *at <= time).expect("a page");
        page.lines().filter(|line| line.contains(&contact.a) && line.contains(&contact.b)).map(str::to_owned).collect()
    };
    let begun = format!("ERROR {:.2} s: {} touches {}", last.time_s + 4.0, contact.a, contact.b);
    assert_eq!(lines(from)[0], begun);
    assert_eq!(lines(until)[0], format!("ERROR {:.2} s: {over}", last.time_s + 4.1));
    assert!(!lines(until).contains(&begun), "{:?}", lines(until));
}

/// Contract: the first touch of two parts that may touch is told when it happens, not as a fault; what touches from the start on is no event.
#[test]
fn a_touch_that_may_be_is_told_when_it_begins() {
    let mut outcome = TOUCHING.0.clone();
    let middle_s = outcome.steps[outcome.steps.len() / 2].time_s + 0.003;
    let refused = outcome.collisions.iter().find(|contact| !contact.allowed).expect("something touches").clone();
    for (a, first_time_s) in [("lies", 0.001), ("comes", middle_s)] {
        let mut contact = refused.clone();
        (contact.a, contact.first_time_s, contact.allowed) = (a.to_owned(), first_time_s, true);
        outcome.collisions.push(contact);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment(), &outcome, "").expect("the recording is written");
    let events = texts(&chunks(&path), &entity_path::EVENTS, &rerun::TextLog::descriptor_text());
    let of = |name: &str| events.iter().filter(|(_, text)| text.contains(&format!("{name} touches"))).cloned().collect::<Vec<_>>();
    assert_eq!(of("comes"), [(ns(middle_s), format!("{middle_s:.2} s: comes touches {}", refused.b))]);
    assert_eq!(of("lies"), []);
}
