//! Every command that needs no simulation: what it prints where, and its exit code.

use std::io::Read;
use std::process::Stdio;

use serde_json::Value;

use super::{Folder, GOOD};

fn good() -> Folder {
    Folder::with(&[("a.toml", GOOD.as_bytes())])
}

#[test]
fn a_command_line_without_sense_ends_with_2_and_says_so_on_stderr() {
    for arguments in
        [&[][..], &["fly"], &["run"], &["run", "a.toml", "--jobs", "0"], &["run", "a.toml", "--seed", "-1"], &["list", "--colour"]]
    {
        let said = good().call(arguments);
        assert_eq!((said.code, said.stdout.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(!said.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn help_and_version_are_results() {
    for (argument, text) in [("--help", "Usage: cpdmp"), ("--version", env!("CARGO_PKG_VERSION"))] {
        let said = good().call(&[argument]);
        assert_eq!((said.code, said.stderr.as_str()), (Some(0), ""));
        assert!(said.stdout.contains(text), "{}", said.stdout);
    }
}

#[test]
fn validate_accepts_a_good_scenario_and_writes_nothing() {
    let folder = good();
    let said = folder.call(&["validate", "a.toml"]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(0), "a.toml: ok\n"), "{}", said.stderr);
    assert_eq!(folder.names(), ["a.toml"]);
}

#[test]
fn validate_tells_programs_everything_on_stdout() {
    let folder = Folder::with_change("mass_kg = 0.05", "mas_kg = 0.05");
    let said = folder.call(&["validate", "a.toml", "--format", "json"]);
    assert_eq!((said.code, said.stderr.as_str()), (Some(3), ""));
    let answer: Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert_eq!((answer["exit_code"].as_i64(), answer["outcome"].as_str()), (Some(3), Some("invalid_input")));
    let codes: Vec<&str> = answer["diagnostics"].as_array().expect("a list").iter().filter_map(|found| found["code"].as_str()).collect();
    assert_eq!(codes, ["missing_key", "unknown_key"]);
    assert_eq!(
        answer["diagnostics"][1]["line"].as_i64(),
        Some(GOOD[..GOOD.find("mass_kg").expect("there")].matches('\n').count() as i64 + 1)
    );
}

#[test]
fn a_missing_file_is_invalid_input() {
    let said = good().call(&["run", "absent.toml"]);
    assert_eq!(said.code, Some(3));
    assert!(said.stderr.contains("absent.toml") && said.stderr.contains("No such file"), "{}", said.stderr);
}

#[test]
fn nothing_selected_is_a_failure() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("empty/readme.md", b"")]);
    for argument in ["empty", "*.yaml", "empty/*.toml"] {
        let said = folder.call(&["run", argument]);
        assert_eq!(said.code, Some(5), "{argument}");
        assert!(said.stderr.contains("no scenarios"), "{}", said.stderr);
    }
}

#[test]
fn every_scenario_is_checked_before_the_first_one_runs() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.toml", b"name = 3")]);
    let said = folder.call(&["run", "a.toml", "b.toml"]);
    assert_eq!(said.code, Some(3));
    assert_eq!(folder.names(), ["a.toml", "b.toml"], "nothing was written");
}

#[test]
fn list_names_scenarios_with_what_they_show() {
    let described = GOOD.replace("name = \"good\"", "name = \"good\"\ndescription = \"shows something\"");
    let folder = Folder::with(&[("scenarios/a.toml", described.as_bytes()), ("scenarios/b.toml", b"=")]);
    let said = folder.call(&["list"]);
    assert_eq!(said.code, Some(0));
    let lines: Vec<&str> = said.stdout.lines().collect();
    assert_eq!(lines.len(), 2, "{}", said.stdout);
    assert!(lines[0].starts_with("scenarios/a.toml") && lines[0].ends_with("shows something"));
    assert!(lines[1].starts_with("scenarios/b.toml") && lines[1].contains("cannot be used"));
    let said = folder.call(&["list", "--format", "json"]);
    let entries: Vec<Value> = said.stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(entries.iter().map(|entry| entry["valid"].as_bool()).collect::<Vec<_>>(), [Some(true), Some(false)]);
}

/// Contract: patterns are those of a shell; a file that bears the name of a pattern is itself; the list of a dataset is no scenario.
#[test]
fn patterns_are_those_of_a_shell() {
    let good = GOOD.as_bytes();
    let files = ["a.toml", "b.toml", "deep/c.toml", "deep/er/a.toml", "deep/er/dataset.toml", "x[1].toml", "deep/er/notes.md"];
    let folder = Folder::with(&files.map(|name| (name, good)));
    for (pattern, found) in [
        ("**/a.toml", &["a.toml", "deep/er/a.toml"][..]),
        ("deep/**/*.toml", &["deep/c.toml", "deep/er/a.toml"]),
        ("d*/c.toml", &["deep/c.toml"]),
        ("[ab].toml", &["a.toml", "b.toml"]),
        ("?.toml", &["a.toml", "b.toml"]),
        ("deep/er", &["deep/er/a.toml"]),
        ("x[1].toml", &["x[1].toml"]),
    ] {
        let said = folder.call(&["list", pattern]);
        let listed: Vec<&str> = said.stdout.lines().filter_map(|line| line.split_whitespace().next()).collect();
        assert_eq!((said.code, &listed[..]), (Some(0), found), "{pattern}: {}", said.stderr);
    }
    for nothing in ["[", "**a", "c.toml*"] {
        assert_eq!(folder.call(&["list", nothing]).code, Some(5), "{nothing}");
    }
    // A folder that matches is as good as an argument, what is hidden matches nothing, and links lead into no circle.
    let listed = |folder: &Folder, pattern: &str| {
        let said = folder.call(&["list", pattern]);
        said.stdout.lines().filter_map(|line| line.split_whitespace().next().map(str::to_owned)).collect::<Vec<_>>()
    };
    assert_eq!(listed(&folder, "de*"), ["deep/c.toml"]);
    let hidden = Folder::with(&[("a.toml", good), (".hidden/b.toml", good), (".c.toml", good), ("in/d.toml", good)]);
    assert_eq!(listed(&hidden, "**/*.toml"), ["a.toml", "in/d.toml"]);
    assert_eq!(listed(&hidden, "."), ["./a.toml"]);
    assert_eq!(listed(&hidden, ".h*/*.toml"), [".hidden/b.toml"]);
    assert_eq!(listed(&hidden, ".//a*"), ["./a.toml"]);
    assert_eq!(listed(&hidden, "i*/"), ["in/d.toml"]);
    #[cfg(unix)]
    {
        for name in ["x", "y", "z"] {
            std::os::unix::fs::symlink(".", hidden.path().join("in").join(name)).expect("a link");
        }
        std::os::unix::fs::symlink("in", hidden.path().join("link")).expect("a link");
        assert_eq!(listed(&hidden, "**/*.toml"), ["a.toml", "in/d.toml"]);
        assert_eq!(listed(&hidden, "l*/*.toml"), ["link/d.toml"]);
        assert!(listed(&hidden, "in/*/*.toml").contains(&"in/x/d.toml".to_owned()), "a link to its own folder is one all the same");
        // A link to nothing is not passed over.
        std::os::unix::fs::symlink("gone", hidden.path().join("gone.toml")).expect("a link");
        for pattern in ["*.toml", "**/*.toml", "."] {
            let said = hidden.call(&["validate", pattern]);
            assert!(said.code == Some(3) && said.stderr.contains("gone.toml"), "{pattern}: {}", said.stderr);
        }
    }
}

#[test]
fn explain_knows_every_exit_code() {
    let said = good().call(&["explain"]);
    assert_eq!(said.code, Some(0));
    for code in ["0", "1", "2", "3", "4", "5", "10", "11", "12", "13", "20", "21"] {
        assert!(said.stdout.lines().any(|line| line.trim_start().starts_with(&format!("{code} "))), "{code}:\n{}", said.stdout);
    }
    let said = good().call(&["explain", "unknown_key"]);
    assert!(said.stdout.contains("means nothing where it stands"));
    assert_eq!(good().call(&["explain", "77"]).code, Some(2));
    for (code, word) in [
        ("unreadable", "cannot be opened"),
        ("edited", "not as the run wrote it"),
        ("trajectory", "a movement cannot be judged"),
        ("scene", "not possible with its robot"),
        ("planar", "has no arm"),
        ("conflict", "contradict each other"),
        ("nothing_asked", "whatever happens passes"),
        ("13", "replay_differs"),
        ("137", "signal 9"),
    ] {
        let said = good().call(&["explain", code]);
        assert!(said.code == Some(0) && said.stdout.contains(word), "{code}: {}{}", said.stdout, said.stderr);
    }
}

#[test]
fn a_reader_who_leaves_is_no_failure() {
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_cpdmp"))
        .arg("explain")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let status = child.wait().expect("it ends");
    let mut complaints = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut complaints).expect("text");
    assert_eq!((status.code(), complaints.as_str()), (Some(0), ""));
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_written_end_with_20() {
    for argument in ["explain", "--help", "--version"] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        let status = std::process::Command::new(env!("CARGO_BIN_EXE_cpdmp")).arg(argument).stdout(full).status().expect("it starts");
        assert_eq!(status.code(), Some(20), "{argument}");
    }
}

#[test]
fn colour_and_characters_follow_the_reader() {
    let folder = Folder::with_change("mass_kg = 0.05", "mass_kg = -1");
    let call = |arguments: &[&str], locale: &str| {
        let output = super::cpdmp().current_dir(folder.path()).env("LC_ALL", locale).args(["validate", "a.toml"]).args(arguments).output();
        String::from_utf8(output.expect("it starts").stderr).expect("text")
    };
    assert!(!call(&[], "C.UTF-8").contains('\u{1b}'), "a pipe gets no colour");
    assert!(call(&["--color", "always"], "C.UTF-8").contains('\u{1b}'));
    assert!(call(&[], "C.UTF-8").contains('…'));
    assert!(call(&[], "POSIX").is_ascii());
}
