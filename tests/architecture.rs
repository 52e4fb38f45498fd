//! Reads `src/` and holds what `lib.rs` promises: which room knows which, which room alone knows a foreign crate, and what is absent.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms by row, the lowest first. A room imports only rooms of lower rows.
const ROWS: [&[&str]; 9] = [
    &["math", "palette"],
    &["demonstration"],
    &["learning", "robot"],
    &["world", "control", "planar"],
    &["simulation"],
    &["check", "recording", "figure"],
    &["scenario", "report"],
    &["batch"],
    &["cli"],
];

/// Foreign crates that only some rooms may know.
const FOREIGN: [(&str, &[&str]); 15] = [
    ("rapier3d_f64", &["world"]),
    ("parry3d_f64", &["world"]),
    ("rerun", &["recording"]),
    ("plotters", &["figure"]),
    ("resvg", &["figure"]),
    ("parquet", &["recording", "demonstration", "batch"]),
    // `dataset.toml` is a list of files that the reader of datasets owns; the language of scenarios is known to `scenario` alone.
    ("toml", &["scenario", "demonstration"]),
    ("annotate_snippets", &["scenario"]),
    ("strsim", &["scenario", "robot"]),
    ("clap", &["cli"]),
    ("indicatif", &["cli"]),
    ("anstream", &["cli"]),
    ("quick_junit", &["report"]),
    ("roxmltree", &["robot"]),
    ("urdf_rs", &["robot"]),
];

/// What no line of the program holds, tests apart, and why.
const ABSENT: [(&str, &str); 9] = [
    ("todo!", "nothing is left to do later"),
    ("unimplemented!", "nothing is left to do later"),
    ("dbg!", "debug output does not ship"),
    ("#[allow(", "an exception says why: #[expect(…, reason = \"…\")]"),
    (".unwrap()", "an error is handled, or `expect` says why it cannot be"),
    ("println!", "it panics when the reader leaves: results go through cli::terminal"),
    ("print!(", "it panics when the reader leaves: results go through cli::terminal"),
    ("HashMap", "its order differs from run to run"),
    ("HashSet", "its order differs from run to run"),
];

/// One line of code, without its comment.
struct Line {
    room: String,
    file: PathBuf,
    number: usize,
    code: String,
}

impl Line {
    fn place(&self) -> String {
        format!("{}:{}: {}", self.file.display(), self.number, self.code.trim())
    }

    /// Whether the line names `path`, which begins at a word and ends at one or in `::`.
    fn names(&self, path: &str) -> bool {
        self.code.match_indices(path).any(|(index, _)| {
            let word = |c: char| c.is_alphanumeric() || c == '_';
            let before = self.code[..index].chars().next_back();
            let after = self.code[index + path.len()..].chars().next();
            !before.is_some_and(|c| word(c) || c == ':') && (path.ends_with(':') || !after.is_some_and(word))
        })
    }
}

fn row(room: &str) -> Option<usize> {
    ROWS.iter().position(|rooms| rooms.contains(&room))
}

/// Every line of the program outside tests and comments.
fn lines() -> Vec<Line> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&source, &mut files);
    assert!(files.len() > 50, "src/ was found");
    files.iter().flat_map(|file| code_of(&source, file)).collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// The lines of a file up to its test module, which stands last.
fn code_of(source: &Path, file: &Path) -> Vec<Line> {
    let relative = file.strip_prefix(source).expect("below src/");
    let room = relative.iter().next().map(|part| part.to_string_lossy().into_owned()).unwrap_or_default();
    let text = fs::read_to_string(file).expect("text");
    let program = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let line = |(index, line): (usize, &str)| Line {
        room: room.clone(),
        file: relative.to_path_buf(),
        number: index + 1,
        code: line.split("//").next().unwrap_or_default().to_owned(),
    };
    program.lines().enumerate().map(line).collect()
}

/// The rooms that a line imports: `crate::room` and every name of `crate::{a::…, b::…}` that stands on it.
fn imported(line: &Line) -> Vec<String> {
    let room = |path: &str| path.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default().to_owned();
    let mut rooms = Vec::new();
    for (index, start) in line.code.match_indices("crate::") {
        let rest = &line.code[index + start.len()..];
        match rest.strip_prefix('{') {
            Some(group) => rooms.extend(group.split(',').map(|path| room(path.trim()))),
            None => rooms.push(room(rest)),
        }
    }
    rooms
}

#[test]
fn the_reader_of_imports_sees_every_form() {
    let line = |code: &str| Line { room: "world".into(), file: "x.rs".into(), number: 1, code: code.into() };
    for (code, rooms) in [
        ("use crate::simulation::Experiment;", vec!["simulation"]),
        ("    let x = crate::cli::main();", vec!["cli"]),
        ("use crate::{math, robot::Wrench};", vec!["math", "robot"]),
        ("use super::object::Object;", vec![]),
    ] {
        assert_eq!(imported(&line(code)), rooms, "{code}");
    }
    assert!(line("use toml::Value;").names("toml::"));
    assert!(!line("use crate::toml::Value; my_toml::x()").names("toml::"));
}

#[test]
fn rooms_import_only_rooms_of_lower_rows() {
    let mut faults = Vec::new();
    for line in lines() {
        let Some(own) = row(&line.room) else { continue };
        for room in imported(&line).iter().filter(|room| **room != line.room) {
            if row(room).is_some_and(|other| other >= own) {
                faults.push(format!("{} imports {room}: {}", line.room, line.place()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_folder_of_the_source_is_a_room() {
    for line in lines() {
        let known = row(&line.room).is_some() || ["lib.rs", "main.rs"].contains(&line.room.as_str());
        assert!(known, "src/{} is in no row", line.room);
    }
}

#[test]
fn foreign_crates_stay_in_their_rooms() {
    let mut faults = Vec::new();
    for line in lines() {
        for (name, rooms) in FOREIGN {
            let used = line.names(&format!("{name}::")) || line.names(&format!("use {name}"));
            if used && !rooms.contains(&line.room.as_str()) {
                faults.push(format!("{name} belongs to {rooms:?}: {}", line.place()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn some_things_are_absent() {
    let mut faults = Vec::new();
    for line in lines() {
        for (text, reason) in ABSENT.iter().filter(|(text, _)| line.code.contains(text)) {
            faults.push(format!("{text}: {reason}: {}", line.place()));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The rooms below `report` and `cli` open no terminal and read no clock that decides anything: their results depend on their input alone.
#[test]
fn what_decides_a_run_does_not_know_time_or_environment() {
    let mut faults = Vec::new();
    for line in lines().iter().filter(|line| row(&line.room).is_some_and(|own| own <= 3)) {
        for text in ["std::time", "std::env", "Instant::now", "SystemTime"] {
            if line.code.contains(text) && !line.code.contains("std::env::consts") {
                faults.push(format!("{text}: {}", line.place()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn main_is_nothing_but_a_call() {
    let code: Vec<String> = lines().into_iter().filter(|line| line.room == "main.rs").map(|line| line.code).collect();
    assert!(code.iter().filter(|line| !line.trim().is_empty()).count() <= 4, "{code:?}");
}
