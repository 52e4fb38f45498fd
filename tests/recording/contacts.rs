//! Contract: what touches is seen where and when it does, and what must not touch is also said in words.

use std::sync::LazyLock;

use cpdmp::recording::entity_path::{self, Entity};
use cpdmp::recording::write_recording;
use cpdmp::simulation::RunOutcome;
use nalgebra::Point3;
use rerun::Points3D;
use rerun::log::Chunk;

use super::read_rrd::{chunks, rows};
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

/// A block that was moved into the arm's way: every step shows what touches in it, red unless it may; every pair that must not touch is marked and
/// named from its first touch to 0.8 s after its last.
#[test]
fn contacts_are_seen_as_long_as_they_last() {
    let (outcome, chunks) = &*TOUCHING;
    let place = |point: &Point3<f64>| point.cast::<f32>().coords.into();
    let touches = outcome.steps.iter().map(|step| (ns(step.time_s), step.touches.iter().map(|touch| place(&touch.point)).collect()));
    let touches: Vec<(i64, Vec<[f32; 3]>)> = touches.collect();
    assert!(touches.iter().any(|(_, points)| points.len() > 1));
    assert_eq!(points(chunks, &entity_path::CONTACT.path()), touches);

    let refused: Vec<_> = outcome.collisions.iter().filter(|contact| !contact.allowed).collect();
    assert!(!refused.is_empty());
    for contact in refused {
        let of = |entity: &Entity| entity.of(&[&contact.a, &contact.b]);
        let times = [contact.first_time_s, contact.last_time_s + 0.8].map(ns);
        let marks = points(chunks, &of(&entity_path::FORBIDDEN));
        assert_eq!(marks, [(times[0], vec![place(&contact.deepest_point)]), (times[1], vec![])], "{contact:?}");
        let said = labels(chunks, &of(&entity_path::FORBIDDEN_LABEL));
        assert_eq!(said.iter().map(|(time, words)| (*time, words.len())).collect::<Vec<_>>(), [(times[0], 1), (times[1], 0)]);
        let words = format!("{} touches {}: up to {:.1} N", contact.a, contact.b, contact.max_force_n);
        assert!(said[0].1[0].starts_with(&words), "{said:?}, not {words}");
    }
}
