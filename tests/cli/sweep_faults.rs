//! What is wrong with what a file varies: told by every command that judges the file, and all of it at once.

use super::Folder;
use super::sweep::{SHORT, SWEPT};

/// Contract: a file whose sweep cannot be run is not good, whatever its own run would do; `validate`, `check` and `sweep` tell the same.
#[test]
fn a_file_whose_sweep_cannot_be_run_is_not_good() {
    for (old, new, told) in [
        ("values = [0.4, 1.0]", "values = [0.4, 100.0]", "expected 0.01 … 10 m"),
        ("key = \"planar.clearance_m\"", "key = \"planar.clearance\"", "did you mean `clearance_m`?"),
        ("key = \"planar.clearance_m\"", "key = \"planar.hand.noise_m\"", "varies twice"),
        (
            "ranges.planar.hand.noise_m = [0.001, 0.004]\nranges.\"planar.hand.shape_spread_m\" = [0.0, 0.1]",
            "ranges = {}",
            "`sweep.1.ranges` has no entries",
        ),
    ] {
        let text = format!("{SHORT}{SWEPT}");
        assert_eq!(text.matches(old).count(), 1, "{old}");
        let folder = Folder::with(&[("a.toml", text.as_bytes()), ("b.toml", text.replace(old, new).as_bytes())]);
        for command in ["validate", "check", "sweep"] {
            let said = folder.call(&[command, "b.toml"]);
            assert!(said.code == Some(3) && said.stderr.contains(told), "{command} {new}: {:?} {}", said.code, said.stderr);
        }
        assert_eq!(folder.call(&["validate", "a.toml"]).code, Some(0), "the same without the fault");
    }
}

/// Contract: a flag that gives a varying key one value is asked of one run, and no fault of the file.
#[test]
fn one_run_of_a_file_with_a_sweep_may_be_told_what_varies() {
    let folder = Folder::with(&[("a.toml", format!("{SHORT}{SWEPT}").as_bytes())]);
    let said = folder.call(&["validate", "a.toml", "--set", "planar.clearance_m=0.5", "--seed", "3"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
}

/// Contract: faults of the list of directions, of their values and of the rest of the file are told in one pass.
#[test]
fn all_faults_of_a_sweep_are_told_at_once() {
    let text = format!("{SHORT}{SWEPT}")
        .replace("kind = \"repeat\"", "kind = \"repeated\"")
        .replace("values = [0.4, 1.0]", "values = [0.4, 100.0]")
        .replace("[planar.hand]", "colour = 1\n[planar.hand]");
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let said = folder.call(&["sweep", "a.toml", "--grid", "planar.hand.nose_m=1,2"]);
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    for told in ["cannot be `repeated`", "expected 0.01 … 10 m", "unknown key `planar.colour`", "unknown key `planar.hand.nose_m`"] {
        assert_eq!(said.stderr.matches(told).count(), 1, "{told}: {}", said.stderr);
    }
}
