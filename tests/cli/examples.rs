//! The command lines that the README and `--help` show are run as they stand, one after the other in one folder.

use super::{Folder, GOOD};
use crate::support::LEFT_POSTURE;
use crate::support::hand_made::strokes_csv;

const README: &str = include_str!("../../README.md");

/// The command lines in the README's shell blocks, without what is remarked on them.
fn shown() -> Vec<String> {
    let blocks = README.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap_or_default());
    let lines = blocks.flat_map(str::lines).map(|line| line.split(" # ").next().unwrap_or_default().trim());
    lines.filter(|line| !line.is_empty()).map(|line| line.replace("cargo run --release -- ", "cpdmp ")).collect()
}

/// The words of a command line, as a shell sees them: what stands in single quotes is one.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            c => words.last_mut().expect("there is one").push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Everything that the examples need, with scenarios that take seconds instead of minutes: what they are called and their keys are as shown.
fn workplace() -> Folder {
    let scenario = GOOD.replace("name = \"good\"", "name = \"pick_and_place\"").replace("name = \"block\"", "name = \"block_1\"");
    let joints = LEFT_POSTURE.map(|angle| angle.to_string()).join(",");
    let path = format!("time_s,{}\n0,{joints}\n1,{joints}\n", [1, 2, 3, 4, 5, 6, 7].map(|joint| format!("q{joint}_rad")).join(","));
    Folder::with(&[
        ("scenarios/pick_and_place.toml", scenario.as_bytes()),
        ("strokes.csv", strokes_csv(6).as_bytes()),
        ("path.csv", path.as_bytes()),
    ])
}

/// Contract: what the README tells people to type works. A check of something that was moved may find what it is to find.
#[test]
fn the_examples_of_the_readme_work() {
    let folder = workplace();
    let shown = shown();
    let ours: Vec<&String> = shown.iter().filter(|line| line.starts_with("cpdmp ")).collect();
    assert!(ours.len() >= 4, "{shown:?}");
    for other in shown.iter().filter(|line| !line.starts_with("cpdmp ")) {
        assert!(["cargo test", "cargo build"].iter().any(|known| other.starts_with(known)), "nobody runs `{other}`");
    }
    for line in ours {
        let words = words(line);
        let arguments: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
        let said = folder.call(&arguments);
        let may_find = arguments[0] == "check" && said.code == Some(10);
        assert!(said.code == Some(0) || may_find, "{line}: {:?} {}{}", said.code, said.stdout, said.stderr);
    }
}

/// Contract: every command of the table in the README is one, says what it is for, and names its exit codes' table.
#[test]
fn the_commands_of_the_readme_are_those_of_the_program() {
    let folder = workplace();
    let help = folder.call(&["--help"]).stdout;
    let listed: Vec<&str> = help
        .lines()
        .skip_while(|line| !line.starts_with("Commands:"))
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|command| *command != "help")
        .collect();
    assert!(listed.len() > 8, "{help}");
    for command in listed {
        assert!(README.contains(&format!("`cpdmp {command}")), "the README says nothing about `{command}`");
        let said = folder.call(&[command, "--help"]);
        assert!(said.code == Some(0) && said.stdout.contains(&format!("Usage: cpdmp {command}")), "{command}: {}", said.stdout);
    }
}

/// Contract: every exit code that the program explains stands in the README's table, and no other.
#[test]
fn the_exit_codes_of_the_readme_are_those_of_the_program() {
    let table = README.split("| exit code | meaning |\n|---|---|\n").nth(1).expect("the README has the table");
    let in_readme: Vec<&str> =
        table.lines().take_while(|line| line.starts_with('|')).filter_map(|line| line.split('|').nth(1).map(str::trim)).collect();
    let explained = workplace().call(&["explain", "--format", "json"]).stdout;
    let codes: Vec<String> = explained
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).expect("JSON")["exit_code"].as_u64())
        .map(|code| code.to_string())
        .collect();
    assert_eq!(in_readme, [codes.iter().map(String::as_str).collect::<Vec<_>>(), vec!["128 + n"]].concat());
}
