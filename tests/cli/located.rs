//! Faults that only the robot and the scene show: where they stand, all at once, in every format.

use std::sync::Arc;

use parquet::basic::{Compression, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use serde_json::Value;

use super::{Folder, GOOD};

const ROBOT: &str = include_str!("../../assets/baxter/baxter.urdf");

/// The number, from 1, of the line with these words.
fn line_of(text: &str, words: &str) -> u64 {
    text.lines().position(|line| line.contains(words)).expect("it is there") as u64 + 1
}

/// A good scenario whose toy lies beside the table and whose arm rests beyond the limit of its second joint.
fn two_faults() -> String {
    let toy =
        GOOD.replace("name = \"toy\"\nkind = \"ball\"\ncenter_m = [0.6, 0.1]", "name = \"toy\"\nkind = \"ball\"\ncenter_m = [0.6, 0.4]");
    let posture = "\n[robot]\nrest_posture_rad = [0.0, 5.0, 0.0, 1.0, 0.0, 1.0, 0.0]\n";
    assert_ne!(toy, GOOD);
    toy + posture
}

/// Contract: what the robot or the scene makes impossible is told at its lines, all of it, to people and to programs.
#[test]
fn what_the_scene_forbids_is_told_where_it_was_typed() {
    let text = two_faults();
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let said = folder.call(&["validate", "a.toml", "--format", "json"]);
    let told: Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert_eq!((said.code, &told["error"]), (Some(3), &Value::Null), "{}", said.stdout);
    let lines: Vec<u64> = told["diagnostics"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|found| {
            assert_eq!((&found["code"], &found["file"]), (&Value::from("scene"), &Value::from("a.toml")), "{found}");
            found["line"].as_u64().expect("a line")
        })
        .collect();
    assert_eq!(lines, [line_of(&text, "name = \"toy\""), line_of(&text, "rest_posture_rad")], "{}", said.stdout);
    for arguments in [&["validate", "a.toml"][..], &["run", "a.toml"], &["check", "a.toml"]] {
        let said = folder.call(arguments);
        assert_eq!(said.code, Some(3), "{arguments:?}: {}", said.stderr);
        for line in &lines {
            assert!(said.stderr.contains(&format!("a.toml:{line}:")), "{arguments:?}, line {line}: {}", said.stderr);
        }
        assert!(said.stderr.contains("rest_posture_rad = [0.0, 5.0"), "no snippet: {}", said.stderr);
    }
    assert!(folder.call(&["validate", "a.toml"]).stdout.contains("2 faults"));
    let said = folder.call(&["check", "a.toml", "--format", "github"]);
    for line in &lines {
        assert!(said.stdout.contains(&format!("::error file=a.toml,line={line},")), "line {line}: {}", said.stdout);
    }
    assert_eq!(said.stdout.matches("::error").count(), lines.len(), "each is told once: {}", said.stdout);
}

/// Contract: a way-point that the arm cannot reach is told at the way-point, once, whatever the lessons.
#[test]
fn a_way_point_out_of_reach_is_told_at_its_line() {
    let text = GOOD.replace("center_m = [0.6, 0.1]", "center_m = [2.6, 0.1]").replace("center_m = [0.62, 0.12]", "center_m = [2.62, 0.12]");
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let said = folder.call(&["validate", "a.toml", "--format", "json"]);
    let told: Value = serde_json::from_str(&said.stdout).expect("JSON");
    let found = told["diagnostics"].as_array().expect("a list");
    // The second of the two way-points is at the toy, and is what goes too far in each of the three lessons.
    let second = text.lines().enumerate().filter(|(_, line)| *line == "[[teaching.waypoint]]").nth(1).expect("there").0 as u64 + 1;
    assert_eq!((said.code, found.len(), found[0]["line"].as_u64()), (Some(3), 1, Some(second)), "{}", said.stdout);
    let message = found[0]["message"].as_str().expect("words");
    assert!(message.contains("joint `") && message.contains("way-point 2 (at toy)"), "{message}");
}

/// Contract: faults of the robot's file have their lines in what programs read.
#[test]
fn faults_of_a_robot_have_their_lines_too() {
    let broken = ROBOT.replacen("<mass value=\"", "<mass value=\"-", 1);
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("r.urdf", broken.as_bytes())]);
    let said = folder.call(&["validate", "a.toml", "--robot", "r.urdf", "--format", "json"]);
    let told: Value = serde_json::from_str(&said.stdout).expect("JSON");
    let found = &told["diagnostics"][0];
    let place = (found["code"].as_str(), found["file"].as_str(), found["line"].as_u64());
    assert_eq!(place, (Some("robot"), Some("r.urdf"), Some(line_of(&broken, "<mass value=\"-") - 2)), "{}", said.stdout);
}

/// Contract: numbers of a robot that look as if they were in other units are warned of.
#[test]
fn degrees_and_useless_limits_are_warned_of() {
    let warned = |robot: &str| {
        let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("r.urdf", robot.as_bytes())]);
        folder.call(&["validate", "a.toml", "--robot", "r.urdf", "-v"]).stderr
    };
    assert!(!warned(ROBOT).contains("looks like"));
    assert!(warned(&with_first(ROBOT, "upper=\"", "upper=\"170\" was=\"")).contains("170 rad, which looks like degrees"));
    assert!(warned(&with_first(ROBOT, "rpy=\"", "rpy=\"0 0 90\" was=\"")).contains("90 rad, which looks like degrees"));
    // Continuous joints have no ends.
    let endless = with_first(ROBOT, "type=\"revolute\"", "type=\"continuous\"");
    assert!(warned(&endless).contains("limit"), "{}", warned(&endless));
}

fn with_first(text: &str, from: &str, to: &str) -> String {
    let changed = text.replacen(from, to, 1);
    assert_ne!(changed, text, "there is no {from}");
    changed
}

/// Contract: nothing touches itself, and a scenario that is not there is not listed.
#[test]
fn what_allows_nothing_and_what_is_not_there_are_faults() {
    let text = format!("{GOOD}\n[[allowed_contact]]\nname = \"self\"\na = \"toy\"\nb = \"toy\"\n");
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let said = folder.call(&["validate", "a.toml"]);
    assert!(said.code == Some(3) && said.stderr.contains("would allow nothing"), "{}", said.stderr);
    for (a, b, told) in [
        ("block", "block.base", "would allow nothing"),
        ("left_hand", "block.left_pst", "object `block` has no part `block.left_pst`, only block.base, block.near_post, block.far_post"),
    ] {
        let text = format!("{GOOD}\n[[allowed_contact]]\nname = \"none\"\na = \"{a}\"\nb = \"{b}\"\n");
        let said = Folder::with(&[("a.toml", text.as_bytes())]).call(&["validate", "a.toml"]);
        assert!(said.code == Some(3) && said.stderr.contains(told), "{a}, {b}: {}", said.stderr);
    }
    let part = format!("{GOOD}\n[[allowed_contact]]\nname = \"some\"\na = \"left_hand\"\nb = \"block.near_post\"\n");
    assert_eq!(Folder::with(&[("a.toml", part.as_bytes())]).call(&["validate", "a.toml"]).code, Some(0));
    let said = folder.call(&["list", "a.toml", "b.toml"]);
    assert!(said.code == Some(3) && said.stderr.contains("b.toml") && said.stdout.contains("a.toml"), "{}", said.stderr);
}

/// Contract: samples are read however other programs pack them.
#[test]
fn parquet_is_unpacked_whoever_packed_it() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let times: Vec<f64> = (0..200).map(|k| f64::from(k) * 0.01).collect();
    let columns = [
        times.clone(),
        vec![0.6; 200],
        times.iter().map(|t| 0.1 + 0.01 * t).collect(),
        vec![0.3; 200],
        vec![1.0; 200],
        vec![0.0; 200],
        vec![0.0; 200],
        vec![0.0; 200],
    ];
    let names = ["time_s", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"].map(|name| format!("required double {name};"));
    let schema = Arc::new(parse_message_type(&format!("message way {{ {} }}", names.concat())).expect("a schema"));
    let write = |packing| {
        let file = std::fs::File::create(folder.path().join("way.parquet")).expect("a file");
        let how = WriterProperties::builder().set_compression(packing).build();
        let mut writer = SerializedFileWriter::new(file, schema.clone(), Arc::new(how)).expect("a writer");
        let mut group = writer.next_row_group().expect("a group");
        for values in &columns {
            let mut column = group.next_column().expect("written").expect("a column");
            column.typed::<DoubleType>().write_batch(values, None, None).expect("written");
            column.close().expect("closed");
        }
        group.close().expect("closed");
        writer.close().expect("closed");
        folder.call(&["check", "way.parquet", "--scene", "a.toml", "--format", "json"])
    };
    let packings = [Compression::UNCOMPRESSED, Compression::SNAPPY, Compression::LZ4_RAW, Compression::ZSTD(ZstdLevel::default())];
    let verdicts = packings.map(|packing| {
        let said = write(packing);
        let told: Value = serde_json::from_str(&said.stdout).expect("JSON");
        assert!(told["checks"][0]["report"].is_object(), "{packing:?}: {}", said.stdout);
        (said.code, told["checks"][0]["report"]["clearance"].to_string())
    });
    assert!(verdicts.iter().all(|verdict| *verdict == verdicts[0]), "{verdicts:?}");
    assert!(verdicts[0].1.contains("min_distance_m"), "{verdicts:?}");
    // What an old LZ4 page unpacks to is not said before, as it is not of gzip.
    let said = write(Compression::LZ4);
    assert!(said.code == Some(3) && said.stdout.contains("does not unpack"), "{}{}", said.stdout, said.stderr);
}
