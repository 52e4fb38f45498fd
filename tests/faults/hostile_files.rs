//! Files that are no scenarios at all: no panic, no hang, no memory without bound.

use std::time::{Duration, Instant};

use cpdmp::scenario::{LoadOptions, Scenario};
use proptest::prelude::*;

use crate::cli::{Folder, GOOD};

#[test]
fn a_byte_order_mark_and_windows_line_ends_are_accepted() {
    let text = format!("\u{feff}{}", GOOD.replace('\n', "\r\n"));
    let said = Folder::with(&[("a.toml", text.as_bytes())]).call(&["validate", "a.toml"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
}

#[test]
fn bytes_that_are_no_text_are_named_by_their_offset() {
    for (bytes, told) in [(&b"a = \"\xff\""[..], "byte 5"), (&b"a = 1\0"[..], "NUL character at byte 5")] {
        let stderr = Folder::with(&[("a.toml", bytes)]).refused();
        assert!(stderr.contains("error[encoding]") && stderr.contains(told), "{stderr}");
    }
}

#[test]
fn a_folder_is_no_scenario_file() {
    let stderr = Folder::with(&[("a.toml/x", b"")]).call(&["validate", "a.toml"]).stderr;
    assert!(stderr.contains("no scenarios"), "{stderr}");
}

/// Contract: whatever is in a file, it is refused within a second or so (the bound here is for busy machines). Caught: an excerpt of a
/// megabyte drawn once per fault, which took half a minute.
#[test]
fn size_depth_and_number_of_faults_are_bounded() {
    let files: [(&str, Vec<u8>); 7] = [
        ("too large", vec![b'#'; 2 << 20]),
        ("deep list", format!("a = {}", "[".repeat(200_000)).into_bytes()),
        ("deep key", format!("{}a = 1", "a.".repeat(200_000)).into_bytes()),
        ("unknown keys", (0..60_000).map(|i| format!("k{i} = 1\n")).collect::<String>().into_bytes()),
        ("syntax errors", "=\n".repeat(400_000).into_bytes()),
        ("one long line", format!("[robot]\nrest_posture_rad = [{}]", "99,".repeat(200_000)).into_bytes()),
        ("objects", "[[object]]\nname = \"a\"\n".repeat(40_000).into_bytes()),
    ];
    for (name, bytes) in files {
        let folder = Folder::with(&[("a.toml", &bytes)]);
        let started = Instant::now();
        let stderr = folder.refused();
        assert!(started.elapsed() < Duration::from_secs(10), "{name} took {:?}", started.elapsed());
        assert!(stderr.matches("error[").count() <= 101, "{name}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Contract: no text makes the reader panic, and every refusal names at least one fault. Pieces of a good scenario with one stretch
    /// replaced get much deeper than random bytes.
    #[test]
    fn no_text_makes_the_reader_panic(start in 0..GOOD.len(), length in 0_usize..60, piece in "[\\[\\]{}=.,\"'a-z0-9_\\-\n#é ]{0,20}") {
        let mut bytes = GOOD.as_bytes().to_vec();
        bytes.splice(start..(start + length).min(GOOD.len()), piece.bytes());
        let folder = Folder::with(&[("a.toml", &bytes)]);
        if let Err(invalid) = Scenario::load(&folder.path().join("a.toml"), &LoadOptions::default()) {
            prop_assert!(!invalid.0.is_empty());
            prop_assert!(!cpdmp::scenario::render(&invalid.0, true, true, 100).is_empty());
        }
    }

    #[test]
    fn no_override_makes_the_reader_panic(typed in "[a-z_.]{0,20}=?[\\[\\]{}=.,\"a-z0-9_\\- é]{0,12}") {
        let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
        let options = LoadOptions { set: vec![typed], ..LoadOptions::default() };
        if let Err(invalid) = Scenario::load(&folder.path().join("a.toml"), &options) {
            prop_assert!(!invalid.to_string().is_empty());
        }
    }
}
