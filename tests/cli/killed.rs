//! A run that is killed: what it had recorded can be opened, and its place is free for the next one.
#![cfg(feature = "rerun")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rerun::external::re_log_encoding::{Decodable, DecoderApp, StreamFooter, StreamHeader};

use super::{Folder, GOOD};

/// Kills a run as soon as its recording has that many bytes.
fn killed_at(folder: &Folder, scenario: &str, recording: &Path, bytes: u64) {
    let program = Command::new(env!("CARGO_BIN_EXE_cpdmp"))
        .current_dir(folder.path())
        .args(["run", scenario, "-q"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let mut child = program.expect("it starts");
    let started = Instant::now();
    while fs::metadata(recording).map_or(0, |file| file.len()) < bytes {
        assert!(started.elapsed() < Duration::from_secs(120), "the recording does not grow");
        assert_eq!(child.try_wait().expect("it is there"), None, "the run is over before its recording has {bytes} bytes");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("killed");
    child.wait().expect("it ends");
}

/// How many messages of a recording are there to their last byte: each says its length in the second half of a head of 16 bytes.
fn whole_messages(recording: &[u8]) -> usize {
    let (mut count, mut at) = (0, StreamHeader::ENCODED_SIZE_BYTES);
    while let Some(head) = recording.get(at..at + 16) {
        let length = u64::from_le_bytes(head[8..].try_into().expect("eight bytes"));
        at += 16 + usize::try_from(length).expect("it fits");
        count += usize::from(at <= recording.len());
    }
    count
}

/// However much of it the kill lets stand: every message that is whole is read.
#[test]
fn a_run_that_is_killed_leaves_a_recording_that_opens() {
    // So long that no machine, however busy, gets to its end before the kill.
    let long = GOOD.replace("duration_s = 4.0", "duration_s = 60.0").replace("time_s = 4.0", "time_s = 60.0");
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("long.toml", long.as_bytes())]);
    let recording = folder.path().join("runs/.good-0.partial/recording.partial.rrd");
    for bytes in [20_000, 100_000, 300_000] {
        killed_at(&folder, "long.toml", &recording, bytes);
        let left = fs::read(&recording).expect("it is there");
        let whole = whole_messages(&left);
        // How much of it had reached the disk is the machine's affair; that something had is ours.
        assert!(left.len() as u64 >= bytes && whole > 0, "{whole} messages in {} bytes", left.len());
        assert_eq!(DecoderApp::decode_lazy(&left[..]).take_while(Result::is_ok).count(), whole);
    }
    let said = folder.call(&["run", "a.toml"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(!recording.exists());
    assert!(!folder.path().join("runs/good-0/recording.partial.rrd").exists());
}

/// Contract: from the first lesson to the end, whenever a kill comes, there is a recording: what grows goes when what is whole is there.
#[test]
fn there_is_a_recording_at_every_moment() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let program = Command::new(env!("CARGO_BIN_EXE_cpdmp"))
        .current_dir(folder.path())
        .args(["run", "a.toml", "-q"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let mut child = program.expect("it starts");
    let places = [".good-0.partial/recording.partial.rrd", ".good-0.partial/recording.rrd", "good-0/recording.rrd"];
    // In this order a file that is renamed in between is found in its later place.
    let is_there = || places.iter().any(|place| folder.path().join("runs").join(place).exists());
    let mut seen = 0;
    while child.try_wait().expect("it is there").is_none() {
        let there = is_there();
        assert!(there || seen == 0, "no recording after it was seen {seen} times");
        seen += u32::from(there);
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(seen > 10 && is_there(), "seen {seen} times");
    assert!(!folder.path().join("runs/good-0/recording.partial.rrd").exists());
}

/// What was simulated before a run had to stop is to be seen, in a file with its footer.
#[test]
fn a_run_that_stops_early_leaves_what_it_has_recorded() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let said = folder.call(&["run", "a.toml", "--timeout", "0.01"]);
    assert_eq!(said.code, Some(12), "{}", said.stderr);
    let recording = fs::read(folder.path().join("runs/good-0/recording.rrd")).expect("it is there");
    assert!(DecoderApp::decode_lazy(&recording[..]).all(|message| message.is_ok()));
    assert!(StreamFooter::from_rrd_bytes(&recording[recording.len() - StreamFooter::ENCODED_SIZE_BYTES..]).is_ok());
    assert!(!folder.path().join("runs/good-0/recording.partial.rrd").exists());
}

/// Contract: where files may not grow as large as a recording, it is named, and everything else is there.
#[test]
fn a_recording_that_finds_no_room_is_named_and_the_rest_stays() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let planar = concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/obstacle_avoidance.toml");
    for (scenario, blocks, steps) in [("a.toml", 1000, "steps.parquet"), (planar, 600, "paths.parquet")] {
        // Without the trap the signal would end the program before it sees an error.
        let run = format!("trap '' XFSZ; ulimit -f {blocks}; exec '{}' run '{scenario}' -q --out run", env!("CARGO_BIN_EXE_cpdmp"));
        let said = Command::new("sh").args(["-c", &run]).current_dir(folder.path()).output().expect("it runs");
        let stderr = String::from_utf8_lossy(&said.stderr);
        assert_eq!(said.status.code(), Some(20), "{scenario}: {stderr}");
        assert!(stderr.contains("error: not written: ") && stderr.contains("run/recording.rrd"), "{scenario}: {stderr}");
        assert!(!stderr.contains(".partial"), "where it was to be, not where it was until then: {stderr}");
        let run = folder.path().join("run");
        assert!(!run.join("recording.rrd").exists());
        for kept in ["report.json", "scenario.toml", "manifest.json", steps] {
            assert!(run.join(kept).is_file(), "{scenario}: {kept}");
        }
    }
}
