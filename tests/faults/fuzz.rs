//! Whatever bytes a reader is given, it refuses or takes them: without a panic, within a second, in bounded memory.
//!
//! `CPDMP_FUZZ_CASES=250000 cargo test --release --test main -- faults::fuzz` runs a million cases, a quarter of them for each reader, instead
//! of the few thousand of a plain test run; `CPDMP_FUZZ_SEED` (0 … 255) starts elsewhere. The cases are the same in every run.

use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::demonstration::{Dataset, Demonstration};
use cpdmp::learning::phmm::PhmmSettings;
use cpdmp::learning::{LearningSettings, Skill, learn};
use cpdmp::robot;
use cpdmp::scenario::{LoadOptions, Scenario};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

use crate::cli::GOOD;

/// Cases for each reader when nobody asks for more.
const CASES: u32 = 1000;

/// The longest that one case may take. It is timed again when it takes longer: on a busy machine, once says little.
const LONGEST: Duration = Duration::from_secs(1);

/// The most memory that one case may hold at a time (bytes).
const MOST_BYTES: u64 = 500 << 20;

/// What is done to a good file.
#[derive(Clone, Debug)]
enum Edit {
    /// Other bytes at a place.
    Overwrite(prop::sample::Index, Vec<u8>),
    /// More bytes at a place.
    Insert(prop::sample::Index, Vec<u8>),
    /// A stretch less.
    Delete(prop::sample::Index, usize),
    /// A stretch repeated, often enough to matter.
    Repeat(prop::sample::Index, usize, usize),
    /// Nothing from a place on.
    Cut(prop::sample::Index),
}

impl Edit {
    fn apply(&self, bytes: &mut Vec<u8>) {
        if bytes.is_empty() {
            return;
        }
        let within = |at: &prop::sample::Index, length: usize| {
            let start = at.index(bytes.len());
            start..(start + length).min(bytes.len())
        };
        match self {
            Self::Overwrite(at, new) => _ = bytes.splice(within(at, new.len()), new.iter().copied()),
            Self::Insert(at, new) => _ = bytes.splice(within(at, 0), new.iter().copied()),
            Self::Delete(at, length) => _ = bytes.drain(within(at, *length)),
            Self::Repeat(at, length, times) => {
                let range = within(at, *length);
                let more = bytes[range.clone()].repeat(*times);
                _ = bytes.splice(range.end..range.end, more);
            }
            Self::Cut(at) => bytes.truncate(at.index(bytes.len())),
        }
    }
}

/// Bytes: random ones, or words that mean something to one of the formats.
fn piece() -> impl Strategy<Value = Vec<u8>> {
    let words = [
        "[",
        "]",
        "{",
        "}",
        "[[",
        "]]",
        "\"",
        "'",
        "\"\"\"",
        "=",
        ",",
        ":",
        ".",
        "\n",
        "\r\n",
        "#",
        "<",
        ">",
        "/>",
        "</",
        "<!--",
        "&amp;",
        "&#0;",
        "-",
        "e",
        "1e308",
        "1e999",
        "-1",
        "nan",
        "NaN",
        "inf",
        "0",
        "9223372036854775808",
        "true",
        "null",
        "\u{feff}",
        "\0",
        "é",
        "\\u0000",
    ];
    prop_oneof![
        3 => prop::sample::select(words.to_vec()).prop_map(|word| word.as_bytes().to_vec()),
        1 => prop::collection::vec(any::<u8>(), 1..8),
    ]
}

fn edit() -> impl Strategy<Value = Edit> {
    let at = any::<prop::sample::Index>;
    prop_oneof![
        4 => (at(), piece()).prop_map(|(at, new)| Edit::Overwrite(at, new)),
        4 => (at(), piece()).prop_map(|(at, new)| Edit::Insert(at, new)),
        2 => (at(), 1..200_usize).prop_map(|(at, length)| Edit::Delete(at, length)),
        2 => (at(), 1..60_usize, 1..40_usize).prop_map(|(at, length, times)| Edit::Repeat(at, length, times)),
        1 => at().prop_map(Edit::Cut),
    ]
}

/// A number of the environment.
fn asked(name: &str) -> Option<u32> {
    std::env::var(name).ok().map(|text| text.parse().unwrap_or_else(|_| panic!("{name} is {text}, but must be a whole number")))
}

/// Feeds the reader, which says whether it took the file, with mutations of the good file: it must return, soon, and without holding much.
fn feed(good: &[u8], read: impl Fn(&[u8]) -> bool) {
    assert!(read(good), "what is changed is good before");
    let cases = asked("CPDMP_FUZZ_CASES").unwrap_or(CASES);
    let config = ProptestConfig { cases, failure_persistence: None, max_shrink_iters: 2000, ..ProptestConfig::default() };
    let seed = [asked("CPDMP_FUZZ_SEED").unwrap_or(0) as u8; 32];
    let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &seed));
    let edits = prop::collection::vec(edit(), 1..6);
    let (longest, most_bytes, taken) = (Cell::new(Duration::ZERO), Cell::new(0), Cell::new(0_u32));
    let result = runner.run(&edits, |edits| {
        let mut bytes = good.to_vec();
        edits.iter().for_each(|edit| edit.apply(&mut bytes));
        let timed = || {
            let started = Instant::now();
            let memory = allocation_counter::measure(|| taken.set(taken.get() + u32::from(read(&bytes))));
            (started.elapsed(), memory.bytes_max)
        };
        let (mut took, held) = timed();
        for _ in 0..2 {
            took = if took > LONGEST { timed().0 } else { took };
        }
        longest.set(longest.get().max(took));
        most_bytes.set(most_bytes.get().max(held));
        prop_assert!(took <= LONGEST, "{took:?} for {}", String::from_utf8_lossy(&bytes));
        prop_assert!(held <= MOST_BYTES, "{held} bytes for {}", String::from_utf8_lossy(&bytes));
        Ok(())
    });
    if let Err(found) = result {
        panic!("{found}");
    }
    // Seen with `-- --nocapture`.
    println!("{cases} cases, {} of them taken; the longest {:?}, the most memory {} bytes", taken.get(), longest.get(), most_bytes.get());
}

/// The path of a file with these bytes.
fn file(folder: &Path, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).expect("written");
    path
}

/// What a scenario may say of its sweep.
const SWEPT: &str = r#"
[[sweep]]
kind = "grid"
key = "parameters.block_height_m"
values = [0.18, 0.2]

[[sweep]]
kind = "latin_hypercube"
count = 3
ranges = { "object.toy.mass_kg" = [0.04, 0.06], "object.toy.friction" = [0.5, 0.8] }

[[sweep]]
kind = "repeat"
count = 2
"#;

#[test]
fn scenarios() {
    let folder = tempfile::tempdir().expect("a folder");
    feed(format!("{GOOD}{SWEPT}").as_bytes(), |bytes| {
        let loaded = Scenario::load_with_sweep(&file(folder.path(), "a.toml", bytes), &LoadOptions::default());
        if let Err(invalid) = &loaded {
            assert!(!invalid.0.is_empty(), "a refusal has a reason");
            assert!(!cpdmp::scenario::render(&invalid.0, true, true, 100).is_empty());
        }
        loaded.is_ok()
    });
}

/// A robot with everything that the reader knows, on a page.
const ROBOT: &str = r#"<?xml version="1.0"?>
<robot name="two">
  <material name="m"><color rgba="1 0 0 1"/></material>
  <link name="a"><visual><origin xyz="0 0 0" rpy="0 0 0"/><geometry><sphere radius="0.1"/></geometry><material name="m"/></visual></link>
  <link name="b">
    <inertial><origin xyz="0 0 0.1"/><mass value="1.5"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <collision><geometry><cylinder radius="0.05" length="0.2"/></geometry></collision>
    <visual><geometry><mesh filename="none.stl" scale="1 1 1"/></geometry></visual>
    <visual><geometry><box size="0.1 0.1 0.2"/></geometry></visual>
  </link>
  <joint name="j" type="revolute"><origin xyz="0 0 1" rpy="0 1.57 0"/><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/><dynamics damping="0.7" friction="0"/></joint>
  <link name="c"/>
  <joint name="k" type="fixed"><parent link="b"/><child link="c"/></joint>
</robot>"#;

#[test]
fn robots() {
    let folder = tempfile::tempdir().expect("a folder");
    feed(ROBOT.as_bytes(), |bytes| {
        let loaded = robot::load(&file(folder.path(), "a.urdf", bytes), &robot::LoadOptions::default());
        match &loaded {
            Ok(loaded) => assert!(loaded.model.bodies.iter().all(|body| body.mass_kg.is_finite() && body.mass_kg >= 0.0)),
            Err(refused) => assert!(!refused.to_string().is_empty(), "a refusal has a reason"),
        }
        loaded.is_ok()
    });
}

/// A list and its demonstration in one text, so that both are changed: what stands after the line of dashes is the CSV file.
const DATASET: &str = r#"schema_version = 1
motion = ["x_m", "y_m"]
wrench = ["fx_n"]
columns = { y_m = "height" }
[[demonstration]]
file = "a.csv"
theta_m = { h_m = 0.1 }
theta_f = {}
----
time_s,x_m,height,fx_n,qx,qy,qz,qw,gripper,note
0,0.1,0.2,1.5,0,0,0,1,1,begin
0.5,0.15,0.25,1.25,0,0,0.1,0.995,1,
1.0,"0.2",0.3,-1e-3,0,0,0.2,0.98,0,end
"#;

#[test]
fn datasets() {
    let folder = tempfile::tempdir().expect("a folder");
    feed(DATASET.as_bytes(), |bytes| {
        let dashes = b"----\n";
        let at = bytes.windows(dashes.len()).position(|window| window == dashes);
        let (list, csv) = at.map_or((bytes, &b""[..]), |at| (&bytes[..at], &bytes[at + dashes.len()..]));
        file(folder.path(), "a.csv", csv);
        let read = Dataset::read(&file(folder.path(), "dataset.toml", list));
        match &read {
            Ok(dataset) => {
                let finite = |d: &Demonstration| d.trajectory.times_s().iter().all(|time_s| time_s.is_finite());
                assert!(!dataset.demonstrations.is_empty() && dataset.demonstrations.iter().all(finite));
            }
            Err(refused) => assert!(!refused.to_string().is_empty(), "a refusal has a reason"),
        }
        read.is_ok()
    });
}

/// A skill as a file without its checksum, which would refuse every change at once.
fn skill() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| {
        let model = PhmmSettings { states: 2, kmeans_starts: 0, max_iterations: 3, ..PhmmSettings::default() };
        let settings =
            LearningSettings { motion: model.clone(), force: model, rate_hz: 2.0, orientation_basis: 4, ..LearningSettings::default() };
        let text = learn(&PickAndPlace::default().dataset(0), &settings, 0).expect("learned").skill.to_json().expect("JSON");
        text.lines().filter(|line| !line.contains("\"checksum\"")).collect::<Vec<_>>().join("\n")
    })
}

#[test]
fn skills() {
    let folder = tempfile::tempdir().expect("a folder");
    feed(skill().as_bytes(), |bytes| {
        let read = Skill::read(&file(folder.path(), "a.json", bytes));
        match &read {
            Ok(skill) => assert!(skill.check().is_ok(), "what is taken passes its own check"),
            Err(refused) => assert!(!refused.to_string().is_empty(), "a refusal has a reason"),
        }
        read.is_ok()
    });
}
