//! Row 21 of the fault table: a coupling that does not fit what it couples, told before anything is simulated.

use crate::cli::{Folder, GOOD};

/// What `validate` says about the good scenario with these overrides, and its exit code.
fn said(set: &[&str]) -> (Option<i32>, String) {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let arguments = ["validate", "a.toml"].into_iter().chain(set.iter().flat_map(|set| ["--set", *set]));
    let said = folder.call(&arguments.collect::<Vec<_>>());
    assert_eq!(folder.names(), ["a.toml"], "nothing is written");
    (said.code, said.stderr)
}

fn refused(set: &[&str], told: &[&str]) {
    let (code, stderr) = said(set);
    assert_eq!(code, Some(3), "{set:?}: {stderr}");
    assert!(told.iter().all(|part| stderr.contains(part)), "{set:?}, {told:?}: {stderr}");
}

#[test]
fn row_21_both_shapes_are_named_when_the_jacobian_fits_no_motion() {
    let on = "coupling.enabled=true";
    refused(&[on, "coupling.space=joint"], &["wrong_length", "7 x 6", "3 x 1 (x_m, y_m, z_m)", "--set:1:", "learning.space = \"joint\""]);
    refused(&[on, "learning.space=joint"], &["3 x 3", "7 x 1 (q1_rad", "coupling.space = \"joint\""]);
    refused(&["coupling.compliance_rad_per_nm=[0.1, 0.2]"], &["`compliance_rad_per_nm` has 2 entries", "joints"]);
    refused(&["coupling.compliance_m_per_n=[0.1, 0.2]"], &["`compliance_m_per_n` has 2 entries", "x, y and z"]);
    refused(&["coupling.space=wrench"], &["`task`", "`joint`"]);
    assert_eq!(said(&[on, "coupling.space=joint", "learning.space=joint"]).0, Some(0));
    assert_eq!(said(&["coupling.space=joint"]).0, Some(0), "a coupling that is off couples nothing");
}

#[test]
fn a_beta_per_state_needs_as_many_states_and_knows_three_values() {
    let (mode, states) = ("coupling.mode=per_state", "learning.motion.states=3");
    refused(&[mode, states, "coupling.beta=[-1, 0]"], &["has 2 entries for 3 states"]);
    refused(&[mode], &["has 0 entries for 16 states"]);
    refused(&[mode, states, "coupling.beta=[-1, 0.5, 1]"], &["has 0.5 among its entries", "-1 (complies)"]);
    refused(&[mode, "learning.motion.states=auto", "coupling.beta=[-1, 0]"], &["choose how many states"]);
    refused(&[mode, "learning.states_criterion=bic", "coupling.beta=[-1, 0]"], &["choose how many states"]);
    refused(&[mode, "learning.shaping=lwr", "coupling.beta=[-1]"], &["the baseline has no states"]);
    assert_eq!(said(&[mode, states, "coupling.beta=[-1, 0, 1]"]).0, Some(0));
    let (code, stderr) = said(&["coupling.beta=[-1]"]);
    assert!(code == Some(0) && stderr.contains("warning") && stderr.contains("means nothing in the mode `comply`"), "{stderr}");
}

#[test]
fn how_a_skill_is_executed_has_ranges() {
    refused(&["execution.integrator=euler"], &["`hold`", "`rk4`"]);
    refused(&["execution.feedback=yes"], &["`none`", "`measured`"]);
    refused(
        &["execution.phase_stopping_slowest=0", "execution.phase_stopping_gain=-1", "execution.feedback_time_s=0"],
        &["0.001 … 1", "per m² or rad²", "0.001 … 100 s"],
    );
}

#[test]
fn what_the_demonstrations_choose_is_a_word_beside_numbers() {
    for model in ["motion", "force"] {
        for (key, range) in [("states", "a whole number, 1 … 200, or \"auto\""), ("ridge", "a number, 0 … 1000000.0, or \"auto\"")] {
            let path = format!("learning.{model}.{key}");
            for wrong in ["automatic", "true", "[3]", "-1"] {
                refused(&[&format!("{path}={wrong}")], &[&path, range]);
            }
            assert_eq!(said(&[&format!("{path}=auto")]).0, Some(0), "{path}");
        }
    }
    refused(&["learning.motion.states=0"], &["`learning.motion.states` is 0", "or \"auto\""]);
    refused(&["learning.motion.states=3.5"], &["`learning.motion.states` is a number", "a whole number"]);
}

/// A dataset without joints, or with another motion than the coupling can move, is refused before anything is learned.
#[test]
fn a_recorded_dataset_must_have_what_is_coupled() {
    let csv = "time_s,x_m,y_m,z_m,gap_m,fx_n\n0,0.6,0.3,0.1,0,0\n1,0.6,0.2,0.1,0,0\n2,0.6,0.1,0.1,0,0\n";
    let list = "schema_version = 1\nmotion = [\"x_m\", \"y_m\", \"z_m\", \"gap_m\"]\nwrench = [\"fx_n\"]\n\
        [[demonstration]]\nfile = \"a.csv\"\ntheta_m = { block_height_m = 0.2 }\n";
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("d/dataset.toml", list.as_bytes()), ("d/a.csv", csv.as_bytes())]);
    let said = |set: &[&str]| {
        let arguments = ["validate", "a.toml", "--set", "demonstrations=d"].into_iter().chain(set.iter().flat_map(|set| ["--set", *set]));
        let said = folder.call(&arguments.collect::<Vec<_>>());
        (said.code, said.stderr)
    };
    assert_eq!(said(&["coupling.enabled=true"]).0, Some(0));
    for (set, told) in [
        (&["learning.space=joint"][..], "7 joints, but they have no column q1_rad"),
        (&["coupling.enabled=true", "coupling.compliance_m_per_n=[0.1, 0.1, 0.1]"], "3 compliances for the 4 motion columns"),
    ] {
        let (code, stderr) = said(set);
        assert!(code == Some(3) && stderr.contains(told), "{set:?}: {stderr}");
    }
}
