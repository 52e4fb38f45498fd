//! Contract: what is seen belongs to one page and its timelines, arrows stay in the picture, and words say what is the case.

use std::collections::BTreeSet;

use cpdmp::recording::entity_path::{self, Entity};
use cpdmp::recording::{LiveRecording, write_recording};
use cpdmp::simulation::RunOutcome;
use cpdmp::world::{ObjectKind, Quantity};
use nalgebra::Vector2;
use rerun::FillMode;
use rerun::log::Chunk;
use tempfile::TempDir;

use super::beside::compared;
use super::made_up_run::{STEPS, outcome};
use super::read_rrd::{chunks, experiment, texts};

fn written(outcome: &RunOutcome) -> Vec<Chunk> {
    let folder = TempDir::new().expect("a folder can be made");
    let path = folder.path().join("recording.rrd");
    write_recording(&path, &experiment(), outcome, "").expect("the recording is written");
    chunks(&path)
}

/// The components of a chunk, without their archetypes.
fn components(chunk: &Chunk) -> Vec<String> {
    let name = |descriptor: &rerun::ComponentDescriptor| descriptor.component.to_string().rsplit(':').next().unwrap_or_default().to_owned();
    chunk.components().component_descriptors().map(name).collect()
}

/// The timelines of everything at or below a path that is not static, entity by entity.
fn timelines(chunk: &Chunk) -> Vec<&str> {
    chunk.timelines().keys().map(|name| name.as_str()).collect()
}

/// Contract: whoever looks at a page on the timeline of another one sees nothing, rather than shapes without their places. Only how things look
/// holds at all times.
#[test]
fn a_page_is_empty_on_the_timeline_of_another() {
    let looks = ["colors", "radii", "line_radii", "show_labels", "xyz"];
    for run in [outcome(), compared()] {
        let chunks = written(&run);
        for (page, own) in [("/world", &["phase", "sim_time", "step"][..]), ("/teaching", &["teaching_time"])] {
            let of_page = chunks.iter().filter(|chunk| format!("{}/", chunk.entity_path()).starts_with(&format!("{page}/")));
            let mut seen = 0;
            for chunk in of_page {
                let (name, held) = (chunk.entity_path(), components(chunk));
                if chunk.is_static() {
                    assert!(held.iter().all(|component| looks.contains(&component.as_str())), "{name} always shows {held:?}");
                } else {
                    let mut found = timelines(chunk);
                    found.sort_unstable();
                    assert_eq!(found, own, "{name}");
                    seen += 1;
                }
            }
            assert!(seen > 20, "{page}");
        }
    }
}

/// Contract: what hides the paths is translucent, whether the recording grew with its run or not; what hides none is solid, and so is what everything
/// stands on.
#[test]
fn what_hides_the_paths_is_translucent() {
    let (folder, run) = (TempDir::new().expect("a folder can be made"), outcome());
    let mut experiment = experiment();
    let [table, block, hood] = [0, 1, 4].map(|index: usize| experiment.objects[index].name.clone());
    // A hood over all of it.
    let inner_size_m = Vector2::new(1.0, 1.0);
    experiment.objects[4].kind =
        ObjectKind::Basket { inner_size_m, wall_height_m: 1.0, wall_thickness_m: 0.02, friction: Quantity::Value(0.5) };
    experiment.objects[4].center_m = Vector2::new(0.6, 0.0);
    let [whole, live] = ["whole.rrd", "live.rrd"].map(|name| folder.path().join(name));
    write_recording(&whole, &experiment, &run, "").expect("the recording is written");
    let recording = LiveRecording::to_file(&live, &experiment);
    recording.taught(&run.robot, &run.lessons);
    recording.planned(&RunOutcome { steps: Vec::new(), ..run.clone() });
    run.steps.iter().for_each(|record| recording.stepped(record));
    assert!(recording.finish(std::time::Duration::from_secs(60)), "the recording catches up");
    let fill = rerun::Boxes3D::descriptor_fill_mode().component;
    for chunks in [chunks(&whole), chunks(&live)] {
        let fills = |name: &str| -> BTreeSet<u8> {
            let entity = entity_path::OBJECT_SHAPE.of(&[name, "boxes"]);
            let of_entity = chunks.iter().filter(|chunk| *chunk.entity_path() == entity);
            of_entity.flat_map(|chunk| chunk.iter_slices::<u8>(fill).flatten().copied().collect::<Vec<_>>()).collect()
        };
        let [solid, translucent] = [FillMode::Solid, FillMode::TransparentFillMajorWireframe].map(|mode| BTreeSet::from([mode as u8]));
        assert_eq!([fills(&table), fills(&block), fills(&hood)], [solid.clone(), solid, translucent]);
    }
}

/// The first moment of an entity on a timeline (ns).
fn first(chunks: &[Chunk], timeline: &str, entity: &rerun::EntityPath) -> Option<i64> {
    let timeline = rerun::TimelineName::try_new(timeline).expect("a good name");
    let of_entity = chunks.iter().filter(|chunk| chunk.entity_path() == entity);
    of_entity.filter_map(|chunk| chunk.timelines().get(&timeline)).map(|column| column.time_range().min().as_i64()).min()
}

/// Contract: a body is seen as soon as it has a place, whichever lesson is told first.
#[test]
fn bodies_have_their_shapes_from_their_first_place_on() {
    let (run, folder) = (outcome(), TempDir::new().expect("a folder"));
    let named: Vec<&str> = run.robot.bodies.iter().filter(|body| !body.visuals.is_empty()).map(|body| body.name.as_str()).collect();
    let check = |chunks: &[Chunk], timeline: &str, body: &Entity, shape: &Entity| {
        for name in &named {
            let place = first(chunks, timeline, &body.of(&[name])).expect("a place");
            let shapes = ["boxes", "cylinders", "spheres"].map(|kind| first(chunks, timeline, &shape.of(&[name, kind])));
            assert!(shapes.iter().any(Option::is_some), "{name} has no shape");
            assert!(shapes.iter().flatten().all(|time| *time == place), "{name}: {shapes:?}, {place}");
        }
    };
    let whole = written(&run);
    check(&whole, "sim_time", &entity_path::ROBOT_BODY, &entity_path::ROBOT_SHAPE);
    check(&whole, "teaching_time", &entity_path::TEACHING_BODY, &entity_path::TEACHING_BODY_SHAPE);
    for (name, order) in [("first", &[0][..]), ("second", &[1]), ("in_order", &[0, 1]), ("turned", &[1, 0])] {
        let path = folder.path().join(name);
        let recording = LiveRecording::to_file(&path, &experiment());
        order.iter().for_each(|number| recording.lesson(&run.robot, *number, &run.lessons[*number]));
        assert!(recording.finish(std::time::Duration::from_secs(60)), "the recording catches up");
        check(&chunks(&path), "teaching_time", &entity_path::TEACHING_BODY, &entity_path::TEACHING_BODY_SHAPE);
    }
}

/// Contract: no force is drawn longer than 0.35 m, however large it is, and all start beside the tool.
#[test]
fn no_arrow_leaves_the_picture() {
    let mut run = outcome();
    run.steps.iter_mut().for_each(|step| step.wrench *= 1000.0);
    let chunks = written(&run);
    let of = |entity: &Entity, component: rerun::ComponentDescriptor| -> Vec<[f32; 3]> {
        let of_entity = chunks.iter().filter(|chunk| *chunk.entity_path() == entity.path());
        of_entity.flat_map(|chunk| chunk.iter_slices::<[f32; 3]>(component.component).flatten().copied().collect::<Vec<_>>()).collect()
    };
    let vectors = of(&entity_path::WRENCH_ARROW, rerun::Arrows3D::descriptor_vectors());
    let lengths: Vec<f32> = vectors.iter().map(|vector| nalgebra::Vector3::from(*vector).norm()).collect();
    assert!(lengths.len() > STEPS / 2 && lengths.iter().all(|length| *length <= 0.35 + 1e-6), "{lengths:?}");
    let origins = of(&entity_path::WRENCH_ARROW, rerun::Arrows3D::descriptor_origins());
    assert_eq!(origins.len(), lengths.len());
    for origin in origins {
        let near = |step: &cpdmp::simulation::StepRecord| (step.tool.translation.vector.cast() - nalgebra::Vector3::from(origin)).norm();
        let nearest = run.steps.iter().map(near).fold(f32::INFINITY, f32::min);
        assert!(nearest > 0.0, "{origin:?}");
    }
}

/// Contract: what the last state does about forces ends with the skill, in lanes and in events.
#[test]
fn a_skill_that_is_over_minimises_nothing() {
    let mut run = outcome();
    for (i, step) in run.steps.iter_mut().enumerate() {
        (step.beta, step.activation) = (1.0, if i < 112 { 0.9 } else { 0.0 });
    }
    let chunks = written(&run);
    let lane = texts(&chunks, &entity_path::COMPLIANCE_LANE, &rerun::StateChange::descriptor_state());
    assert_eq!(lane, [(0, "minimises force error".to_owned()), (112 * 50_000_000, "stiff".to_owned())]);
    let events = texts(&chunks, &entity_path::EVENTS, &rerun::TextLog::descriptor_text());
    assert!(events.iter().any(|(_, text)| text == "5.60 s: the arm is stiff from here: the skill is over"), "{events:?}");
    let label = texts(&chunks, &entity_path::ACTIVE_LABEL, &rerun::Points3D::descriptor_labels());
    assert_eq!(label.last(), Some(&(112 * 50_000_000, "the skill is over: stiff".to_owned())), "{label:?}");
}
