//! Which columns of a trajectory say something about the movement, and which contradict it or say nothing.

use nalgebra::Isometry3;

use super::arm_columns::{ArmColumns, POSE};
use super::arm_motion::poses;
use super::{Setup, SimulationError};
use crate::demonstration::Trajectory;
use crate::world::{Object, support_height_m};

/// How far samples may have an object from where the scene keeps it before that is worth a word (m, and rad).
const KEPT: f64 = 2e-3;

/// What is odd about the columns of a trajectory, though [`super::ArmMotion`] takes the movement from it: one sentence each. Columns in
/// `passed_over`, such as the forces in a step log, are not spoken of.
///
/// # Errors
/// When columns tell of other joints of the robot than the working arm's, describe the arm in two ways that do not agree, or give half a pose of an object.
pub fn check_columns(setup: &Setup, trajectory: &Trajectory, passed_over: &[String]) -> Result<Vec<String>, SimulationError> {
    let joints: Vec<String> = setup.arm_joints().into_iter().map(|joint| joint.name).collect();
    let arm = ArmColumns::of(&joints);
    let there = |names: &[String]| names.iter().filter(|name| trajectory.column_index(name).is_some()).cloned().collect::<Vec<_>>();
    let mut faults = others(setup, trajectory, &joints);
    faults.extend(arm.contradiction(setup, trajectory));
    let mut used: Vec<String> = [arm.all(), vec!["gripper".to_owned(), "gripper_opening".to_owned()]].concat();
    let mut odd = Vec::new();
    for object in &setup.experiment.objects {
        let prefixes = [format!("object_{}_", object.name), format!("{}_", object.name)];
        if prefixes.iter().all(|prefix| POSE.iter().all(|axis| trajectory.column_index(&format!("{prefix}{axis}")).is_some())) {
            let [long, short] = &prefixes;
            faults.push(format!("it has the pose of `{}` twice, in {long}x_m … and {short}x_m …: keep one of them", object.name));
        }
        for prefix in prefixes {
            let columns = POSE.map(|axis| format!("{prefix}{axis}"));
            if columns.iter().any(|name| passed_over.contains(name)) {
                continue;
            }
            let found = there(&columns);
            if !found.is_empty() && found.len() < POSE.len() {
                faults.push(format!(
                    "of the pose of `{}` it has only [{}]: give all of {prefix}x_m … {prefix}qw, or none",
                    object.name,
                    found.join(", ")
                ));
            }
            faults.extend(no_turn(trajectory, &prefix));
            odd.extend(poses(trajectory, &prefix).and_then(|poses| displaced(setup, object, &poses)));
            used.extend(columns);
        }
    }
    if !faults.is_empty() {
        return Err(SimulationError::Trajectory(faults.join("; ")));
    }
    let unused = trajectory.columns().iter().filter(|name| !used.contains(name) && !passed_over.contains(name));
    let unused: Vec<&str> = unused.map(String::as_str).collect();
    if !unused.is_empty() {
        odd.push(format!(
            "columns that nothing is taken from: [{}]: no joint of the arm and no object of the scene has that name",
            unused.join(", ")
        ));
    }
    Ok(odd)
}

/// How far the length of a quaternion may be from 1: what digits lose that somebody has rounded.
const UNIT: f64 = 1e-3;

/// The first sample whose orientation is none.
fn no_turn(trajectory: &Trajectory, prefix: &str) -> Option<String> {
    let turns = trajectory.select(&["qx", "qy", "qz", "qw"].map(|axis| format!("{prefix}{axis}"))).ok()?;
    let (row, norm) = turns.row_iter().map(|turn| turn.norm()).enumerate().find(|(_, norm)| !(1.0 - UNIT..=1.0 + UNIT).contains(norm))?;
    Some(format!("the quaternion {prefix}qx … {prefix}qw of sample {} has the length {norm}, but must have the length 1", row + 1))
}

/// Columns of joints that the movement cannot move.
fn others(setup: &Setup, trajectory: &Trajectory, joints: &[String]) -> Vec<String> {
    let is_other = |column: &&String| {
        let joint = column.strip_suffix("_rad").or_else(|| column.strip_suffix("_m"));
        joint.is_some_and(|joint| setup.robot.joint_index(joint).is_some() && !joints.iter().any(|own| own == joint))
    };
    let columns: Vec<&str> = trajectory.columns().iter().filter(is_other).map(String::as_str).collect();
    if columns.is_empty() {
        return Vec::new();
    }
    let (tool, columns) = (&setup.experiment.robot.tool_link, columns.join(", "));
    vec![format!(
        "[{columns}] are not of the arm that ends in `{tool}`, and only that one moves here: leave them out, or change `robot.tool_link`"
    )]
}

/// What to say of samples that have an object elsewhere than the scene, which keeps it in its place.
fn displaced(setup: &Setup, object: &Object, poses: &[Isometry3<f64>]) -> Option<String> {
    if object.moves() {
        return None;
    }
    let (all, parameters) = (&setup.experiment.objects, &setup.experiment.parameters);
    let start = object.pose(parameters, support_height_m(all, object, parameters));
    let off_m = poses.iter().map(|pose| (pose.translation.vector - start.translation.vector).norm()).fold(0.0, f64::max);
    let off_rad = poses.iter().map(|pose| pose.rotation.angle_to(&start.rotation)).fold(0.0, f64::max);
    (off_m > KEPT || off_rad > KEPT).then(|| {
        let (name, off_mm, off_deg) = (&object.name, off_m * 1e3, off_rad.to_degrees());
        format!("the samples have `{name}` up to {off_mm:.1} mm and {off_deg:.1} deg from where the scene keeps it: it is judged as in the scene")
    })
}
