//! `replay` on the real binary: the same bits again, and the moment at which another run parts from the recorded one.

use std::fs;

use serde_json::Value;

use super::{Folder, GOOD};

/// A person who pushes at 3 s.
const PUSHED: &str = r#"
[human.help]
kind = "push"
force_n = [5.0, 0.0, 0.0]
windows_s = [[3.0, 3.5]]
"#;

fn ran(files: &[(&str, &[u8])], arguments: &[&str]) -> Folder {
    let folder = Folder::with(files);
    let said = folder.call(&[&["run", "a.toml", "--out", "run", "-q"], arguments].concat());
    assert!(matches!(said.code, Some(0 | 10)), "{}", said.stderr);
    folder
}

fn told(folder: &Folder, arguments: &[&str]) -> (Option<i32>, Value) {
    let said = folder.call(&[&["replay", "run", "--format", "json", "-q"], arguments].concat());
    (said.code, serde_json::from_str(&said.stdout).unwrap_or_else(|_| panic!("{}{}", said.stdout, said.stderr)))
}

/// Contract: the same run is the same to the last bit on any number of threads; another one is caught in the very step in which it becomes
/// another. The truth here is the person: a push that begins at 2 s changes nothing up to 2 s, and something in the step or two after it.
#[test]
fn a_run_is_repeated_to_the_bit_and_a_changed_one_is_caught_in_its_step() {
    let folder = ran(&[("a.toml", format!("{GOOD}{PUSHED}").as_bytes())], &[]);
    for jobs in ["1", "2"] {
        let (code, same) = told(&folder, &["--jobs", jobs]);
        assert_eq!((code, same["difference"].as_str()), (Some(0), None), "{same}");
        assert_eq!(same["recorded_state_hash"], same["repeated_state_hash"]);
        assert!(same["hashes"].as_u64() > Some(7 * 40), "three lessons, three replays and an execution of 4 s, 10 hashes per second");
    }
    let (code, changed) = told(&folder, &["--set", "human.help.windows_s=[[2.0, 2.5]]"]);
    assert_eq!(code, Some(13), "{changed}");
    assert_eq!((changed["phase"].as_str(), changed["number"].as_u64()), (Some("execute"), Some(0)), "{changed}");
    assert!((2001..=2003).contains(&changed["step"].as_u64().expect("a step")), "{changed}");
    let difference = changed["difference"].as_str().expect("words");
    assert!(difference.contains("first differs in step 200") && difference.contains("of `left_"), "{difference}");
    assert!(changed["reasons"][0].as_str().is_some_and(|reason| reason.contains("flags")), "{changed}");
}

#[test]
fn what_differs_without_flags_is_told_with_the_promise() {
    let folder = ran(&[("a.toml", GOOD.as_bytes())], &[]);
    fs::rename(folder.path().join("run"), folder.path().join("taught")).expect("renamed");
    let from = ["--set", "demonstrations=taught/demonstrations", "--set", "recording.rrd=false"];
    assert_eq!(folder.call(&[&["run", "a.toml", "--out", "run", "-q"][..], &from].concat()).code, Some(0));
    assert_eq!(told(&folder, &[]).0, Some(0), "a run from a dataset repeats too");
    let dataset = folder.path().join("taught/demonstrations");
    let file = fs::read_dir(&dataset).expect("a dataset").map(|entry| entry.expect("a file").path());
    let file = file.filter(|path| path.extension().is_some_and(|extension| extension == "csv")).min().expect("a demonstration");
    let text = fs::read_to_string(&file).expect("text");
    let last = text.lines().last().expect("a row");
    // One sample of one demonstration, away by a micrometre.
    let cells: Vec<&str> = last.split(',').collect();
    let moved = cells[1].parse::<f64>().expect("a number") + 1e-6;
    fs::write(&file, text.replace(last, &last.replacen(cells[1], &moved.to_string(), 1))).expect("written");
    let (code, changed) = told(&folder, &[]);
    assert_eq!((code, changed["phase"].as_str()), (Some(13), Some("learn")), "{changed}");
    let reasons = changed["reasons"].to_string();
    assert!(reasons.contains("has changed since the run") && !reasons.contains("bug"), "{reasons}");
}

/// Contract: a run that is taken up where its folder can take it up goes on in the same bits as the whole one, to its end; and what differs from
/// there on is told as it is told of the whole.
#[test]
fn a_run_that_is_taken_up_goes_on_in_the_same_bits() {
    let folder = ran(&[("a.toml", format!("{GOOD}{PUSHED}").as_bytes())], &[]);
    let changed = ["--set", "human.help.windows_s=[[2.0, 2.5]]"];
    let whole = told(&folder, &changed).1;
    for from in ["learn", "execute"] {
        let (code, same) = told(&folder, &["--from", from]);
        assert_eq!((code, same["difference"].as_str(), same["from"].as_str()), (Some(0), None, Some(from)), "{same}");
        assert!(same["hashes"].as_u64().is_some_and(|hashes| hashes > 40), "10 hashes per second of the execution: {same}");
        let (code, parted) = told(&folder, &[&["--from", from][..], &changed].concat());
        assert_eq!(code, Some(13));
        for key in ["difference", "phase", "step", "body", "quantity"] {
            assert_eq!(parted[key], whole[key], "{key}");
        }
    }
    for (flags, told) in [
        (&["--from", "learn", "--set", "teaching . lessons=2"][..], "--set teaching.lessons has no effect with --from learn"),
        (&["--from", "execute", "--set", "learning.motion.states=5"], "--set learning.motion.states has no effect with --from execute"),
        (&["--from", "execute", "--seed", "9"], "--seed (or CPDMP_SEED) decides the teaching"),
        (&["--set", "recording.hash_every_steps=7"], "replay compares what the run recorded"),
    ] {
        let said = folder.call(&[&["replay", "run"], flags].concat());
        assert!(said.code == Some(2) && said.stderr.contains(told), "{flags:?}: {}", said.stderr);
    }
    let skill = folder.path().join("run/skill.json");
    let text = fs::read_to_string(&skill).expect("a skill");
    fs::write(&skill, text.replacen("\"stiffness\"", "\"stifness\"", 1)).expect("written");
    let said = folder.call(&["replay", "run", "--from", "execute"]);
    assert!(said.code == Some(3) && said.stderr.contains("skill.json"), "a damaged skill: {}", said.stderr);
    assert_eq!(told(&folder, &["--from", "learn"]).0, Some(0), "is not needed to learn it again");
    fs::remove_dir_all(folder.path().join("run/demonstrations")).expect("removed");
    let said = folder.call(&["replay", "run", "--from", "learn"]);
    assert!(said.code == Some(3) && said.stderr.contains("demonstrations"), "{}", said.stderr);
}

/// Contract: a run is taken up in the middle, at the last snapshot before the time that was asked for, and what a person does otherwise from there
/// on is told as it is told of the whole run. What a snapshot holds cannot be changed, and a damaged one is refused.
#[test]
fn a_run_is_taken_up_in_the_middle() {
    let folder = ran(&[("a.toml", format!("{GOOD}{PUSHED}").as_bytes())], &["--set", "recording.snapshot_every_steps=900"]);
    for (time, step) in [("0.9", 900), ("2.5", 1800), ("2.7", 2700), ("99", 5400)] {
        let (code, same) = told(&folder, &["--from-time", time]);
        assert_eq!((code, same["from_step"].as_u64(), same["from"].as_str()), (Some(0), Some(step), Some("execute")), "{same}");
        assert!(same["hashes"].as_u64().is_some_and(|hashes| hashes > 0), "{same}");
    }
    let later = ["--set", "human.help.windows_s=[[3.2, 3.5]]"];
    let (whole, middle) = (told(&folder, &later).1, told(&folder, &[&later[..], &["--from-time", "2"]].concat()));
    assert_eq!((middle.0, middle.1["step"].as_u64()), (Some(13), whole["step"].as_u64()), "{}", middle.1);
    let said = folder.call(&["replay", "run", "--from-time", "2"]);
    assert!(said.stdout.contains("from step 1800 of the execution on: identical"), "{}", said.stdout);
    for (flags, code, told) in [
        (&["--from-time", "0.5"][..], 3, "the first snapshot of the run is that of 0.900 s"),
        (&["--from-time", "2", "--set", "object.toy.friction=0.1"], 2, "only [human] goes with --from-time"),
        (&["--from-time", "2", "--seed", "3"], 2, "--seed (or CPDMP_SEED) decides the teaching"),
        (&["--from-time", "-1"], 2, "seconds since the execution began"),
        (&["--from-time", "2", "--from", "learn"], 2, "cannot be used with"),
    ] {
        let said = folder.call(&[&["replay", "run"], flags].concat());
        assert!(said.code == Some(code) && said.stderr.contains(told), "{flags:?}: {}", said.stderr);
    }
    // As in a run that was made before manifests vouched for snapshots.
    let manifest = folder.path().join("run/manifest.json");
    let vouches = fs::read_to_string(&manifest).expect("text");
    fs::write(&manifest, vouches.replace("\"left\"", "\"not_looked_at\"")).expect("written");
    let place = folder.path().join("run/snapshots.bin");
    let mut bytes = fs::read(&place).expect("snapshots");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&place, &bytes).expect("written");
    let said = folder.call(&["replay", "run", "--from-time", "2"]);
    assert!(said.code == Some(3) && said.stderr.contains("snapshots.bin") && said.stderr.contains("damaged"), "{}", said.stderr);
    fs::remove_file(&place).expect("removed");
    let said = folder.call(&["replay", "run", "--from-time", "2"]);
    assert!(said.code == Some(3) && said.stderr.contains("recording.snapshot_every_steps"), "{}", said.stderr);
}

/// Row 37 of the fault table: a run of another version or machine may differ, and is told so; one that is the same is the same all the same.
#[test]
fn another_version_or_architecture_is_named_as_the_reason() {
    let shipped = include_str!("../../scenarios/obstacle_avoidance.toml");
    let folder = ran(&[("a.toml", shipped.as_bytes())], &["--set", "recording.hash_every_steps=0"]);
    let manifest = folder.path().join("run/manifest.json");
    let mut other: Value = serde_json::from_str(&fs::read_to_string(&manifest).expect("text")).expect("JSON");
    other["version"] = "0.0.1".into();
    other["host"]["arch"] = "abacus".into();
    fs::write(&manifest, other.to_string()).expect("written");
    assert_eq!(told(&folder, &[]).0, Some(0), "equal bits are equal whoever made them");
    other["state_hash"] = "0123456789abcdef".into();
    fs::write(&manifest, other.to_string()).expect("written");
    let (code, changed) = told(&folder, &[]);
    let reasons = changed["reasons"].to_string();
    assert!(code == Some(13) && reasons.contains("made by cpdmp 0.0.1 on abacus") && !reasons.contains("bug"), "{changed}");
}

/// Contract: a flag that says what the run was told anyway makes no other run of it: by its value, wherever it comes from.
#[test]
fn the_seed_of_the_run_is_no_other_seed() {
    let folder = ran(&[("a.toml", format!("{GOOD}{PUSHED}").as_bytes())], &["--set", "recording.snapshot_every_steps=900"]);
    for from in [&["--from", "execute"][..], &["--from-time", "2.5"]] {
        assert_eq!(told(&folder, &[from, &["--seed", "0"]].concat()).0, Some(0), "{from:?}");
    }
    let with_another_hash = |folder: &Folder| {
        let manifest = folder.path().join("run/manifest.json");
        let mut other: Value = serde_json::from_str(&fs::read_to_string(&manifest).expect("text")).expect("JSON");
        other["state_hash"] = "0123456789abcdef".into();
        fs::write(&manifest, other.to_string()).expect("written");
    };
    // Where hashes on the way show that the run is the same, only the manifest can be wrong.
    with_another_hash(&folder);
    let (code, edited) = told(&folder, &[]);
    let (difference, reasons) = (edited["difference"].to_string(), edited["reasons"].to_string());
    assert!(code == Some(13) && difference.contains("are the same, up to the last step"), "{edited}");
    assert!(reasons.contains("manifest.json has been edited") && !reasons.contains("bug"), "{edited}");
    let folder = ran(&[("a.toml", format!("{GOOD}{PUSHED}").as_bytes())], &["--set", "recording.hash_every_steps=0"]);
    with_another_hash(&folder);
    let of_environment = super::cpdmp()
        .current_dir(folder.path())
        .args(["replay", "run", "--format", "json", "-q"])
        .env("CPDMP_SEED", "0")
        .output()
        .expect("it starts");
    let of_environment: Value = serde_json::from_slice(&of_environment.stdout).expect("JSON");
    let same = ["--seed=0", "--set=human.help.force_n=[5, 0, 0]", "--robot=builtin:baxter"].map(|flag| told(&folder, &[flag]).1);
    for differs in same.iter().chain([&of_environment]) {
        let reasons = differs["reasons"].to_string();
        assert!(differs["exit_code"] == 13 && reasons.contains("bug") && !reasons.contains("flags"), "{differs}");
    }
    assert!(told(&folder, &["--seed", "1"]).1["reasons"].to_string().contains("flags"));
}

#[test]
fn a_planar_run_is_repeated_too() {
    let shipped = include_str!("../../scenarios/obstacle_avoidance.toml");
    let folder = ran(&[("a.toml", shipped.as_bytes())], &[]);
    assert_eq!(told(&folder, &["--jobs", "1"]).0, Some(0));
    let (code, changed) = told(&folder, &["--set", "learning.motion.states=15"]);
    assert_eq!((code, changed["phase"].as_str()), (Some(13), Some("learn")), "what was shown is the same: {changed}");
    assert_eq!(told(&folder, &["--from", "learn"]).0, Some(2), "it has no demonstrations in its folder");
}

#[test]
fn what_is_no_run_or_has_no_hashes_is_told() {
    let folder = ran(&[("a.toml", GOOD.as_bytes())], &["--set", "recording.hash_every_steps=0"]);
    assert!(!folder.path().join("run/state_hashes.parquet").exists());
    assert_eq!(told(&folder, &[]).0, Some(0), "the last hash is compared all the same");
    let (code, changed) = told(&folder, &["--seed", "1"]);
    assert!(code == Some(13) && changed["difference"].as_str().is_some_and(|text| text.contains("no hashes were recorded")), "{changed}");
    let said = folder.call(&["replay", "run", "--from", "execute"]);
    assert!(said.code == Some(3) && said.stderr.contains("no hashes"), "{}", said.stderr);
    fs::write(folder.path().join("run/state_hashes.parquet"), "PAR1 cut short").expect("written");
    for run in ["run", ".", "absent"] {
        assert_eq!(folder.call(&["replay", run]).code, Some(3), "{run}");
    }
}
