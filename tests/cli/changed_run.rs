//! What may be changed of a stored run when it is checked or repeated, and what becomes of its answers and of files that were edited.

use std::fs;

use cpdmp::recording::{read_state_log, write_state_log};
use serde_json::Value;

use super::{Folder, GOOD};

/// The folder of [`GOOD`] with its run in `out`.
fn ran() -> Folder {
    ran_with(&[])
}

fn ran_with(flags: &[&str]) -> Folder {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    assert_eq!(folder.call(&[&["run", "a.toml", "--out", "out", "-q"], flags].concat()).code, Some(0));
    folder
}

/// The exit code of a check of the run with `flags`, and its report.
fn checked(folder: &Folder, flags: &[&str]) -> (Option<i32>, Value) {
    let said = folder.call(&[&["check", "out", "--format", "json", "-q"], flags].concat());
    let report: Value = serde_json::from_str(&said.stdout).unwrap_or_else(|error| panic!("{error}: {}{}", said.stdout, said.stderr));
    (said.code, report["checks"][0].clone())
}

fn goal(check: &Value) -> Value {
    let criteria = check["report"]["criteria"].as_array().unwrap_or_else(|| panic!("criteria in {check:#}"));
    criteria.iter().find(|one| one["name"] == "goal").expect("the goal").clone()
}

/// Contract: what decided how the arm moved cannot be changed in its log; the flag and the key are named. A flag that says what the run was told
/// anyway changes nothing.
#[test]
fn what_decided_a_run_is_not_changed_in_its_log() {
    let folder = ran();
    for (flags, key) in [
        (["--set", "coupling.enabled=true"], "coupling.enabled"),
        (["--set", "human.stiffness_n_per_m=500"], "human.stiffness_n_per_m"),
        (["--set", "learning.motion.states=5"], "learning.motion.states"),
        (["--set", "execution.settle_s=2"], "execution.settle_s"),
        (["--set", "parameters.block_height_m=0.21"], "parameters.block_height_m"),
        (["--set", "object.toy.mass_kg=0.06"], "object.toy.mass_kg"),
        (["--seed", "7"], "seed"),
    ] {
        let said = folder.call(&[&["check", "out", "--set", "criterion.goal.max_m=1"], &flags[..]].concat());
        let [name, value] = flags;
        let told = format!("{name}: error[conflict]: {name} {value} changes `{key}`, ");
        assert!(said.code == Some(3) && said.stdout.contains(&told), "{flags:?}: {:?} {}", said.code, said.stdout);
        assert!(said.stdout.contains(&format!("run it again: cpdmp run out/scenario.toml {name} {value} ")), "{}", said.stdout);
    }
    for same in [["--seed", "0"], ["--set", "human.help.kind=none"], ["--robot", "builtin:baxter"]] {
        assert_eq!(checked(&folder, &same).0, Some(0), "{same:?}");
    }
}

/// Contract: the value that a run recorded is held against the limit and the answer that are asked for. In another scene it is none, and what
/// is asked and has no answer is not green.
#[test]
fn recorded_values_are_held_against_other_limits() {
    let folder = ran();
    let value = goal(&checked(&folder, &[]).1)["value"].as_f64().expect("a value");
    assert!(value > 0.0);
    for (flag, code, limit) in [
        (format!("criterion.goal.max_m={}", value / 2.0), 10, Some(value / 2.0)),
        (format!("criterion.goal.max_m={}", value * 2.0), 0, Some(value * 2.0)),
        ("criterion.goal.expect=fail".to_owned(), 10, None),
        ("criterion.goal.expect=report".to_owned(), 0, None),
    ] {
        let (found, check) = checked(&folder, &["--set", &flag]);
        let goal = goal(&check);
        assert_eq!((found, &goal["status"]), (Some(code), &"recorded".into()), "{flag}: {check:#}");
        assert_eq!((goal["value"].as_f64(), goal["as_expected"].as_bool()), (Some(value), Some(code == 0)), "{flag}: {goal}");
        let held = goal["limit"].as_f64().expect("a limit");
        assert!(limit.is_none_or(|limit| (held - limit).abs() < 1e-12) && goal["margin"].as_f64() == Some(held - value), "{flag}: {goal}");
    }
    let moved = ["--set", "object.block.center_m=[1.3, 0.9]"];
    let (code, check) = checked(&folder, &moved);
    let unanswered = goal(&check);
    assert_eq!((code, &unanswered["status"], &unanswered["required"]), (Some(10), &"not_judged".into(), &true.into()), "{check:#}");
    assert!(unanswered["not_judged_because"].as_str().is_some_and(|why| why.contains("another scenario")), "{unanswered}");
    let junit = folder.call(&[&["check", "out", "--format", "junit", "-q"], &moved[..]].concat()).stdout;
    assert!(junit.contains("<failure") && junit.contains("not judged: "), "{junit}");
    assert_eq!(checked(&folder, &[&moved[..], &["--set", "criterion.goal.expect=report"]].concat()).0, Some(0));
}

/// Contract: a log that was cut or a report that was edited is not what the run wrote, and a run without its manifest is not simulated anew.
#[test]
fn files_that_the_run_did_not_write_are_refused() {
    let folder = ran();
    let place = |name: &str| folder.path().join("out").join(name);
    for name in ["report.json", "steps.parquet"] {
        let written = fs::read(place(name)).expect("written");
        let spaced = [&written[..], b"\n"].concat();
        for edited in [Some(&written[..written.len() / 2]), Some(&spaced[..]), None] {
            match edited {
                Some(bytes) => fs::write(place(name), bytes).expect("written"),
                None => fs::remove_file(place(name)).expect("removed"),
            }
            let said = folder.call(&["check", "out"]);
            let told = format!("out/{name}: error[edited]: this is not the file that the run wrote");
            assert!(said.code == Some(3) && said.stdout.contains(&told), "{name}: {}", said.stdout);
        }
        fs::write(place(name), written).expect("written");
        assert_eq!(folder.call(&["check", "out"]).code, Some(0), "restored");
    }
    fs::remove_file(place("manifest.json")).expect("removed");
    let (code, check) = checked(&folder, &[]);
    assert_eq!((code, &check["kind"]), (Some(3), &"run".into()), "{check:#}");
    assert!(check["faults"].to_string().contains("out/manifest.json"), "{check:#}");
}

/// Contract: every hash that a run keeps is held against its repetition, the total of a step and those of its bodies. Hashes that contradict each
/// other were edited, for each total is one over all states before.
#[test]
fn edited_hashes_are_told_as_edited() {
    let folder = ran();
    let log = folder.path().join("out/state_hashes.parquet");
    let traces = read_state_log(&log).expect("a log");
    let replay = |told: &str| {
        let said = folder.call(&["replay", "out", "-q"]);
        assert!(said.code == Some(13) && said.stdout.contains(told), "{told}: {:?} {}", said.code, said.stdout);
    };
    // The manifest would tell it first: here it vouches for nothing.
    let manifest = folder.path().join("out/manifest.json");
    let vouches = fs::read_to_string(&manifest).expect("written");
    fs::write(&manifest, vouches.replace("\"left\"", "\"not_looked_at\"")).expect("written");
    let world = traces.len() - 1;
    let step = traces[world].trace.steps[1];
    let mut total = traces.clone();
    total[world].trace.hashes[1] ^= 1;
    write_state_log(&log, &total).expect("written");
    replay(&format!("the file's total of step {step} does not belong to its bodies' hashes"));
    let mut part = traces.clone();
    let bodies = part[world].trace.bodies.len();
    part[world].trace.quantities[bodies][0] ^= 1;
    write_state_log(&log, &part).expect("written");
    replay(&format!("the position of `{}` in step {step} does not belong to its total", traces[world].trace.bodies[0]));
    write_state_log(&log, &traces).expect("written");
    assert_eq!(folder.call(&["replay", "out", "-q"]).code, Some(0), "restored");
}

/// Contract: what a repetition begins with or is held against is what the run left; otherwise the file is named, and neither the program nor the
/// data is blamed. What a repetition does not look at does not keep it from being made.
#[test]
fn a_repetition_of_what_the_run_did_not_leave_is_refused() {
    let (folder, other) = (ran(), ran_with(&["--seed", "4"]));
    let lesson = "demonstrations/block_height_0.17.csv";
    let files: [(&str, &[&str]); 4] = [
        ("state_hashes.parquet", &[]),
        (lesson, &["--from", "learn"]),
        ("skill.json", &["--from", "execute"]),
        ("snapshots.bin", &["--from-time", "99"]),
    ];
    for (name, from) in files {
        let place = folder.path().join("out").join(name);
        let written = fs::read(&place).unwrap_or_else(|error| panic!("{name}: {error}"));
        let of_another = fs::read(other.path().join("out").join(name)).expect("written");
        for edited in [Some(of_another), Some([&written[..], b"\n"].concat()), None] {
            match edited {
                Some(bytes) => fs::write(&place, bytes).expect("written"),
                None => fs::remove_file(&place).expect("removed"),
            }
            let said = folder.call(&[&["replay", "out", "-q"], from].concat());
            let told = format!("out/{name}: this is not the file that the run wrote");
            assert!(said.code == Some(3) && said.stderr.contains(&told), "{name}: {:?} {}", said.code, said.stderr);
            if !from.is_empty() {
                assert_eq!(folder.call(&["replay", "out", "-q"]).code, Some(0), "as a whole it needs no {name}");
            }
        }
        fs::write(&place, written).expect("written");
        assert_eq!(folder.call(&[&["replay", "out", "-q"], from].concat()).code, Some(0), "restored");
    }
}
