//! The recording of a planar experiment: read back by rerun's own decoder it holds the paths, forcing terms and states of the outcome, and
//! its entities are those that are documented.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::sync::LazyLock;

use cpdmp::planar::{
    Guidance, Method, Movement, ObstacleAvoidanceSettings, PlanarOutcome, TwoSidedObstacleSettings, obstacle_avoidance, two_sided_obstacle,
};
use cpdmp::recording::entity_path::Entity;
use cpdmp::recording::planar_entity::{self, ENTITIES, PHASE_INPUT};
use cpdmp::recording::write_planar_recording;
use nalgebra::{Matrix2, Vector2};
use rerun::EntityPath;
use rerun::external::re_log_encoding::DecoderApp;
use rerun::external::re_log_types::LogMsg;
use rerun::log::Chunk;

use super::documented::assert_documented;

/// The experiment with small models, and the data of its recording without the layout.
static RECORDED: LazyLock<(PlanarOutcome, Vec<Chunk>)> = LazyLock::new(|| {
    let mut settings = TwoSidedObstacleSettings::default();
    (settings.learning.motion.states, settings.learning.motion.max_iterations) = (4, 20);
    settings.tpgmm.components = 4;
    let outcome = two_sided_obstacle(&settings, 0, &|| true).expect("it can be learned");
    let chunks = recorded(&outcome);
    (outcome, chunks)
});

/// The data of the recording of an outcome, without the layout.
fn recorded(outcome: &PlanarOutcome) -> Vec<Chunk> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("recording.rrd");
    write_planar_recording(&path, ("made_up", 0), outcome, "made_up, seed 0: passed").expect("written");
    let file = BufReader::new(File::open(&path).expect("there"));
    let data = DecoderApp::decode_lazy(file).filter_map(|message| match message.expect("it can be decoded") {
        LogMsg::ArrowMsg(id, message) if id.is_recording() => Some(Chunk::from_arrow_msg(&message).expect("a chunk")),
        _ => None,
    });
    data.collect()
}

/// What a page in a recording says.
fn page(chunks: &[Chunk], entity: &Entity) -> String {
    let text = rerun::TextDocument::descriptor_text().component;
    let of_page = chunks.iter().filter(|chunk| *chunk.entity_path() == entity.path());
    of_page.flat_map(|chunk| chunk.iter_slices::<String>(text).flatten().map(|words| words.to_string()).collect::<Vec<_>>()).collect()
}

/// The rows of scalars of an entity: time on the timeline, values.
fn scalars(entity: &EntityPath) -> Vec<(i64, Vec<f64>)> {
    let timeline = rerun::TimelineName::try_new(PHASE_INPUT.name).expect("a good name");
    let component = rerun::Scalars::descriptor_scalars().component;
    let of_entity = RECORDED.1.iter().filter(|chunk| chunk.entity_path() == entity && !chunk.is_static());
    let rows = of_entity.flat_map(|chunk| {
        let times = chunk.iter_component_indices(timeline, component).map(|(time, _)| time.as_i64());
        times.zip(chunk.iter_slices::<f64>(component).map(<[f64]>::to_vec)).collect::<Vec<_>>()
    });
    rows.collect()
}

#[test]
fn forcing_terms_and_states_are_those_of_the_outcome() {
    let outcome = &RECORDED.0;
    let curve = outcome.forcing.iter().find(|curve| curve.method == Some(Method::Cpdmp) && !curve.taught).expect("a curve");
    let situation = curve.theta.iter().map(|(name, value)| format!("{name} = {value}")).collect::<Vec<_>>().join(", ");
    for (axis, name) in ["x", "y"].iter().enumerate() {
        let names = ["with_side", "cpdmp", name, &situation];
        let rows = scalars(&planar_entity::CURVE.of(&names));
        let expected = curve.phase.iter().zip(&curve.forcing_m).map(|(input, f)| ((input * 1e9).round() as i64, vec![f[axis]]));
        assert_eq!(rows, expected.collect::<Vec<_>>());

        // Every point of an ellipse has the Mahalanobis distance 2: the definition, at times that are rounded to 1e-9 of the phase.
        let rows = scalars(&planar_entity::GAUSSIANS.of(&names));
        for (index, state) in curve.states.iter().enumerate() {
            let c = |a: usize, b: usize| state.covariance[if a == 0 { 0 } else { axis + 1 }][if b == 0 { 0 } else { axis + 1 }];
            let inverse = Matrix2::new(c(0, 0), c(0, 1), c(1, 0), c(1, 1)).try_inverse().expect("regular");
            let mean = Vector2::new(state.mean[0], state.mean[axis + 1]);
            let (mut points, mut off) = (0, 0.0_f64);
            for (time, values) in &rows {
                for value in &values[2 * index..2 * index + 2] {
                    let away = Vector2::new(*time as f64 * 1e-9, *value) - mean;
                    let inside = away[0].abs() < 1.8 * c(0, 0).sqrt();
                    assert!(!inside || value.is_finite(), "state {index} at {time}");
                    if inside {
                        (points, off) = (points + 1, off.max(((away.transpose() * inverse * away)[0].sqrt() - 2.0).abs()));
                    }
                }
            }
            assert!(points > 20 && off < 1e-6, "state {index} along {name}: {points} points, {off} off");
        }
    }
}

#[test]
fn dots_move_along_the_paths_of_their_method() {
    let outcome = &RECORDED.0;
    let component = rerun::Points2D::descriptor_positions().component;
    let entity = planar_entity::PLACES.of(&["without_side", "cpdmp_chain"]);
    let of_entity = RECORDED.1.iter().filter(|chunk| chunk.entity_path() == &entity && !chunk.is_static());
    let rows: Vec<Vec<[f32; 2]>> = of_entity.flat_map(|chunk| chunk.iter_slices::<[f32; 2]>(component).map(<[_]>::to_vec)).collect();
    let cases = outcome.cases_with(Guidance::WithoutSide);
    let paths: Vec<_> = cases.flat_map(|case| case.of(Method::CpdmpChain)).map(|movement| &movement.path_m).collect();
    assert_eq!(rows.len(), paths[0].len());
    for (t, row) in rows.iter().enumerate() {
        assert_eq!(*row, paths.iter().map(|path| path[t].map(|x| x as f32)).collect::<Vec<_>>());
    }
}

/// Contract: the scale of the plane is written: a few whole metres along each axis, each where it is; those of y a little above, as the viewer writes
/// below their places.
#[test]
fn some_metres_are_written_where_they_are() {
    let of_entity = || RECORDED.1.iter().filter(|chunk| *chunk.entity_path() == planar_entity::GRID_NUMBERS.path());
    let labels = rerun::Points2D::descriptor_labels().component;
    let read = |chunk: &Chunk| {
        chunk.iter_slices::<String>(labels).flat_map(|words| words.iter().map(ToString::to_string).collect::<Vec<_>>()).collect()
    };
    let words: Vec<String> = of_entity().flat_map(|chunk: &Chunk| -> Vec<String> { read(chunk) }).collect();
    let positions = rerun::Points2D::descriptor_positions().component;
    let places: Vec<[f32; 2]> =
        of_entity().flat_map(|chunk| chunk.iter_slices::<[f32; 2]>(positions).flatten().copied().collect::<Vec<_>>()).collect();
    assert_eq!(words.len(), places.len());
    // Those of x are in a row, below, those of y in a column, at the left.
    let lowest = places.iter().map(|place| place[1]).fold(f32::INFINITY, f32::min);
    let metres = |words: &str| words.trim_end_matches(" m").parse::<f32>().expect("a number");
    let (row, column): (Vec<_>, Vec<_>) = places.iter().zip(&words).partition(|(place, _)| place[1] == lowest);
    let x = row.iter().filter(|(place, words)| place[0] == metres(words)).count();
    let y = column.iter().filter(|(place, words)| (0.1..0.5).contains(&(place[1] - metres(words))) && place[0] == column[0].0[0]).count();
    assert!((2..=5).contains(&x) && (2..=5).contains(&y) && words.len() == x + y, "{words:?} at {places:?}");
}

/// Contract: the page says how to read what is in the recording, and nothing of what is not.
#[test]
fn the_page_says_what_is_shown() {
    let two_sided = page(&RECORDED.1, &planar_entity::GUIDE);
    for (said, there) in
        [("each chain has a colour", true), ("wider obstacles", true), ("Each width", true), ("yellow ones", false), ("(4)", false)]
    {
        assert_eq!(two_sided.contains(said), there, "{said}: {two_sided}");
    }
    let mut settings = ObstacleAvoidanceSettings::default();
    (settings.learning.motion.states, settings.learning.motion.max_iterations) = (4, 20);
    let outcome = obstacle_avoidance(&settings, 0, &|| true).expect("it can be learned");
    let chunks = recorded(&outcome);
    let one_sided = page(&chunks, &planar_entity::GUIDE);
    assert!(!page(&chunks, &planar_entity::CONTENTS).contains("transition"));
    let absent = ["chain", "Each width", "wider obstacles", "(4)"].map(|said| (said, false));
    let shown = ["blue: CPDMP; orange: LWR-DMP", "yellow ones", "Thick lines", "Thin ellipses"].map(|said| (said, true));
    for (said, there) in absent.into_iter().chain(shown) {
        assert_eq!(one_sided.contains(said), there, "{said}: {one_sided}");
    }
}

/// Contract: the result names every movement that touches the obstacle, and no other; the page of clearances has every situation with every method.
#[test]
fn the_result_says_what_collides() {
    let mut outcome = RECORDED.0.clone();
    // Several of one method, and one whose title has a comma.
    outcome.cases[0].movements.iter_mut().for_each(|movement| movement.collides = true);
    let by_chain = outcome.cases.iter_mut().flat_map(|case| &mut case.movements).filter(|movement| movement.chain.is_some());
    by_chain.take(2).for_each(|movement| movement.collides = true);
    let chunks = &recorded(&outcome);
    let result = page(chunks, &planar_entity::RESULT).replace('\\', "");
    assert!(result.starts_with("**made_up, seed 0: passed**; "), "{result}");
    let (_, said) = result.split_once("Collisions: ").expect("they are told");
    let clearances = page(chunks, &planar_entity::CLEARANCES);
    let (mut colliding, mut clear) = (0, 0);
    for case in &outcome.cases {
        let told = case.guidance.told().expect("the side is told, or not");
        let of_case = said.split("; ").find_map(|part| part.strip_prefix(&format!("{} ({told}, {}): ", case.name, case.novelty().name())));
        let named: Vec<&str> = of_case.map(|movements| movements.trim().split(" and ").collect()).unwrap_or_default();
        let title = |one: &Movement| one.chain.map_or(one.method.title().to_owned(), |chain| format!("CPDMP by chain ({})", chain + 1));
        let collides: Vec<String> = case.movements.iter().filter(|one| one.collides).map(title).collect();
        assert_eq!(named, collides, "{}: {said}", case.name);
        (colliding, clear) = (colliding + usize::from(!collides.is_empty()), clear + usize::from(collides.is_empty()));
        let line = clearances.lines().find(|line| line.starts_with(&format!("- `{}` ({told}, ", case.name))).expect("a line");
        assert!(case.movements.iter().all(|one| line.contains(&format!("{:.2} m", one.clearance_m))), "{line}");
    }
    assert!(colliding > 0 && clear > 0, "{said}");
    let novelties: BTreeSet<&str> = outcome.cases.iter().map(|case| case.novelty().name()).collect();
    assert_eq!(novelties, ["beyond", "new", "taught"].into());
}

#[test]
fn entities_and_the_timeline_are_those_that_are_documented() {
    let chunks = &RECORDED.1;
    assert_documented(chunks, &ENTITIES.iter().map(|entity| entity.pattern).collect::<Vec<_>>());
    let timelines: BTreeSet<&str> = chunks.iter().flat_map(|chunk| chunk.timelines().keys().map(|name| name.as_str())).collect();
    assert_eq!(timelines, [PHASE_INPUT.name].into());
}

#[test]
fn a_recording_that_cannot_be_written_names_the_file() {
    let error = write_planar_recording(Path::new("/nowhere/recording.rrd"), ("a", 0), &RECORDED.0, "").expect_err("no such folder");
    assert!(error.to_string().contains("/nowhere/recording.rrd"), "{error}");
}
