//! Faults of `[[beside]]`: an entry is read as `--set` is, and shares lessons and scene with the run.

use crate::cli::{Folder, GOOD};

fn refused(entries: &str) -> String {
    Folder::with(&[("a.toml", format!("{GOOD}\n{entries}").as_bytes())]).refused()
}

fn entry(name: &str, set: &str) -> String {
    format!("[[beside]]\nname = \"{name}\"\nset = [{set}]\n")
}

#[test]
fn an_entry_changes_nothing_that_it_shares_with_the_run() {
    for set in ["'parameters.block_height_m=0.3'", "'seed=1'", "'human.stiffness_n_per_m=10'", "'teaching.duration_s=9'"] {
        let stderr = refused(&entry("other", set));
        assert!(stderr.contains("error[conflict]") && stderr.contains("a key of learning, coupling, execution or human.help"), "{stderr}");
        let line = GOOD.matches('\n').count() + 4;
        assert!(stderr.contains(&format!("a.toml:{line}:")), "line {line}: {stderr}");
    }
    let stderr = refused(&entry("other", "'learning.space=joint', 'coupling.enabled=false'"));
    assert!(stderr.contains("learns in another space than the run"), "{stderr}");
}

#[test]
fn an_entry_is_checked_as_the_command_line_is() {
    let stderr = refused(&entry("other", "'coupling.enabeld=false'"));
    assert!(
        stderr.contains("error[unknown_key]") && stderr.contains("did you mean `enabled`?") && stderr.contains("beside.other"),
        "{stderr}"
    );
    let stderr = refused(&entry("other", "'learning.stiffness=-1'"));
    assert!(stderr.contains("error[out_of_range]"), "{stderr}");
    let stderr = refused(&entry("other", "'coupling.enabled'"));
    assert!(stderr.contains("this override has no `=`"), "{stderr}");
}

#[test]
fn entries_are_few_have_names_of_their_own_and_change_something() {
    let stderr = refused(&entry("other", ""));
    assert!(stderr.contains("changes nothing"), "{stderr}");
    let off = "'coupling.enabled=false'";
    let stderr = refused(&[entry("one", off), entry("one", off)].concat());
    assert!(stderr.contains("error[duplicate_name]"), "{stderr}");
    let stderr = refused(&["a", "b", "c"].map(|name| entry(name, off)).concat());
    assert!(stderr.contains("3 entries of [[beside]]") && stderr.contains("at most 2"), "{stderr}");
}

/// Contract: an experiment without an arm has no lessons that could be executed otherwise.
#[test]
fn a_plane_has_nothing_beside_it() {
    let plane = "schema_version = 1\nname = \"plane\"\n[planar]\nkind = \"obstacle_avoidance\"\n";
    let stderr = Folder::with(&[("a.toml", (plane.to_owned() + &entry("other", "'coupling.enabled=false'")).as_bytes())]).refused();
    assert!(stderr.contains("`beside` is about an arm, but [planar] has none"), "{stderr}");
}
