//! Datasets and skills that cannot be used, or only with care: the fault table's rows 14 to 23, on the real binary.

use std::sync::OnceLock;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::learning::phmm::PhmmSettings;
use cpdmp::learning::{LearningSettings, Skill, learn};
use proptest::prelude::*;

use crate::cli::Folder;

/// A short movement of one column as CSV.
fn csv(samples: usize, value: impl Fn(f64) -> f64) -> String {
    let row = |i: usize| {
        let u = i as f64 / (samples - 1).max(1) as f64;
        format!("{:.4},{:?}", 2.0 * u, value(u * u * (3.0 - 2.0 * u)))
    };
    format!("time_s,x_m\n{}\n", (0..samples).map(row).collect::<Vec<_>>().join("\n"))
}

/// A dataset of files with a parameter each.
fn dataset(files: &[(String, &str)]) -> Folder {
    let mut list = "schema_version = 1\nmotion = [\"x_m\"]\nwrench = []\n".to_owned();
    for (k, (_, theta)) in files.iter().enumerate() {
        list += &format!("[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {theta}\n");
    }
    let folder = Folder::with(&[("d/dataset.toml", list.as_bytes())]);
    for (k, (text, _)) in files.iter().enumerate() {
        std::fs::write(folder.path().join(format!("d/{k}.csv")), text).expect("written");
    }
    folder
}

const QUICK: [&str; 6] = ["learn", "d", "--states", "4", "--set", "motion.kmeans_starts=0"];

#[test]
fn rows_14_and_15_bad_cells_and_times_are_told_with_file_row_and_column() {
    let good = csv(50, |s| s);
    for (bad, parts) in [
        (good.replacen("0.0408,", "0.0408,nan", 1), vec!["0.csv, row 3", "column x_m"]),
        (good.replacen("0.0408,", "-1,", 1), vec!["0.csv, row 3", "column time_s"]),
        (good.replacen("0.0408,", "0.0408,inf", 1), vec!["0.csv, row 3", "column x_m"]),
        (good.replacen("\n0.0408,", "\n0.0408,,", 1), vec!["0.csv, row 3"]),
        (good.replacen("0.0816,", "0.0408,", 1), vec!["0.csv, row 4", "column time_s"]),
        ("time_s,x_m\n0,1\n".to_owned(), vec!["0.csv", "1 sample"]),
        ("time_s,x_m\n".to_owned(), vec!["0.csv"]),
        (good.replacen("x_m", "y_m", 1), vec!["x_m"]),
    ] {
        let folder = dataset(&[(bad, "{ h_m = 1 }"), (good.clone(), "{ h_m = 2 }")]);
        let said = folder.call(&[&QUICK[..], &["--out", "s.json"]].concat());
        assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{}", said.stderr);
        assert!(parts.iter().all(|part| said.stderr.contains(part)), "{parts:?}: {}", said.stderr);
        assert_eq!(folder.names(), ["d"], "nothing is written");
    }
}

#[test]
fn rows_16_and_17_parameters_that_say_too_little_are_warned_of() {
    let files = |thetas: [&'static str; 3]| dataset(&thetas.map(|theta| (csv(60, |s| 0.5 * s), theta)));
    for thetas in [["{ h_m = 1 }"; 3], ["{ a = 1, b = 2 }", "{ a = 2, b = 4 }", "{ a = 3, b = 6 }"]] {
        let said = files(thetas).call(&QUICK);
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        assert!(said.stdout.contains("warning") && said.stdout.contains("theta_m"), "{}", said.stdout);
        assert!(!said.stdout.contains("NaN"), "{}", said.stdout);
    }
    let both = files(["{ a = 1, b = 2, c = 5 }", "{ a = 2, b = 4, c = 5 }", "{ a = 3, b = 6, c = 5 }"]).call(&QUICK);
    let told = "vary 1 of 3 parameters; c never changes and has no effect; a, b change together";
    assert!(both.stdout.contains(told), "{}", both.stdout);
}

#[test]
fn row_14_numbers_that_cannot_be_squared_are_refused_with_their_place() {
    let tiny = |s: f64| 1e-160 * s;
    let good = |theta| (csv(50, |s| s), theta);
    for (files, told) in [
        ([(csv(50, tiny), "{ h = 1 }"), (csv(50, tiny), "{ h = 2 }")], "column x_m: found a change by 1e-160 over all demonstrations"),
        ([good("{ h = 1e300 }"), good("{ h = 2 }")], "column theta_m.h: found 1e300, expected a magnitude up to 1e100"),
        ([good("{ h = 1e-160 }"), good("{ h = 2e-160 }")], "column theta_m.h: found a change by 1e-160 over all demonstrations"),
    ] {
        let said = dataset(&files).call(&QUICK);
        assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{told}: {}", said.stderr);
        assert!(said.stderr.contains(told), "{told}: {}", said.stderr);
    }
}

#[test]
fn row_14_a_constant_column_is_learned_and_too_few_samples_are_refused() {
    let said = dataset(&[(csv(60, |_| 0.25), "{}"), (csv(60, |_| 0.25), "{}")]).call(&QUICK);
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    assert!(!said.stdout.contains("NaN"), "{}", said.stdout);
    let said = dataset(&[(csv(3, |s| s), "{}")]).call(&QUICK);
    assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{}", said.stderr);
    assert!(said.stderr.contains("found 3 samples, expected at least 7"), "{}", said.stderr);
}

#[test]
fn row_15_demonstrations_of_other_parameters_are_told_apart() {
    let said = dataset(&[(csv(50, |s| s), "{ h_m = 1 }"), (csv(50, |s| s), "{ w_m = 2 }")]).call(&QUICK);
    assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{}", said.stderr);
    assert!(["h_m", "w_m"].iter().all(|name| said.stderr.contains(name)), "{}", said.stderr);
}

/// Three heights of a bow, so that the parameter matters.
fn bows() -> Folder {
    let bow = |height: f64| csv(80, move |s| 0.4 * s + height * (std::f64::consts::PI * s).sin());
    dataset(&[(bow(0.1), "{ h_m = 0.1 }"), (bow(0.2), "{ h_m = 0.2 }"), (bow(0.4), "{ h_m = 0.4 }")])
}

#[test]
fn rows_17_and_20_far_away_queries_are_finite_told_and_can_be_denied() {
    let folder = bows();
    assert_eq!(folder.call(&[&QUICK[..], &["--out", "s.json"]].concat()).code, Some(0));
    for far in ["1e6", "-1e6"] {
        let theta = format!("h_m={far}");
        let said = folder.call(&["generate", "s.json", "--theta", &theta]);
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        assert!(said.stderr.contains("warning") && said.stderr.contains("of its range"), "{}", said.stderr);
        let mut numbers = said.stdout.lines().skip(1).flat_map(|line| line.split(',')).map(|cell| cell.parse::<f64>().expect("a number"));
        assert!(numbers.all(f64::is_finite), "{far}");
        assert_eq!(folder.call(&["generate", "s.json", "--theta", &theta, "--deny-extrapolation", "1"]).code, Some(10));
    }
}

#[test]
fn row_18_more_states_than_samples_end_with_4_and_both_numbers() {
    let said = bows().call(&["learn", "d", "--states", "200", "--set", "rate_hz=5", "--out", "s.json"]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(4), ""), "{}", said.stderr);
    assert!(said.stderr.contains("3 demonstrations with 33 samples cannot support 200 states"), "{}", said.stderr);
}

#[test]
fn row_19_a_fit_that_did_not_settle_is_warned_of() {
    let said = bows().call(&[&QUICK[..], &["--max-iterations", "2"]].concat());
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stdout.contains("the motion model used all iterations without converging"), "{}", said.stdout);
}

#[test]
fn row_22_a_threshold_that_separates_nothing_is_warned_of_with_the_values() {
    for (sigma, who) in [("1.0", "no state complies"), ("1e-12", "every state complies")] {
        let said = bows().call(&[&QUICK[..], &["--set", &format!("compliance.threshold_m2={sigma}")]].concat());
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        assert!(said.stdout.contains(who) && said.stdout.contains("threshold"), "{who}: {}", said.stdout);
    }
}

fn skill_text() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| {
        let model = PhmmSettings { states: 3, kmeans_starts: 0, max_iterations: 5, ..PhmmSettings::default() };
        let settings =
            LearningSettings { motion: model.clone(), force: model, rate_hz: 2.0, orientation_basis: 4, ..LearningSettings::default() };
        learn(&PickAndPlace::default().dataset(0), &settings, 0).expect("learned").skill.to_json().expect("JSON")
    })
}

fn without_checksum(text: &str) -> String {
    text.lines().filter(|line| !line.contains("\"checksum\"")).collect::<Vec<_>>().join("\n")
}

#[test]
fn row_23_damaged_skills_are_refused_and_the_message_says_what_to_do() {
    let text = skill_text();
    let bare = without_checksum(text);
    let threshold = bare.lines().find(|line| line.contains("\"threshold_m2\"")).expect("there");
    for (bad, part) in [
        (bare.replacen(threshold, "\"threshold_m2\": -1.0,", 1), "must not be negative"),
        (text[..text.len() / 2].to_owned(), "not complete"),
        (text.replacen("\"version\": 1", "\"version\": 9", 1), "newer"),
        (text.replacen("cpdmp-skill", "cpdmp-run2", 1), "not a skill file"),
        (text.replacen("\"stiffness\": 5000.0", "\"stiffness\": 5001.0", 1), "remove that key"),
        (bare.replacen("\"stiffness\": 5000.0", "\"stiffness\": -1.0", 1), "stiffness"),
        (bare.replacen("\"z_m\"", "\"z_m\", \"more_m\"", 1), "expected 4"),
        (bare.replacen("\"z_m\"", "\"x_m\"", 1), "twice"),
        (bare.replacen("\"stiffness\": 5000.0", "\"stiffness\": NaN", 1), "line"),
        (bare.replacen("\"stiffness\": 5000.0", "\"stiffness\": null", 1), "line"),
        ("[".repeat(100_000), "recursion"),
        (String::new(), "not complete"),
    ] {
        let folder = Folder::with(&[("s.json", bad.as_bytes())]);
        let said = folder.call(&["generate", "s.json", "--theta", "block_height_m=0.2"]);
        assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{part}: {}", said.stderr);
        assert!(said.stderr.contains(part) && said.stderr.contains("s.json"), "{part}: {}", said.stderr);
    }
    let folder = Folder::with(&[("s.json", bare.as_bytes())]);
    let said = folder.call(&["generate", "s.json", "--theta", "block_height_m=0.2", "--expected-wrench"]);
    assert_eq!(said.code, Some(0), "a skill of another program needs no checksum: {}", said.stderr);
    assert!(said.stdout.lines().next().is_some_and(|header| header.ends_with("fx_n,fy_n,fz_n")), "{}", said.stdout);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Contract: no bytes make the reader panic, and what it accepts passes its own check and can be written again.
    #[test]
    fn row_23_no_mutation_of_a_skill_makes_the_reader_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(b"0189-.e\"[]{},:x".to_vec())), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let mut bytes = without_checksum(skill_text()).into_bytes();
        for (index, byte) in edits {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        let text = String::from_utf8_lossy(&bytes);
        if let Ok(skill) = Skill::from_json(&text) {
            prop_assert!(skill.check().is_ok());
            prop_assert!(!skill.to_json().expect("what is read can be written").contains("NaN"));
        }
    }
}
