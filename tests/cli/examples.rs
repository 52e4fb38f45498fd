//! The command lines that the README and `--help` show are run as they stand, one after the other in one folder.

use super::{Folder, GOOD};
use crate::support::LEFT_POSTURE;
use crate::support::hand_made::{start_of, stroke, strokes_csv};

const README: &str = include_str!("../../README.md");

/// The command lines that the README shows, in its order, without what is remarked on them: those of its shell blocks, of its workflow, and
/// what stands between back quotes in its text and is more than the name of a command.
fn shown() -> Vec<String> {
    let mut lines = Vec::new();
    let mut block = None;
    for line in README.lines() {
        match (block, line.strip_prefix("```")) {
            (None, Some(kind)) => block = Some(kind),
            (Some(_), Some(_)) => block = None,
            (Some("sh"), None) => lines.extend(line.split(" # ").next().map(str::trim).filter(|line| !line.is_empty()).map(str::to_owned)),
            (Some(_), None) => {
                lines.extend(["$ ", "      - run: "].iter().filter_map(|before| line.strip_prefix(before)).map(str::to_owned))
            }
            (None, None) => lines.extend(line.split('`').skip(1).step_by(2).filter(|code| is_whole(code)).map(str::to_owned)),
        }
    }
    lines.iter().map(|line| line.replace("cargo run --release -- ", "cpdmp ").replace("target/release/cpdmp ", "cpdmp ")).collect()
}

/// Whether a piece of text is a command line with everything that it needs, and not the name of a command or its pattern.
fn is_whole(code: &str) -> bool {
    let is_placeholder = |word: &str| word.chars().any(char::is_uppercase) && !word.chars().any(char::is_lowercase);
    let is_given = |words: &str| words.split(' ').skip(1).any(|word| !word.starts_with('-'));
    code.strip_prefix("cpdmp ").is_some_and(|words| is_given(words) && !words.split([' ', '.', '…']).any(is_placeholder))
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
    let changes = [
        ("\"good\"", "\"pick_and_place\""),
        ("\"block\"", "\"block_1\""),
        ("duration_s = 4.0", "duration_s = 2.0"),
        ("time_s = 4.0", "time_s = 2.0"),
    ];
    let scenario = changes.iter().fold(GOOD.to_owned(), |text, (old, new)| text.replace(old, new));
    let scenario = scenario + "\n[recording]\nsnapshot_every_steps = 500\n";
    let joints = LEFT_POSTURE.map(|angle| angle.to_string()).join(",");
    let path = format!("time_s,{}\n0,{joints}\n1,{joints}\n", [1, 2, 3, 4, 5, 6, 7].map(|joint| format!("q{joint}_rad")).join(","));
    let folder = Folder::with(&[
        ("scenarios/pick_and_place.toml", scenario.as_bytes()),
        ("strokes.csv", strokes_csv(6).as_bytes()),
        ("path.csv", path.as_bytes()),
        ("demonstrations/dataset.toml", dataset().as_bytes()),
    ]);
    for k in 0..6 {
        let point = |i: usize| (i as f64 / 50.0, stroke(start_of(k), i as f64 / 100.0));
        let rows: String = (0..=100).map(point).map(|(time_s, [x_m, y_m])| format!("{time_s},{x_m},{y_m}\n")).collect();
        std::fs::write(folder.path().join(format!("demonstrations/{k}.csv")), format!("time_s,x_m,y_m\n{rows}")).expect("written");
    }
    folder
}

/// A list of six demonstrations of a height.
fn dataset() -> String {
    let one = |k: usize| format!("[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {{ height_m = {} }}\n", 0.1 + 0.03 * k as f64);
    format!("schema_version = 1\nmotion = [\"x_m\", \"y_m\"]\n{}", (0..6).map(one).collect::<String>())
}

/// Runs a command line, which must do what it shows: a check may find something, and a repetition with other values may be another run.
fn works(folder: &Folder, line: &str) {
    let words = words(line);
    let arguments: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
    let said = folder.call(&arguments);
    let expected: &[i32] = match arguments[0] {
        "check" => &[0, 10],
        "replay" if arguments.contains(&"--set") => &[0, 13],
        _ => &[0],
    };
    assert!(said.code.is_some_and(|code| expected.contains(&code)), "{line}: {:?} {}{}", said.code, said.stdout, said.stderr);
}

/// Contract: what the README tells people to type works.
#[test]
fn the_examples_of_the_readme_work() {
    let folder = workplace();
    let shown = shown();
    let ours: Vec<&String> = shown.iter().filter(|line| line.starts_with("cpdmp ")).collect();
    assert!(ours.len() >= 10, "{shown:?}");
    for other in shown.iter().filter(|line| !line.starts_with("cpdmp ")) {
        assert!(["cargo test", "cargo build"].iter().any(|known| other.starts_with(known)), "nobody runs `{other}`");
    }
    ours.iter().for_each(|line| works(&folder, line));
}

/// Contract: what `--help` shows works, command after command; every command that takes something to work on shows how.
#[test]
fn the_examples_of_the_help_work() {
    let folder = workplace();
    for command in commands(&folder) {
        let help = folder.call(&[&command, "--help"]).stdout;
        let examples = help.lines().skip_while(|line| *line != "Examples:").filter_map(|line| line.strip_prefix("  cpdmp "));
        let examples: Vec<String> = examples.map(|words| format!("cpdmp {words}")).collect();
        assert!(!examples.is_empty() || ["list", "man", "view"].contains(&command.as_str()), "{command} --help shows no example");
        for line in examples {
            assert!(line.starts_with(&format!("cpdmp {command} ")), "{line}");
            works(&folder, &line);
        }
    }
}

/// The commands that `--help` lists, in its order.
fn commands(folder: &Folder) -> Vec<String> {
    let help = folder.call(&["--help"]).stdout;
    let listed = help.lines().skip_while(|line| !line.starts_with("Commands:")).skip(1).take_while(|line| !line.is_empty());
    let names = listed.filter(|line| line.starts_with("  ") && !line.starts_with("   ")).filter_map(|line| line.split_whitespace().next());
    let names: Vec<String> = names.filter(|command| *command != "help").map(str::to_owned).collect();
    assert!(names.len() > 8, "{help}");
    names
}

/// Contract: every command of the table in the README is one, says what it is for, and names its exit codes' table.
#[test]
fn the_commands_of_the_readme_are_those_of_the_program() {
    let folder = workplace();
    for command in commands(&folder) {
        assert!(README.contains(&format!("`cpdmp {command}")), "the README says nothing about `{command}`");
        let said = folder.call(&[&command, "--help"]);
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
