//! `extends`: layers of scenarios, and what can be wrong with the chain.

use crate::cli::{Folder, GOOD};

#[test]
fn a_layer_changes_what_it_names_and_nothing_else() {
    let derived = r#"
extends = "base/good.toml"
name = "derived"
[human.help]
kind = "none"
[[object]]
name = "toy"
radius_m = 0.02
[[criterion]]
name = "goal"
expect = "fail"
"#;
    // The base names a kind of help with keys of its own, which the layer above leaves behind with the kind.
    let base = format!("{GOOD}\n[human.help]\nkind = \"guide\"\nobject = \"toy\"\n");
    let folder = Folder::with(&[("base/good.toml", base.as_bytes()), ("a.toml", derived.as_bytes())]);
    let said = folder.call(&["validate", "a.toml", "--format", "json"]);
    assert_eq!(said.code, Some(0), "{}", said.stdout);
    assert!(said.stdout.contains("\"scenario\":\"derived\""), "{}", said.stdout);
}

#[test]
fn faults_are_told_where_they_were_typed() {
    let folder = Folder::with(&[
        ("base.toml", GOOD.replace("mass_kg = 0.05", "mass_kg = -1").as_bytes()),
        ("a.toml", b"extends = \"base.toml\"\nname = \"derived\"\nsede = 3"),
    ]);
    let stderr = folder.refused();
    assert!(stderr.contains("base.toml:") && stderr.contains("a.toml:3:1"), "{stderr}");
}

#[test]
fn a_layer_with_a_dataset_leaves_the_teaching_behind() {
    let layer = b"extends = \"base.toml\"\nname = \"derived\"\ndemonstrations = \"nowhere\"";
    let stderr = Folder::with(&[("base.toml", GOOD.as_bytes()), ("a.toml", layer)]).refused();
    assert!(stderr.contains("nowhere, which does not exist") && !stderr.contains("both"), "{stderr}");
}

#[test]
fn a_circle_is_told_file_by_file() {
    let folder = Folder::with(&[("a.toml", b"extends = \"b.toml\""), ("b.toml", b"extends = \"a.toml\"")]);
    let stderr = folder.refused();
    assert!(stderr.contains("error[extends]") && stderr.contains("a.toml -> b.toml -> a.toml"), "{stderr}");
    let stderr = Folder::with(&[("a.toml", b"extends = \"a.toml\"")]).refused();
    assert!(stderr.contains("a.toml -> a.toml"), "{stderr}");
}

#[test]
fn a_chain_has_an_end() {
    let names: Vec<String> = std::iter::once("a.toml".to_owned()).chain((1..20).map(|i| format!("{i}.toml"))).collect();
    let texts: Vec<String> = names.iter().skip(1).map(|next| format!("extends = \"{next}\"")).collect();
    let files: Vec<(&str, &[u8])> = names.iter().zip(&texts).map(|(name, text)| (name.as_str(), text.as_bytes())).collect();
    let stderr = Folder::with(&files).refused();
    assert!(stderr.contains("more than 16 scenarios"), "{stderr}");
}

#[test]
fn a_missing_base_is_told_where_it_is_named() {
    let stderr = Folder::with(&[("a.toml", b"extends = \"b.toml\"")]).refused();
    assert!(stderr.contains("a.toml:1:11") && stderr.contains("cannot read `b.toml`"), "{stderr}");
}

#[test]
fn files_outside_the_roots_are_refused_with_where_they_lie() {
    let outside = Folder::with(&[("good.toml", GOOD.as_bytes())]);
    let path = outside.path().canonicalize().expect("there").join("good.toml");
    let layer = format!("extends = {:?}\nname = \"derived\"", path.display().to_string());
    let folder = Folder::with(&[("a.toml", layer.as_bytes())]);
    let stderr = folder.refused();
    assert!(stderr.contains("error[outside_root]") && stderr.contains("--asset-root"), "{stderr}");
    let root = outside.path().display().to_string();
    let said = folder.call(&["validate", "a.toml", "--asset-root", &root]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
}

#[cfg(unix)]
#[test]
fn a_link_does_not_lead_out_of_the_roots() {
    let outside = Folder::with(&[("good.toml", GOOD.as_bytes())]);
    let folder = Folder::with(&[("a.toml", b"extends = \"link/good.toml\"\nname = \"derived\"")]);
    std::os::unix::fs::symlink(outside.path(), folder.path().join("link")).expect("a link");
    assert!(folder.refused().contains("error[outside_root]"));
}
