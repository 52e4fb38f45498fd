//! What a scenario has executed beside its run: reported, kept and drawn, and nothing depends on it.

use std::fs;

use serde_json::Value;

use super::program::names;
use super::{Folder, GOOD};

/// One that takes its time, and the baseline.
const BESIDE: &str = r#"
[[beside]]
name = "longer"
set = ["execution.duration_s=5.0"]

[[beside]]
name = "lwr"
set = ["learning.shaping=lwr"]
"#;

fn report(folder: &Folder, run: &str) -> Value {
    let text = fs::read_to_string(folder.path().join(run).join("report.json")).expect("written");
    serde_json::from_str(&text).expect("JSON")
}

/// Contract: the run is the same with and without others beside it, to the last bit and in every answer; what they did is in the report, in
/// step logs of their own, and in the figures, which are drawn again from the folder alone. `check` and `replay`, which judge and repeat the
/// run, leave them out.
#[test]
fn what_stands_beside_a_run_is_told_and_changes_nothing() {
    let compared = format!("{GOOD}{BESIDE}");
    let folder = Folder::with(&[("alone.toml", GOOD.as_bytes()), ("a.toml", compared.as_bytes())]);
    for (file, out) in [("alone.toml", "alone"), ("a.toml", "run"), ("a.toml", "again")] {
        let said = folder.call(&["run", file, "--out", out, "--color", "never"]);
        assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
        assert_eq!(said.stdout.contains("beside (not judged)"), file == "a.toml", "{}", said.stdout);
    }
    let [alone, run, again] = ["alone", "run", "again"].map(|name| report(&folder, name));
    assert_eq!(alone["beside"].as_array().map(Vec::len), Some(0));
    for key in ["state_hash", "criteria", "collisions", "clearance", "steps"] {
        let place = |report: &Value| report[key].to_string().replace("alone.toml", "a.toml");
        assert_eq!(place(&alone), place(&run), "{key}");
    }
    let [longer, lwr] = &run["beside"].as_array().expect("a list")[..] else { panic!("{}", run["beside"]) };
    assert_eq!((&longer["name"], &lwr["name"]), (&"longer".into(), &"lwr".into()));
    assert_eq!(longer["changes"][0], "execution.duration_s=5.0");
    assert_eq!(run["beside"], again["beside"], "a repetition gives the same bits");
    for one in [longer, lwr] {
        assert_ne!(one["state_hash"], run["state_hash"]);
        assert_eq!((&one["criteria"][0]["name"], &one["criteria"][0]["required"]), (&"goal".into(), &false.into()));
    }
    assert!(longer["steps"].as_u64() > lwr["steps"].as_u64(), "five seconds are more than four");

    let place = folder.path().join("run");
    assert_eq!(names(&place.join("beside")), ["longer.parquet", "lwr.parquet"]);
    let drawing = |folder: &std::path::Path, name: &str| fs::read(folder.join(name)).expect("a figure");
    let said = folder.call(&["figures", "run", "--out", "drawn"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    for name in names(&place.join("figures")) {
        assert!(drawing(&place.join("figures"), &name) == drawing(&folder.path().join("drawn"), &name), "{name}: the bytes differ");
    }
    assert!(String::from_utf8_lossy(&drawing(&place.join("figures"), "forces.svg")).contains("longer"));

    // Neither what is lost is passed over in silence, nor what another run left is drawn as this one's.
    let longer = place.join("beside/longer.parquet");
    fs::copy(place.join("beside/lwr.parquet"), &longer).expect("copied");
    let said = folder.call(&["figures", "run", "--out", "drawn"]);
    assert!(said.code == Some(3) && said.stderr.contains("longer.parquet: this is not the file that the run wrote"), "{}", said.stderr);
    fs::remove_file(&longer).expect("removed");
    let said = folder.call(&["figures", "run", "--out", "drawn"]);
    assert!(said.code == Some(3) && said.stderr.contains("longer.parquet") && said.stderr.contains("it is gone"), "{}", said.stderr);

    let said = folder.call(&["check", "a.toml", "--format", "json"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(!said.stdout.contains("longer"), "{}", said.stdout);
    let said = folder.call(&["replay", "run"]);
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
}
