//! A movement of the arm that somebody wrote down: joint angles or tool poses over time.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::arm_columns::POSE;
use super::{Progress, Setup, SimulationError};
use crate::demonstration::{QUATERNION_COLUMNS, Trajectory};
use crate::world::{ObjectKind, support_height_m};

/// A movement in the joints of the working arm.
#[derive(Clone, Debug)]
pub struct ArmMotion {
    /// Times (s), rising.
    pub times_s: Vec<f64>,
    /// Joint angles at each time, from the shoulder (rad).
    pub arm_rad: Vec<Vec<f64>>,
    /// Opening of the gripper at each time (0 closed … 1 open); open when nothing is said.
    pub gripper: Vec<f64>,
    /// `world_from_object` of every object at each time, when it is known of those that can move.
    pub objects: Option<Vec<Vec<Isometry3<f64>>>>,
    /// Of tool poses: how far the arm stays away from them at worst.
    pub reach: Option<Reach>,
}

/// How well the arm reaches the poses that it is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Largest distance of the tool from its pose (m).
    pub position_error_m: f64,
    /// When it first is further away than [`Self::POSITION_M`] (s).
    pub position_failed_s: Option<f64>,
    /// Largest angle between them (rad).
    pub orientation_error_rad: f64,
    /// When it first is turned away by more than [`Self::ORIENTATION_RAD`] (s).
    pub orientation_failed_s: Option<f64>,
}

impl Reach {
    /// Furthest that the tool may stay away from a pose that it is asked for (m): what the controller holds.
    pub const POSITION_M: f64 = 1e-3;
    /// Furthest that it may be turned away from it (rad): so much moves a fingertip, 20 cm from the wrist, by a millimetre.
    pub const ORIENTATION_RAD: f64 = 5e-3;

    /// Takes one more pose into account.
    fn note(&mut self, position_m: f64, orientation_rad: f64, time_s: f64) {
        if position_m > Self::POSITION_M {
            self.position_failed_s.get_or_insert(time_s);
        }
        if orientation_rad > Self::ORIENTATION_RAD {
            self.orientation_failed_s.get_or_insert(time_s);
        }
        self.position_error_m = self.position_error_m.max(position_m);
        self.orientation_error_rad = self.orientation_error_rad.max(orientation_rad);
    }
}

impl ArmMotion {
    /// From the columns of a trajectory: `NAME_rad` for every joint of the working arm, or `q1_rad`, `q2_rad` … from the shoulder, or the
    /// tool's pose `x_m, y_m, z_m, qx, qy, qz, qw` (world). `gripper` is its opening; `OBJECT_x_m` … `OBJECT_qw`, as a step log has them, are
    /// where the objects that can move are: all of them, or none, and they stay where they start.
    ///
    /// # Errors
    /// When the columns hold neither joints nor poses, or tell of some of the objects only, or `progress` does not let it go on.
    pub fn new(setup: &Setup, trajectory: &Trajectory, progress: &dyn Progress) -> Result<Self, SimulationError> {
        let mut arm = setup.arm();
        let named: Vec<String> = (0..arm.joints()).map(|joint| format!("{}_rad", arm.joint_name(joint))).collect();
        let counted: Vec<String> = (1..=arm.joints()).map(|number| format!("q{number}_rad")).collect();
        let objects = objects(setup, trajectory)?;
        let gripper = trajectory.gripper().or_else(|| trajectory.column("gripper_opening"));
        let gripper = gripper.map_or_else(|| vec![1.0; trajectory.samples()], |column| column.as_slice().to_vec());
        let mut motion = Self {
            times_s: trajectory.times_s().to_vec(),
            arm_rad: Vec::with_capacity(trajectory.samples()),
            gripper,
            objects,
            reach: None,
        };
        for names in [&named, &counted] {
            if let Ok(angles) = trajectory.select(names) {
                motion.arm_rad.extend(angles.row_iter().map(|row| row.iter().copied().collect()));
                return Ok(motion);
            }
        }
        let Some(poses) = poses(trajectory, "") else {
            let place = ["x_m", "y_m", "z_m"].iter().chain(&QUATERNION_COLUMNS).copied().collect::<Vec<_>>().join(", ");
            let (found, named, counted) = (trajectory.columns().join(", "), named.join(", "), counted.join(", "));
            return Err(SimulationError::Trajectory(format!(
                "its columns are [{found}], but must hold the joints [{named}] (or [{counted}]) or the tool's pose [{place}]"
            )));
        };
        // Each pose is solved from the posture before, so that the arm does not jump.
        let mut q = vec![0.0; arm.joints()];
        let mut reach = Reach { position_error_m: 0.0, position_failed_s: None, orientation_error_rad: 0.0, orientation_failed_s: None };
        for (sample, (pose, &time_s)) in poses.iter().zip(&motion.times_s).enumerate() {
            if !progress.may_go_on() {
                return Err(SimulationError::StoppedBefore { next: format!("the joint angles of the pose at {time_s:.3} s were found") });
            }
            let found = if sample == 0 { arm.reach(pose, &mut q) } else { arm.reach_from(pose, &mut q) };
            reach.note(found.position_error_m, found.orientation_error_rad, time_s);
            motion.arm_rad.push(q.clone());
        }
        Ok(Self { reach: Some(reach), ..motion })
    }
}

/// The poses in the columns `PREFIX_x_m` … `PREFIX_qw`, or without a prefix.
pub(super) fn poses(trajectory: &Trajectory, prefix: &str) -> Option<Vec<Isometry3<f64>>> {
    let names = POSE.map(|name| format!("{prefix}{name}"));
    let values = trajectory.select(&names).ok()?;
    let pose = |row: nalgebra::RowDVector<f64>| {
        let turn = Quaternion::new(row[6], row[3], row[4], row[5]);
        Isometry3::from_parts(Translation3::new(row[0], row[1], row[2]), UnitQuaternion::new_normalize(turn))
    };
    Some(values.row_iter().map(|row| pose(row.into_owned())).collect())
}

/// How far from its hinge a door may be logged (m): more than the engine's joint gives, less than anybody would move a cabinet.
const HINGE_M: f64 = 2e-3;

/// The poses of all objects, sample by sample, when the trajectory tells them of those that can move. The others are where the scene puts them.
fn objects(setup: &Setup, trajectory: &Trajectory) -> Result<Option<Vec<Vec<Isometry3<f64>>>>, SimulationError> {
    let (all, parameters) = (&setup.experiment.objects, &setup.experiment.parameters);
    let of_object = |name: &str| poses(trajectory, &format!("object_{name}_")).or_else(|| poses(trajectory, &format!("{name}_")));
    let told: Vec<Option<Vec<Isometry3<f64>>>> = all.iter().map(|object| of_object(&object.name).filter(|_| object.moves())).collect();
    if told.iter().all(Option::is_none) {
        return Ok(None);
    }
    let mut each = Vec::with_capacity(all.len());
    for (object, told) in all.iter().zip(told) {
        let start = object.pose(parameters, support_height_m(all, object, parameters));
        let name = &object.name;
        match told {
            Some(poses) => {
                let off_m = |pose: &Isometry3<f64>| (pose.translation.vector - start.translation.vector).norm();
                let hinge = matches!(object.kind, ObjectKind::Cabinet(_)).then_some(off_m);
                if let Some(off_m) = hinge.and_then(|off_m| poses.iter().map(off_m).find(|off_m| *off_m > HINGE_M)) {
                    return Err(SimulationError::Trajectory(format!(
                        "it has the door of `{name}` {:.1} mm from the hinge that the scenario gives it: judge it in the scene that it is of",
                        off_m * 1e3
                    )));
                }
                each.push(poses);
            }
            None if object.moves() => {
                return Err(SimulationError::Trajectory(format!(
                    "it says where other objects are, but not where `{name}` is, which can move: add the columns {name}_x_m … {name}_qw"
                )));
            }
            None => each.push(vec![start; trajectory.samples()]),
        }
    }
    Ok(Some((0..trajectory.samples()).map(|sample| each.iter().map(|poses| poses[sample]).collect()).collect()))
}
