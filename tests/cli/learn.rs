//! `cpdmp learn` on demonstrations that no simulator made: one CSV file, one command.

use serde_json::Value;

use super::{Folder, Said};
use crate::support::hand_made::strokes_csv;

/// Fewer starts and states than the defaults: the tests are about the command.
const QUICK: [&str; 4] = ["--states", "8", "--set", "motion.kmeans_starts=0"];

pub fn strokes() -> Folder {
    Folder::with(&[("strokes.csv", strokes_csv(6).as_bytes())])
}

pub fn learn(folder: &Folder, more: &[&str]) -> Said {
    folder.call(&[&["learn", "strokes.csv"], &QUICK[..], more].concat())
}

fn json(said: &Said) -> Value {
    serde_json::from_str(&said.stdout).unwrap_or_else(|error| panic!("{error}: {}{}", said.stdout, said.stderr))
}

#[test]
fn one_csv_with_several_repetitions_is_learned_in_one_command() {
    let folder = strokes();
    let said = learn(&folder, &["--theta", "start", "--out", "made/skill.json", "--format", "json"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let report = json(&said);
    assert_eq!(report["data"]["demonstrations"].as_array().map(Vec::len), Some(6));
    assert_eq!(report["skill"]["states"].as_array().map(Vec::len), Some(8));
    assert_eq!(report["written"], "made/skill.json");
    let rms = report["reproduction_overall"]["rms"].as_f64().expect("an error is told");
    assert!(rms > 0.0 && rms < 0.01, "the strokes are 1 m long and repeated within {rms} m");
    assert!(cpdmp::learning::Skill::read(&folder.path().join("made/skill.json")).is_ok());
    assert_eq!(folder.names(), ["made", "strokes.csv"]);
}

#[test]
fn people_and_programs_are_told_the_same_numbers() {
    let folder = strokes();
    let report = json(&learn(&folder, &["--theta", "start", "--format", "json"]));
    let said = learn(&folder, &["--theta", "start"]);
    assert!(said.stdout.contains("start_x_m 0 … 0.5"), "{}", said.stdout);
    let likelihood = report["motion_fit"]["log_likelihood"].as_array().and_then(|all| all.last()?.as_f64()).expect("a number");
    let rms = report["reproduction"][2]["rms"].as_f64().expect("a number");
    for number in [likelihood, rms] {
        let digits = format!("{number:.9}").trim_start_matches(['-', '0', '.']).chars().take(2).collect::<String>();
        assert!(said.stdout.contains(&digits), "{number} in {}", said.stdout);
    }
    assert!(said.stderr.contains("nothing was written"), "{}", said.stderr);
}

#[test]
fn left_out_start_points_are_predicted_and_the_winner_is_named() {
    let said = learn(&strokes(), &["--theta", "start", "--cross-validate", "--format", "json"]);
    let validation = &json(&said)["cross_validation"];
    assert_eq!((validation["folds"].as_u64(), validation["demonstrations"].as_array().map(Vec::len)), (Some(6), Some(6)));
    let rms = |of: &str| validation[of]["rms"].as_f64().expect("a number");
    assert!(rms("with_ends") < 0.05, "unseen start points are reached within {} m", rms("with_ends"));
    assert_eq!(validation["better"] == "cpdmp", rms("with_ends") < rms("lwr"));
}

#[test]
fn every_flag_reaches_the_learner() {
    let folder = strokes();
    let states = |more: &[&str]| json(&folder.call(&[&["learn", "strokes.csv", "--format", "json"], more].concat()));
    let report = states(&["--states", "5", "--max-iterations", "3", "--tolerance", "0", "--stiffness", "900", "--motion", "y_m"]);
    assert_eq!(report["motion_fit"]["iterations"], 3, "tolerance 0 makes exactly the most iterations");
    assert_eq!((&report["skill"]["stiffness"], &report["skill"]["columns"]), (&900.0.into(), &serde_json::json!(["y_m"])));
    let report = states(&["--set", "learning.motion.states=4", "--seed", "7", "--ridge", "1", "--theta", "start_relative_to_goal"]);
    assert_eq!((report["skill"]["states"].as_array().map(Vec::len), &report["seed"]), (Some(4), &7.into()));
    assert_eq!(report["skill"]["parameter_source"], "start_relative_to_goal");
    let report = states(&["--baseline"]);
    assert_eq!((&report["skill"]["shaping"], &report["motion_fit"]), (&"lwr".into(), &Value::Null));
}

/// Contract: flag, override and file say the same thing in the same words, and what was chosen is told with its curve.
#[test]
fn the_demonstrations_choose_what_is_called_auto() {
    let folder = strokes();
    let file = "[learning]\nstates_min = 2\nstates_max = 4\n[learning.motion]\nkmeans_starts = 0\nstates = \"auto\"\nridge = \"auto\"\n";
    std::fs::write(folder.path().join("s.toml"), file).expect("written");
    let choices = |more: &[&str]| {
        let report = json(&folder.call(&[&["learn", "strokes.csv", "--theta", "start", "--format", "json"], more].concat()));
        let states = report["skill"]["states"].as_array().map(Vec::len);
        (report["choices"].clone(), states)
    };
    let set = ["states_min=2", "states_max=4", "motion.kmeans_starts=0"].map(|set| format!("--set={set}"));
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let (chosen, states) = choices(&["--settings", "s.toml"]);
    assert_eq!((&chosen[0]["setting"], &chosen[1]["setting"]), (&"motion.states".into(), &"motion.ridge".into()));
    assert_eq!((chosen[0]["curve"].as_array().map(Vec::len), chosen[0]["chosen"].as_f64()), (Some(3), states.map(|n| n as f64)));
    assert!(chosen[1]["curve"].as_array().is_some_and(|curve| curve.len() > 5));
    for words in [&["--set=motion.states=auto", "--set=motion.ridge=auto"][..], &["--states", "auto", "--ridge", "auto"]] {
        assert_eq!(choices(&[&set[..], words].concat()), (chosen.clone(), states), "{words:?}");
    }
    let (by_bic, _) = choices(&[&set[..], &["--set=motion.states=auto", "--set=states_criterion=bic"]].concat());
    assert_ne!(by_bic[0]["curve"], chosen[0]["curve"], "another criterion has another curve");
    assert_eq!(
        choices(&["--settings", "s.toml", "--states", "3", "--ridge", "0.1"]).0,
        serde_json::json!([]),
        "a number wins over a word below"
    );
}

#[test]
fn settings_come_from_a_file_below_the_flags() {
    let folder = strokes();
    std::fs::write(folder.path().join("s.toml"), "[learning]\nstiffness = 700\n[learning.motion]\nstates = 3\n").expect("written");
    let report = json(&folder.call(&["learn", "strokes.csv", "--settings", "s.toml", "--states", "4", "--format", "json"]));
    assert_eq!((&report["skill"]["stiffness"], report["motion_fit"]["states"].as_u64()), (&700.0.into(), Some(4)));
    std::fs::write(folder.path().join("s.toml"), "[learning]\nstifness = 700\n").expect("written");
    let said = folder.call(&["learn", "strokes.csv", "--settings", "s.toml"]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""));
    assert!(said.stderr.contains("s.toml:2") && said.stderr.contains("did you mean `stiffness`"), "{}", said.stderr);
}

#[test]
fn a_skill_is_continued_and_one_of_other_columns_is_refused() {
    let folder = strokes();
    assert_eq!(learn(&folder, &["--out", "a.json", "--max-iterations", "5"]).code, Some(0));
    let go_on = ["learn", "strokes.csv", "--init", "a.json", "--max-iterations", "4", "--tolerance", "0", "--format", "json"];
    let report = json(&folder.call(&go_on));
    assert_eq!((&report["motion_fit"]["starts"], &report["motion_fit"]["states"]), (&1.into(), &8.into()));
    assert_eq!(report["motion_fit"]["iterations"], 4);
    let said = folder.call(&[&go_on[..4], &["--motion", "y_m"]].concat());
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    assert!(said.stderr.contains("motion columns of the first skill are [x_m, y_m], of the dataset [y_m]"), "{}", said.stderr);
}

#[test]
fn only_a_skill_is_replaced() {
    let folder = strokes();
    std::fs::write(folder.path().join("thesis.json"), "{\"years\": \"of work\"}").expect("written");
    for place in ["thesis.json", "."] {
        let said = learn(&folder, &["--out", place]);
        assert_eq!((said.code, said.stdout.as_str()), (Some(20), ""), "{}", said.stderr);
    }
    assert_eq!(std::fs::read_to_string(folder.path().join("thesis.json")).expect("there"), "{\"years\": \"of work\"}");
    for _ in 0..2 {
        assert_eq!(learn(&folder, &["--out", "a.json"]).code, Some(0), "an older skill is replaced");
    }
}

#[test]
fn quiet_says_nothing_on_stderr_and_plain_output_has_no_colours() {
    let said = learn(&strokes(), &["--quiet", "--color", "never"]);
    assert_eq!((said.code, said.stderr.as_str()), (Some(0), ""));
    assert!(!said.stdout.contains('\u{1b}') && said.stdout.contains("Reproduction"));
    assert!(learn(&strokes(), &["--color", "always"]).stdout.contains("\u{1b}[1m"));
}

#[test]
fn skills_with_features_are_told_inspected_and_generated() {
    for features in ["quadratic", "rbf"] {
        let folder = strokes();
        let said = learn(&folder, &["--theta", "start", "--features", features, "--out", "skill.json"]);
        assert_eq!(said.code, Some(0), "{features}: {}", said.stderr);
        let said = folder.call(&["inspect", "skill.json"]);
        assert_eq!(said.code, Some(0), "{features}: {}", said.stderr);
        let said = folder.call(&["generate", "skill.json", "--start", "x_m=0.2", "--start", "y_m=0.02"]);
        assert_eq!((said.code, said.stdout.contains("NaN")), (Some(0), false), "{features}: {}", said.stderr);
    }
}

#[test]
fn one_mistake_in_every_row_is_told_once() {
    let rows: String = (0..200).map(|i| format!("{},{};{},5\n", i / 10, i % 10, i)).collect();
    let folder = Folder::with(&[("strokes.csv", format!("time_s;x_m\n{rows}").as_bytes())]);
    let said = learn(&folder, &[]);
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    assert!(said.stderr.contains("strokes.csv, row 2, column time_s: ") && said.stderr.contains("199 more"), "{}", said.stderr);
    assert!(said.stderr.lines().count() < 8, "{}", said.stderr);
}

#[test]
fn every_demonstration_that_is_too_short_is_named() {
    let rows = |sequence: usize, count: usize| (0..count).map(|i| format!("{sequence},{},{i}\n", i as f64 * 0.1)).collect::<String>();
    let text = format!("repetition,time_s,x_m\n{}{}{}", rows(0, 3), rows(1, 30), rows(2, 4));
    let said = learn(&Folder::with(&[("strokes.csv", text.as_bytes())]), &[]);
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    assert!(said.stderr.contains("found 3 samples, expected at least 7") && said.stderr.contains("found 4 samples"), "{}", said.stderr);
}

#[test]
fn an_orientation_listed_as_motion_is_told_where_it_belongs() {
    let rows: String = (0..30).map(|i| format!("{},{},0,0,0,1\n", i as f64 * 0.1, i)).collect();
    let csv = format!("time_s,x_m,qx,qy,qz,qw\n{rows}");
    let list = "schema_version = 1\nmotion = [\"x_m\", \"qx\", \"qy\", \"qz\", \"qw\"]\n";
    let folder = Folder::with(&[("a.csv", csv.as_bytes()), ("dataset.toml", list.as_bytes())]);
    let said = folder.call(&["learn", "."]);
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    assert!(said.stderr.contains("motion: found qx, qy, qz, qw"), "{}", said.stderr);
}

#[test]
fn one_demonstration_is_learned_and_its_limits_are_told() {
    let rows: String = (0..60).map(|i| format!("{},{}\n", i as f64 * 0.05, (i as f64 / 20.0).sin())).collect();
    let said = learn(&Folder::with(&[("strokes.csv", format!("time_s,x_m\n{rows}").as_bytes())]), &[]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stdout.contains("1 demonstration of 2.950 s, sampled at 20.00 Hz"), "{}", said.stdout);
    assert!(said.stdout.contains("there is one demonstration only"), "{}", said.stdout);
}

#[test]
fn numbers_too_large_to_be_squared_are_refused_with_their_sample() {
    let rows: String = (0..60).map(|i| format!("{},{}\n", i as f64 * 0.05, if i == 7 { "1e300" } else { "0.1" })).collect();
    let said = learn(&Folder::with(&[("strokes.csv", format!("time_s,x_m\n{rows}").as_bytes())]), &[]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{}", said.stderr);
    assert!(said.stderr.contains("strokes, column x_m: found 1e300 in sample 7, expected a magnitude up to 1e100"), "{}", said.stderr);
}

#[test]
fn columns_with_a_part_of_their_own_are_no_motion_and_none_stands_in_both_models() {
    let folder = Folder::with(&[("strokes.csv", b"time_s,x_m,gripper,fx_n\n0,0,0,1\n1,1,1,2\n2,0,0,1\n")]);
    for (flags, told) in [
        (&["--motion", "x_m,gripper"][..], "motion: found gripper, expected other columns only"),
        (&["--wrench", "qx,fx_n"], "wrench: found qx, expected other columns only"),
        (&["--motion", "x_m", "--wrench", "x_m"], "wrench: found x_m, which is in motion too"),
    ] {
        let said = learn(&folder, flags);
        assert!(said.code == Some(3) && said.stderr.contains(told), "{flags:?}: {}", said.stderr);
    }
}

/// Contract: one mistake in many rows is one line; two kinds of mistakes are two, and what stands in no column is told of the file.
#[test]
fn many_faults_of_one_kind_are_one_line_each() {
    let bad = |i: usize| match i % 4 {
        0 => "1.5,x",
        1 => "nan,0",
        2 => "1.5",
        _ => "0,0",
    };
    let rows = |take: [usize; 2]| (0..40).filter(|i| take.contains(&(i % 4))).map(|i| format!("{i},{}\n", bad(i))).collect::<String>();
    for (take, lines) in
        [([0, 3], vec!["in this column"]), ([0, 1], vec!["in this column", "in this column"]), ([2, 3], vec!["in this file"])]
    {
        let said = learn(&Folder::with(&[("strokes.csv", format!("time_s,x_m,y_m\n{}", rows(take)).as_bytes())]), &[]);
        let told: Vec<&str> = said.stderr.lines().filter(|line| line.contains("more such")).collect();
        assert_eq!((said.code, told.len()), (Some(3), lines.len()), "{}", said.stderr);
        assert!(told.iter().zip(lines).all(|(line, part)| line.contains(part)), "{}", said.stderr);
    }
}

#[test]
fn a_first_skill_leaves_nothing_to_choose() {
    let folder = strokes();
    assert_eq!(learn(&folder, &["--theta", "start", "--out", "first.json"]).code, Some(0));
    let again = |more: &[&str]| folder.call(&[&["learn", "strokes.csv", "--theta", "start", "--init", "first.json"], more].concat());
    let said = again(&[]);
    assert!(said.code == Some(0) && !said.stderr.contains("demonstrations; learning"), "{}", said.stderr);
    let said = again(&["--ridge", "auto"]);
    assert!(said.code == Some(3) && said.stderr.contains("--init keeps the numbers of states"), "{}", said.stderr);
}

#[test]
fn ends_of_a_baseline_that_say_nothing_are_told() {
    let told = ["--set", "lwr_ends=regression"];
    let said = learn(&strokes(), &told);
    assert!(said.code == Some(0) && said.stderr.contains("`learning.lwr_ends` means nothing with shaping"), "{}", said.stderr);
    let said = strokes().call(&[&["learn", "strokes.csv", "--baseline", "--theta", "start"], &told[..]].concat());
    assert!(
        said.code == Some(0) && said.stdout.contains("lwr_ends has no effect with theta = \"start\""),
        "{}{}",
        said.stdout,
        said.stderr
    );
}

#[test]
fn long_work_is_announced() {
    let said = learn(&strokes(), &["--theta", "start", "--cross-validate"]);
    assert!(said.stderr.contains("once more for each parameter value left out"), "{}", said.stderr);
    assert!(!learn(&strokes(), &[]).stderr.contains("learning the"), "what is done at once is not announced");
}

/// Three bows with a force, a parameter of the motion and one of the force.
fn with_forces() -> Folder {
    let mut list = "schema_version = 1\nmotion = [\"x_m\", \"y_m\"]\nwrench = [\"fx_n\"]\n".to_owned();
    let mut files = Vec::new();
    for k in 0..4 {
        let row = |i: usize| {
            let (u, a) = (i as f64 / 59.0, 0.1 * k as f64);
            let s = u * u * (3.0 - 2.0 * u);
            format!("{},{},{},{}\n", 2.0 * u, 0.5 * s, a * (3.1 * u).sin(), (k + 1) as f64 * s)
        };
        files.push((format!("{k}.csv"), format!("time_s,x_m,y_m,fx_n\n{}", (0..60).map(row).collect::<String>())));
        list += &format!("[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {{ a = 0.{k} }}\ntheta_f = {{ b = {k} }}\n");
    }
    files.push(("dataset.toml".to_owned(), list));
    Folder::with(&files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect::<Vec<_>>())
}

/// Contract: parameters of forces are no obstacle where nothing is learned of forces.
#[test]
fn parameters_of_forces_stand_beside_a_baseline_and_a_cross_validation() {
    let folder = with_forces();
    for flags in [&["--cross-validate"][..], &["--no-wrench", "--cross-validate"], &["--no-wrench"]] {
        let said = folder.call(&[&["learn", "."], &QUICK[..], flags].concat());
        assert_eq!(said.code, Some(0), "{flags:?}: {}", said.stderr);
    }
    let said = folder.call(&["learn", ".", "--baseline"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
}

/// Contract: values that are all in range, but were never shown together, are outside; and so is a parameter of the force.
#[test]
fn combinations_that_were_not_shown_and_parameters_of_forces_count_as_extrapolation() {
    let rows =
        |k: usize| -> String { (0..60).map(|i| format!("{},{}\n", i as f64 / 30.0, 0.1 * k as f64 + (i as f64 / 60.0).powi(2))).collect() };
    let mut list = "schema_version = 1\nmotion = [\"x_m\"]\nwrench = []\n".to_owned();
    let mut files: Vec<(String, String)> = (0..4).map(|k| (format!("{k}.csv"), format!("time_s,x_m\n{}", rows(k)))).collect();
    for k in 0..4 {
        let (a, b) = (0.1 * k as f64, 0.1 * k as f64 + 0.005 * ((k * k) % 3) as f64);
        list += &format!("[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {{ a = {a}, b = {b} }}\n");
    }
    files.push(("dataset.toml".to_owned(), list));
    let folder = Folder::with(&files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect::<Vec<_>>());
    let said = folder.call(&[&["learn", "."], &QUICK[..], &["--out", "s.json"]].concat());
    assert!(said.code == Some(0) && said.stdout.contains("nearly collinear"), "{}{}", said.stdout, said.stderr);
    let near = folder.call(&["generate", "s.json", "--theta", "a=0.15", "--theta", "b=0.152", "--deny-extrapolation", "0"]);
    assert_eq!(near.code, Some(0), "{}", near.stderr);
    let far = folder.call(&["generate", "s.json", "--theta", "a=0", "--theta", "b=0.3", "--deny-extrapolation", "1"]);
    assert!(far.code == Some(10) && far.stderr.contains("combined with others as was not demonstrated"), "{}", far.stderr);

    let folder = with_forces();
    assert_eq!(folder.call(&[&["learn", "."], &QUICK[..], &["--out", "s.json"]].concat()).code, Some(0));
    let asked = ["generate", "s.json", "--theta", "a=0.1", "--theta", "b=50", "--expected-wrench", "--deny-extrapolation", "1"];
    let said = folder.call(&asked);
    assert!(said.code == Some(10) && said.stderr.contains("a parameter of the force lies outside"), "{}", said.stderr);
}

/// Contract: the end is reached and the method matters little, however far apart the samples that are written.
#[test]
fn samples_far_apart_and_short_durations_end_where_they_should() {
    let folder = strokes();
    assert_eq!(learn(&folder, &["--theta", "start", "--out", "s.json"]).code, Some(0));
    let end = |more: &[&str]| -> Vec<f64> {
        let said = folder.call(&[&["generate", "s.json", "--start", "x_m=0.1"], more].concat());
        let last = said.stdout.lines().last().unwrap_or_else(|| panic!("{}", said.stderr));
        last.split(',').skip(1).map(|cell| cell.parse().expect("a number")).collect()
    };
    let fine = end(&["--dt", "0.001", "--until", "1.5"]);
    for more in [
        &["--duration", "0.005", "--until", "1.5"][..],
        &["--dt", "0.5", "--until", "1.5"],
        &["--dt", "0.1", "--integrator", "rk4", "--until", "1.5"],
    ] {
        let worst = end(more).iter().zip(&fine).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-3, "{more:?}: {worst} m off");
    }
}

/// Contract: a column that stands still changes nothing about the others.
#[test]
fn a_constant_column_leaves_the_others_as_they_are() {
    let text = strokes_csv(6);
    let mut lines = text.lines();
    let mut wider = format!("{},q_rad,r_rad\n", lines.next().expect("a header"));
    lines.for_each(|line| wider += &format!("{line},0.7,-1.3\n"));
    let rms = |csv: &str| {
        let folder = Folder::with(&[("strokes.csv", csv.as_bytes())]);
        let report = json(&learn(&folder, &["--theta", "start", "--cross-validate", "--format", "json"]));
        report["cross_validation"]["with_ends"]["max"].as_f64().expect("an error")
    };
    let (alone, beside) = (rms(&text), rms(&wider));
    assert!((beside / alone - 1.0).abs() < 0.2, "{alone} m alone, {beside} m beside two columns that stand still");
}

#[test]
fn how_demonstrations_were_prepared_is_told() {
    let said = learn(&strokes(), &[]);
    assert!(said.stdout.contains("resampled to 25 Hz, smoothed over") && said.stdout.contains("degree 4"), "{}", said.stdout);
    let report = json(&learn(&strokes(), &["--format", "json"]));
    assert_eq!((report["preparation"]["rate_hz"].as_f64(), report["preparation"]["smoothing_degree"].as_u64()), (Some(25.0), Some(4)));
    let rows: String = (0..12).map(|i| format!("{},{}\n", i as f64 * 0.5, (i as f64 / 4.0).sin())).collect();
    let said = learn(&Folder::with(&[("strokes.csv", format!("time_s,x_m\n{rows}").as_bytes())]), &[]);
    assert!(said.stdout.contains("smoothed over 3.500 s instead of 0.5 s"), "{}{}", said.stdout, said.stderr);
}

#[test]
fn repetitions_told_apart_by_time_are_chosen_by_number_and_an_end_is_given_once() {
    let rows: String = (0..3)
        .flat_map(|k| (0..40).map(move |i| format!("{},{}\n", i as f64 * 0.05, 0.1 * k as f64 + (i as f64 / 40.0).powi(2))))
        .collect();
    let list = |sequence: u32| {
        format!("schema_version = 1\n[[demonstration]]\nfile = \"all.csv\"\nsequence = {sequence}\ntheta_m = {{ a = 1.0 }}\n")
    };
    let folder =
        |sequence| Folder::with(&[("all.csv", format!("time_s,x_m\n{rows}").as_bytes()), ("dataset.toml", list(sequence).as_bytes())]);
    let said = folder(2).call(&[&["learn", "."], &QUICK[..]].concat());
    assert!(said.code == Some(0) && said.stdout.contains("all_2"), "{}{}", said.stdout, said.stderr);
    let said = folder(4).call(&[&["learn", "."], &QUICK[..]].concat());
    assert!(said.code == Some(3) && said.stderr.contains("expected one of [1, 2, 3]"), "{}", said.stderr);

    let folder = strokes();
    assert_eq!(learn(&folder, &["--theta", "start", "--out", "s.json"]).code, Some(0));
    let theta = ["--theta", "start_x_m=0.05", "--theta", "start_y_m=0"];
    let said = folder.call(&[&["generate", "s.json"], &theta[..], &["--start", "x_m=0.2"]].concat());
    assert!(said.code == Some(2) && said.stderr.contains("give one of the two"), "{}", said.stderr);
}

#[test]
fn what_the_demonstrations_cannot_say_is_told() {
    let two = Folder::with(&[("strokes.csv", strokes_csv(2).as_bytes())]);
    let said = two.call(&["learn", "strokes.csv", "--states", "auto", "--cross-validate"]);
    assert_eq!(said.code, Some(4), "{}", said.stderr);
    assert!(said.stderr.contains("leaving one out, of two, leaves one to choose the number of states by"), "{}", said.stderr);
    let said = learn(&two, &["--ridge", "auto"]);
    assert!(said.code == Some(0) && said.stdout.contains("motion.ridge = 0.1 (nothing to choose by"), "{}{}", said.stdout, said.stderr);
    let said = learn(&strokes(), &["--features", "rbf"]);
    assert!(said.code == Some(0) && said.stdout.contains("motion.features has no effect"), "{}{}", said.stdout, said.stderr);
}

#[test]
fn times_in_another_unit_and_samples_in_bursts_are_told_or_borne() {
    let line = |time: f64, u: f64| format!("{time:e},{},{}\n", u * u * (3.0 - 2.0 * u), (3.0 * u).sin());
    let csv = |time: fn(usize) -> f64| (0..200).map(|i| line(time(i), i as f64 / 199.0)).collect::<String>();
    let learned = |rows: String| learn(&Folder::with(&[("strokes.csv", format!("time_s,x_m,y_m\n{rows}").as_bytes())]), &[]);
    let said = learned(csv(|i| 1e-7 * i as f64));
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    assert!(said.stderr.contains("one period of rate_hz = 25: are its times in seconds"), "{}", said.stderr);
    // Twenty samples within 2 microseconds, every 0.2 s.
    let said = learned(csv(|i| 0.2 * (i / 20) as f64 + 1e-7 * (i % 20) as f64));
    assert_eq!(said.code, Some(0), "{}", said.stderr);
}

/// Contract: rounding in a parameter is no range of it.
#[test]
fn a_parameter_that_differs_by_rounding_never_varied() {
    let rows = |size: f64| (0..100).map(|i| format!("{},{}\n", 0.02 * f64::from(i), size * f64::from(i) / 99.0)).collect::<String>();
    let mut list = "schema_version = 1\nmotion = [\"x_m\"]\n".to_owned();
    let mut files = Vec::new();
    for (k, height) in ["0.3", "0.30000000000000004", "0.3"].iter().enumerate() {
        files.push((format!("{k}.csv"), format!("time_s,x_m\n{}", rows(1.0 + k as f64))));
        list += &format!("[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {{ height_m = {height}, size_m = {k} }}\n");
    }
    files.push(("dataset.toml".to_owned(), list));
    let folder = Folder::with(&files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect::<Vec<_>>());
    assert_eq!(folder.call(&[&["learn", "."], &QUICK[..], &["--out", "s.json"]].concat()).code, Some(0));
    let asked = |height: &str| folder.call(&["generate", "s.json", "--theta", height, "--theta", "size_m=1", "--out", "a.csv"]).stderr;
    assert!(!asked("height_m=0.30000000000000001").contains("warning"), "{}", asked("height_m=0.3"));
    assert!(asked("height_m=0.35").contains("where it never varied"), "{}", asked("height_m=0.35"));
}

#[test]
fn a_lost_time_stamp_is_a_fault_and_begins_no_repetition() {
    let rows = |i: usize| format!("{},{}\n", if i == 76 { 0.0 } else { 0.02 * i as f64 }, (0.02 * i as f64).sin());
    let text = (0..150).map(rows).collect::<String>();
    let said = learn(&Folder::with(&[("strokes.csv", format!("time_s,x_m\n{text}").as_bytes())]), &[]);
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    assert!(said.stderr.contains("row 78, column time_s: found 0 after 1.5"), "{}", said.stderr);
}

#[test]
fn what_cannot_be_meant_is_told_before_it_is_generated() {
    let folder = strokes();
    assert_eq!(learn(&folder, &["--theta", "start", "--out", "s.json"]).code, Some(0));
    let said = folder.call(&["generate", "s.json", "--start", "x_m=1e300"]);
    assert_eq!(said.code, Some(2), "{}", said.stderr);
    assert!(said.stderr.contains("`1e300` is too large"), "{}", said.stderr);
    let said = folder.call(&["generate", "s.json", "--start", "x_m=0.1", "--goal", "y_m=-40"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stderr.contains("the goal is") && said.stderr.contains("times the movement's length away"), "{}", said.stderr);
}

/// Contract: parameters that are the start itself are seen, not estimated.
#[test]
fn the_start_of_an_observed_part_is_the_start() {
    let folder = strokes();
    assert_eq!(learn(&folder, &["--theta", "start", "--out", "s.json"]).code, Some(0));
    let said = folder.call(&["generate", "s.json", "--start", "x_m=0.31", "--start", "y_m=0.07", "--dt", "0.01"]);
    let part: String = said.stdout.lines().take(60).map(|line| format!("{line}\n")).collect();
    std::fs::write(folder.path().join("part.csv"), &part).expect("written");
    let said = folder.call(&["generate", "s.json", "--observe", "part.csv", "--dt", "0.01"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let cells = |line: &str| line.split(',').map(|cell| cell.parse().expect("a number")).collect::<Vec<f64>>();
    let (seen, made) = (cells(part.lines().nth(1).expect("a sample")), cells(said.stdout.lines().nth(1).expect("a sample")));
    assert!(seen.iter().zip(&made).all(|(a, b)| (a - b).abs() < 1e-9), "{seen:?} and {made:?}");
}

#[test]
fn durations_that_follow_a_parameter_are_told() {
    let mut list = "schema_version = 1\nmotion = [\"x_m\"]\n".to_owned();
    let mut files = Vec::new();
    for k in 1..6 {
        let rows: String = (0..100).map(|i| format!("{},{}\n", 0.01 * f64::from(i * k), f64::from(i) / 99.0)).collect();
        files.push((format!("{k}.csv"), format!("time_s,x_m\n{rows}")));
        list += &format!("[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {{ weight_kg = {k} }}\n");
    }
    files.push(("dataset.toml".to_owned(), list));
    let folder = Folder::with(&files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect::<Vec<_>>());
    let said = folder.call(&[&["learn", "."], &QUICK[..]].concat());
    assert!(said.code == Some(0) && said.stdout.contains("follow [weight_kg]"), "{}{}", said.stdout, said.stderr);
}
