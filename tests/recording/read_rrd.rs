//! Reads recordings with rerun's own decoder, and has the experiment that they are of.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use cpdmp::recording::entity_path::Entity;
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::Experiment;
use rerun::external::re_log_encoding::DecoderApp;
use rerun::external::re_log_types::LogMsg;
use rerun::log::Chunk;
use rerun::{ComponentDescriptor, EntityPath};

/// The shipped experiment, of which the made-up run could be one.
pub fn experiment() -> Experiment {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/pick_and_place.toml");
    let scenario = Scenario::load(&path, &LoadOptions::default()).expect("the shipped scenario is valid");
    let Work::Arm(experiment) = scenario.work else { panic!("no arm") };
    *experiment
}

/// Everything in a recording.
pub fn messages(path: &Path) -> Vec<LogMsg> {
    let file = BufReader::new(File::open(path).expect("the recording is there"));
    DecoderApp::decode_lazy(file).map(|message| message.expect("it can be decoded")).collect()
}

/// The data, without the layout.
pub fn chunks(path: &Path) -> Vec<Chunk> {
    let data = messages(path).into_iter().filter_map(|message| match message {
        LogMsg::ArrowMsg(id, message) if id.is_recording() => Some(Chunk::from_arrow_msg(&message).expect("it is a chunk")),
        _ => None,
    });
    data.collect()
}

/// What `read` finds in the rows of an entity, with the simulated time (ns).
pub fn rows<T>(chunks: &[Chunk], entity: &EntityPath, component: &ComponentDescriptor, read: impl Fn(&Chunk) -> Vec<T>) -> Vec<(i64, T)> {
    let timeline = rerun::TimelineName::try_new("sim_time").expect("a good name");
    let of_entity = chunks.iter().filter(|chunk| chunk.entity_path() == entity && !chunk.is_static());
    let timed = of_entity.flat_map(|chunk| {
        let times: Vec<i64> = chunk.iter_component_indices(timeline, component.component).map(|(time, _)| time.as_i64()).collect();
        times.into_iter().zip(read(chunk)).collect::<Vec<_>>()
    });
    timed.collect()
}

/// The texts of an entity, with the simulated time (ns).
pub fn texts(chunks: &[Chunk], entity: &Entity, component: &ComponentDescriptor) -> Vec<(i64, String)> {
    let read = |chunk: &Chunk| chunk.iter_slices::<String>(component.component).map(|texts| texts[0].to_string()).collect();
    rows(chunks, &entity.path(), component, read)
}
