//! `cpdmp migrate`: row 5 of the fault table. Old files become files of this version; newer and foreign ones are left alone.

use std::fs;

use serde_json::Value;

use super::{Folder, GOOD};

fn old() -> String {
    GOOD.replace("schema_version = 1\n", "# Measured on a Tuesday.\n").replace("mass_kg = 0.05", "mass_kg   =  0.05 # weighed")
}

#[test]
fn row_5_a_scenario_without_a_version_gets_one_and_is_otherwise_untouched() {
    let folder = Folder::with(&[("a.toml", old().as_bytes())]);
    assert_eq!(folder.call(&["validate", "a.toml"]).code, Some(3), "a scenario must say its version");
    let tried = folder.call(&["migrate", "a.toml", "--dry-run"]);
    assert_eq!((tried.code, tried.stderr.as_str()), (Some(0), ""));
    assert!(tried.stdout.contains("would be migrated to version 1: `schema_version = 1` added as line 3"), "{}", tried.stdout);
    let text = || fs::read_to_string(folder.path().join("a.toml")).expect("there");
    assert_eq!(text(), old(), "a trial writes nothing");
    let said = folder.call(&["migrate", "a.toml"]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(0), "a.toml: migrated to version 1: `schema_version = 1` added as line 3\n"));
    assert_eq!(text().replacen("schema_version = 1\n", "", 1), old(), "comments and spaces stay");
    assert_eq!(folder.call(&["validate", "a.toml"]).code, Some(0));
    assert_eq!(folder.call(&["migrate", "a.toml"]).stdout, "a.toml: is at version 1\n");
    assert_eq!(folder.names(), ["a.toml"], "nothing is left beside it");
}

#[test]
fn lists_of_demonstrations_are_migrated_and_skills_looked_at() {
    let list = "# mine\nmotion = [\"x_m\"]\nwrench = []\n[[demonstration]]\nfile = \"a.csv\"\n";
    let csv = (0..60).map(|i| format!("{},{}\n", f64::from(i) / 30.0, f64::from(i * i) / 3600.0)).collect::<String>();
    let folder = Folder::with(&[("d/dataset.toml", list.as_bytes()), ("d/a.csv", format!("time_s,x_m\n{csv}").as_bytes())]);
    let learn = ["learn", "d", "--states", "3", "--set", "motion.kmeans_starts=0", "--out", "s.json"];
    assert_eq!(folder.call(&learn).code, Some(3));
    assert_eq!(folder.call(&["migrate", "d/dataset.toml"]).code, Some(0));
    let said = folder.call(&learn);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let said = folder.call(&["migrate", "s.json", "d/dataset.toml", "--format", "json"]);
    let answers: Vec<Value> = said.stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(answers.len(), 2, "{}", said.stdout);
    assert!(
        answers.iter().all(|answer| answer["version"] == 1 && answer["written"] == false && answer["changes"] == serde_json::json!([]))
    );
}

#[test]
fn one_file_that_cannot_be_migrated_keeps_all_as_they_are() {
    let newer = GOOD.replace("schema_version = 1", "schema_version = 7");
    let foreign = "[package]\nname = \"a\"\n";
    let skill = "{\"format\": \"cpdmp-skill\", \"version\": 9}";
    let files = [("a.toml", old()), ("newer.toml", newer), ("cargo.toml", foreign.to_owned()), ("s.json", skill.to_owned())];
    let folder = Folder::with(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
    for (name, told) in
        [("newer.toml", "version 7"), ("cargo.toml", "`package` is no key"), ("s.json", "newer cpdmp"), ("absent.toml", "No such")]
    {
        let said = folder.call(&["migrate", "a.toml", name]);
        assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{name}");
        assert!(said.stderr.contains(told) && said.stderr.contains("nothing was changed"), "{name}: {}", said.stderr);
    }
    assert_eq!(fs::read_to_string(folder.path().join("a.toml")).expect("there"), old());
}

#[cfg(unix)]
#[test]
fn a_migrated_file_keeps_its_permissions_and_its_link() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = Folder::with(&[("real/a.toml", old().as_bytes())]);
    let real = folder.path().join("real/a.toml");
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).expect("set");
    symlink("real/a.toml", folder.path().join("link.toml")).expect("a link");
    assert_eq!(folder.call(&["migrate", "link.toml"]).code, Some(0));
    assert!(folder.path().join("link.toml").symlink_metadata().expect("there").is_symlink());
    assert_eq!(real.metadata().expect("there").permissions().mode() & 0o777, 0o640);
    assert!(fs::read_to_string(&real).expect("there").contains("schema_version = 1"));
}
