//! `cpdmp schema`: what it prints accepts what the program accepts and writes, and refuses what it refuses. Judged by another library.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::{Folder, GOOD};

fn schema(name: &str) -> jsonschema::Validator {
    let said = Folder::with(&[]).call(&["schema", name]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let schema: Value = serde_json::from_str(&said.stdout).expect("a schema is JSON");
    jsonschema::meta::validate(&schema).expect("a schema is a JSON Schema");
    jsonschema::validator_for(&schema).expect("a schema that can be used")
}

fn toml_as_json(path: &Path) -> Value {
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::to_value(toml::from_str::<toml::Table>(&text).expect("TOML")).expect("TOML without dates is JSON")
}

fn json_file(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))).expect("JSON")
}

fn assert_valid(schema: &jsonschema::Validator, instance: &Value, what: &str) {
    let errors: Vec<String> = schema.iter_errors(instance).map(|error| format!("{} at {}", error, error.instance_path())).collect();
    assert!(errors.is_empty(), "{what}: {errors:#?}");
}

#[test]
fn every_shipped_scenario_fits_the_schema() {
    let schema = schema("scenario");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let mut files: Vec<PathBuf> = fs::read_dir(folder).expect("the shipped scenarios").map(|entry| entry.expect("a file").path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    assert!(files.len() >= 7, "{files:?}");
    for file in files {
        assert_valid(&schema, &toml_as_json(&file), &file.display().to_string());
    }
}

#[test]
fn the_schema_refuses_what_the_program_refuses() {
    let schema = schema("scenario");
    let good: toml::Table = toml::from_str(GOOD).expect("TOML");
    let good = serde_json::to_value(good).expect("JSON");
    assert_valid(&schema, &good, "the scenario of the tests");
    let with = |pointer: &str, key: &str, value: Value| {
        let mut changed = good.clone();
        changed.pointer_mut(pointer).expect("a table")[key] = value;
        changed
    };
    let refused = [
        ("a misspelt key", with("", "sed", json!(1))),
        ("a wrong type", with("", "seed", json!("one"))),
        ("a number out of range", with("", "seed", json!(-1))),
        ("a newer version", with("", "schema_version", json!(99))),
        ("an unknown kind", with("/object/0", "kind", json!("sofa"))),
        ("a key of another kind", with("/object/0", "radius_m", json!(0.1))),
    ];
    for (what, scenario) in refused {
        assert!(!schema.is_valid(&scenario), "{what} is accepted");
        let text = toml::to_string(&scenario).expect("JSON without null is TOML");
        let said = Folder::with(&[("a.toml", text.as_bytes())]).refused();
        assert!(said.contains("error["), "{what}: {said}");
    }
    let mut nameless = good.clone();
    nameless.as_object_mut().expect("a table").remove("name");
    assert!(!schema.is_valid(&nameless), "a scenario without a name");
    nameless["extends"] = json!("other.toml");
    assert!(schema.is_valid(&nameless), "a layer may leave the name to the one below");
}

#[test]
fn what_a_run_leaves_fits_the_schemas() {
    let folder = Folder::with(&[]);
    let run = folder.path().join("run");
    let said = folder.call(&["run", concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/obstacle_avoidance.toml"), "--out", "run"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert_valid(&schema("report"), &json_file(&run.join("report.json")), "report.json");
    assert_valid(&schema("manifest"), &json_file(&run.join("manifest.json")), "manifest.json");
    assert_valid(&schema("scenario"), &toml_as_json(&run.join("scenario.toml")), "scenario.toml");
    let printed = |arguments: &[&str]| -> Value {
        let said = folder.call(&[arguments, &["--format", "json", "-q"]].concat());
        assert!(matches!(said.code, Some(0 | 10 | 13)), "{arguments:?}: {}", said.stderr);
        serde_json::from_str(&said.stdout).expect("JSON")
    };
    let (replay, sweep) = (schema("replay"), schema("sweep"));
    let same = printed(&["replay", "run"]);
    let members = ["sweep", "run/scenario.toml", "--grid", "learning.motion.states=14,15"];
    let done = printed(&members);
    for (schema, printed) in [
        (&replay, &same),
        (&replay, &printed(&["replay", "run", "--set", "learning.motion.states=15"])),
        (&sweep, &printed(&[&members[..], &["--dry-run"]].concat())),
        (&sweep, &done),
    ] {
        assert_valid(schema, printed, &printed.to_string());
    }
    for (schema, printed, key) in [(&sweep, &done, "members"), (&sweep, &done, "summary"), (&replay, &same, "outcome")] {
        let mut wrong = printed.clone();
        wrong[key] = json!("a word that means nothing here");
        assert!(!schema.is_valid(&wrong), "{key}");
    }
}

#[test]
fn a_dataset_and_its_skill_fit_the_schemas() {
    let samples = |height: f64| {
        let row = |i: usize| format!("{},{},{}\n", i as f64 * 0.05, i as f64 / 39.0, height * (i as f64 / 39.0));
        format!("time_s,x_m,y_m\n{}", (0..40).map(row).collect::<String>())
    };
    let list = "schema_version = 1\nmotion = [\"x_m\", \"y_m\"]\n[[demonstration]]\nfile = \"low.csv\"\ntheta_m = { height_m = 0.2 }\n\
                [[demonstration]]\nfile = \"high.csv\"\ntheta_m = { height_m = 0.4 }\n";
    let (low, high) = (samples(0.2), samples(0.4));
    let folder = Folder::with(&[("low.csv", low.as_bytes()), ("high.csv", high.as_bytes()), ("dataset.toml", list.as_bytes())]);
    assert_valid(&schema("dataset"), &toml_as_json(&folder.path().join("dataset.toml")), "dataset.toml");
    let said = folder.call(&["learn", "dataset.toml", "--set", "motion.states=4", "--format", "json", "--out", "skill.json"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert_valid(&schema("learn"), &serde_json::from_str(&said.stdout).expect("JSON"), "learn --format json");
    let mut skill = json_file(&folder.path().join("skill.json"));
    assert_valid(&self::schema("skill"), &skill, "skill.json");
    skill["motion"]["stiffness"] = json!("stiff");
    assert!(!self::schema("skill").is_valid(&skill), "a stiffness that is no number");
    assert!(!schema("dataset").is_valid(&json!({ "schema_version": 1, "motoin": ["x_m"] })), "a misspelt key");
}

#[test]
fn schemas_completions_and_manual_pages_are_listed_and_written() {
    let folder = Folder::with(&[]);
    let names = folder.call(&["schema"]);
    for name in ["scenario", "learning", "dataset", "skill", "report", "manifest", "check", "learn", "sweep", "replay"] {
        assert!(names.stdout.lines().any(|line| line.starts_with(name)), "{}", names.stdout);
        schema(name);
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let said = folder.call(&["completions", shell]);
        assert_eq!(said.code, Some(0));
        assert!(said.stdout.contains("validate") && said.stdout.contains("no-progress"), "{shell}: {}", said.stdout);
    }
    let page = folder.call(&["man"]);
    assert!(page.stdout.starts_with(".ie") || page.stdout.contains(".TH cpdmp"), "{}", page.stdout);
    let pages = folder.path().join("man");
    assert_eq!(folder.call(&["man", "--out", "man"]).code, Some(0));
    let run = fs::read_to_string(pages.join("cpdmp-run.1")).expect("a page for each command");
    assert!(run.contains("SCENARIO") && pages.join("cpdmp.1").is_file(), "{run}");
    let refused = folder.call(&["schema", "sofa"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
}
