//! A block that stands in the way: what a simulated run tells about it, against brute force over every step.

use std::collections::BTreeSet;
use std::fs;

use cpdmp::check::{Criterion, judge};
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::{self, Experiment, RunOutcome, Silent};
use nalgebra::Isometry3;

use super::collisions::{Brute, allowed_m, brute_force, pieces};
use crate::cli::GOOD;

/// A wrist that passes 2 cm beside a block, and the same with the block moved 3 cm into its way.
pub const BESIDE: [f64; 2] = [0.80, 0.25];
pub const IN_THE_WAY: [f64; 2] = [0.77, 0.25];

/// The good scenario with the block there, every engine step logged, and nobody who may touch the block.
pub fn scenario(block: [f64; 2]) -> String {
    let [x, y] = block;
    let moved = GOOD.replace("center_m = [1.2, 0.9]", &format!("center_m = [{x}, {y}]"));
    moved.replace("name = \"good\"", "name = \"passage\"").replace("[parameters]", "[simulation]\nlog_rate_hz = 1000\n[parameters]")
        + "\n[[criterion]]\nname = \"untouched\"\nkind = \"no_contact\"\nobjects = [\"block\"]\n"
        + "\n[[criterion]]\nname = \"clear\"\nkind = \"clearance\"\nobjects = [\"block\"]\nlinks = [\"left_wrist\"]\nmin_m = 0.005\n"
}

/// How near hard parts that press on each other are (m): the engine keeps a pair that touches a hair apart.
const TOUCH_M: f64 = 5e-5;

/// The scenario, run and judged.
pub fn run(block: [f64; 2]) -> (Experiment, RunOutcome, Vec<Criterion>) {
    run_of(&scenario(block))
}

fn run_of(text: &str) -> (Experiment, RunOutcome, Vec<Criterion>) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.toml");
    fs::write(&path, text).expect("written");
    let scenario = Scenario::load(&path, &LoadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let Work::Arm(experiment) = scenario.work else { panic!("no arm") };
    let outcome = simulation::run(&experiment, &Silent).expect("it runs");
    let criteria = judge(&outcome, &experiment, &scenario.criteria);
    (*experiment, outcome, criteria)
}

/// Every pair of a link of the left arm and a part of the block, at every engine step of the execution.
fn brute(experiment: &Experiment, outcome: &RunOutcome) -> Vec<Brute> {
    let blocks: Vec<_> = experiment.objects.iter().filter(|object| object.name == "block").cloned().collect();
    let moments: Vec<(f64, Vec<Isometry3<f64>>)> = outcome.steps.iter().map(|step| (step.time_s, step.bodies.clone())).collect();
    let robot = &outcome.robot;
    let left = |body: usize| body > 0 && robot.joints.iter().any(|j| j.child_body == body && j.name.starts_with("left"));
    brute_force(robot, left, &pieces(&blocks, &experiment.parameters, 0.0), &moments, TOUCH_M)
}

fn answer<'a>(criteria: &'a [Criterion], name: &str) -> &'a Criterion {
    criteria.iter().find(|criterion| criterion.name == name).expect("asked")
}

/// Contract: a block moved 3 cm into the way is told with the pair, the first time, the depth and the point that brute force over the logged
/// steps gives: to two steps, and to 0.1 mm.
#[test]
fn a_block_in_the_way_is_told_as_brute_force_tells_it() {
    let (experiment, outcome, criteria) = run(IN_THE_WAY);
    assert!(!answer(&criteria, "untouched").passed && !answer(&criteria, "clear").passed);
    let brute = brute(&experiment, &outcome);
    let touching: Vec<&Brute> = brute.iter().filter(|one| one.touch_s.is_some()).collect();
    let refused = outcome.collisions.iter().filter(|contact| !contact.allowed).count();
    assert!(refused > 0 && refused == touching.len(), "{:#?}\n{touching:#?}", outcome.collisions);
    for one in touching {
        let found = outcome.collisions.iter().find(|c| c.a == one.link && c.b == one.part).unwrap_or_else(|| panic!("{one:?} is missing"));
        println!("{} - {}: {:.4} s, {:.3} mm, {:.1} N", found.a, found.b, found.first_time_s, found.max_depth_m * 1e3, found.max_force_n);
        let (first, _) = one.touch_s.expect("it touches");
        assert!(!found.allowed && found.max_force_n > 0.0);
        assert!((found.first_time_s - first).abs() < 2.001e-3, "{found:?} {one:?}");
        assert!((found.max_depth_m + one.least_m).abs() < 1e-4, "{found:?} {one:?}");
        assert!((found.deepest_time_s - one.time_s).abs() < 1e-9 && (found.deepest_point - one.point).norm() < 1e-4, "{found:?} {one:?}");
    }
}

/// Contract: with the block beside the way the smallest distance of every link is the one of brute force, and nothing touches.
#[test]
fn a_block_beside_the_way_is_passed_at_the_distance_of_brute_force() {
    let (experiment, outcome, criteria) = run(BESIDE);
    let clear = answer(&criteria, "clear");
    println!("left_wrist passes at {:.2} mm", clear.value * 1e3);
    assert!(answer(&criteria, "untouched").passed && clear.passed);
    let brute = brute(&experiment, &outcome);
    let watched = outcome.clearances.iter().filter(|clearance| clearance.b == "block" && clearance.a.starts_with("left"));
    for clearance in watched {
        let truth = brute.iter().filter(|one| one.link == clearance.a).map(|one| one.least_m).fold(f64::INFINITY, f64::min);
        assert!((clearance.min_distance_m - truth).abs() < allowed_m(truth), "{clearance:?} {truth}");
    }
}

/// Contract: a run that is recorded at every tenth step tells of each pair that touches the deepest of the ten touches, and the largest of the ten
/// forces, that the same run tells when every step is recorded, and nothing else; the deepest of all is the point of the pair's contact.
#[test]
fn a_record_tells_the_deepest_touch_of_each_pair_since_the_record_before() {
    let (_, every, _) = run(IN_THE_WAY);
    let (_, tenth, _) = run_of(&scenario(IN_THE_WAY).replace("log_rate_hz = 1000", "log_rate_hz = 100"));
    assert_eq!(every.state_hash, tenth.state_hash, "one run, recorded twice");
    assert_eq!(every.collisions, tenth.collisions);
    let mut told = vec![(f64::INFINITY, nalgebra::Point3::origin()); tenth.collisions.len()];
    for record in &tenth.steps {
        let since = |step: u64| step + 10 > record.step && step <= record.step;
        let fine = || every.steps.iter().filter(|one| since(one.step)).flat_map(|one| &one.touches);
        let pairs: BTreeSet<usize> = fine().map(|touch| touch.episode).collect();
        assert_eq!(record.touches.iter().map(|touch| touch.episode).collect::<BTreeSet<_>>(), pairs, "step {}", record.step);
        for touch in &record.touches {
            let of_pair = || fine().filter(|one| one.episode == touch.episode);
            let deepest = of_pair().min_by(|a, b| a.distance_m.total_cmp(&b.distance_m)).expect("it touches");
            let force_n = of_pair().map(|one| one.force_n).fold(f64::NAN, f64::max);
            assert_eq!((touch.distance_m, touch.point), (deepest.distance_m, deepest.point), "step {}", record.step);
            assert!(touch.force_n == force_n || (touch.force_n.is_nan() && force_n.is_nan()), "step {}", record.step);
        }
        for touch in &record.touches {
            let deepest = &mut told[touch.episode];
            if touch.distance_m < deepest.0 {
                *deepest = (touch.distance_m, touch.point);
            }
        }
    }
    let refused = tenth.collisions.iter().zip(&told).filter(|(contact, _)| !contact.allowed).map(|(contact, (_, point))| {
        assert_eq!(*point, contact.deepest_point, "{contact:?}");
    });
    assert!(refused.count() > 0, "something touches");
}
