//! What every run of an experiment starts from: robot, arm models, worlds.

use std::path::Path;

use nalgebra::Isometry3;

use super::named_parts::{arm, check_lengths, check_parts};
use super::{Experiment, RobotSettings, SimulationError};
use crate::control::{ArmModel, HoldPosture, PoseTracker, WrenchObserver};
use crate::robot::baxter::{LEFT_HAND, LEFT_HOOK, LEFT_TOOL};
use crate::robot::{self, Finding, IkOutcome, Joint, LoadOptions, Loaded, RobotModel};
use crate::world::{EffortSensors, Parameters, World, WorldSettings};

/// An experiment with its robot loaded.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The experiment.
    pub experiment: Experiment,
    /// Its robot.
    pub robot: RobotModel,
    /// What is odd about the robot's file, though it can be used.
    pub warnings: Vec<Finding>,
    arm: ArmModel,
    idle: Option<ArmModel>,
}

/// The built-in robot with the tool that the experiment names.
fn built_in(settings: &RobotSettings) -> Loaded {
    if settings.tool_link == LEFT_HOOK { robot::baxter_with_hook() } else { robot::baxter() }
}

/// The robot of a file. When it lacks the tool and has Baxter's left hand, the electric gripper or the hook is mounted there.
fn load(path: &Path, settings: &RobotSettings) -> Result<Loaded, SimulationError> {
    let options = LoadOptions { package_directories: settings.package_directories.clone(), ..LoadOptions::default() };
    let bare = robot::load(path, &options)?;
    let has = |link: &str| bare.model.frame(link).is_some();
    let tool = match settings.tool_link.as_str() {
        LEFT_TOOL => robot::electric_gripper(),
        LEFT_HOOK => robot::hook(),
        _ => return Ok(bare),
    };
    if has(&settings.tool_link) || !has(LEFT_HAND) {
        return Ok(bare);
    }
    Ok(robot::load(path, &LoadOptions { attachments: vec![tool], ..options })?)
}

/// What a pose is called in an error.
#[derive(Clone, Debug, Default)]
pub(super) struct PoseName {
    /// In words.
    pub what: String,
    /// The part of the scenario that asks for it, if there is one.
    pub key: Option<String>,
}

impl From<&str> for PoseName {
    fn from(what: &str) -> Self {
        Self { what: what.to_owned(), key: None }
    }
}

impl PoseName {
    /// The error, said of the part of the scenario that asks for the pose.
    pub(super) fn told(self, error: SimulationError) -> SimulationError {
        error.at_if(self.key)
    }
}

/// The error of a pose that `arm` does not reach: `q` is as near as it comes; `help` is what to do.
pub(super) fn unreachable(arm: &ArmModel, outcome: &IkOutcome, q: &[f64], name: PoseName, help: &'static str) -> SimulationError {
    let joint = match outcome.limiting_joint {
        Some(index) => format!("with joint `{}` at its limit", arm.joint_name(index)),
        None => format!("with joint `{}` the nearest to its limit", arm.nearest_to_limit(q)),
    };
    let unreachable = SimulationError::Unreachable {
        what: name.what.clone(),
        position_mm: outcome.position_error_m * 1e3,
        angle_deg: outcome.orientation_error_rad.to_degrees(),
        joint,
        help,
    };
    name.told(unreachable)
}

impl Setup {
    /// Loads the robot of `experiment`.
    ///
    /// # Errors
    /// When the robot's file cannot be used or lacks the links that the experiment names.
    pub fn new(experiment: &Experiment) -> Result<Self, SimulationError> {
        let setup = Self::unchecked(experiment)?;
        check_parts(experiment, &setup.robot)?;
        Ok(setup)
    }

    /// As [`Self::new`], for those who have the rest told by [`Self::preflight`], together with all else that can be known before the first step.
    ///
    /// # Errors
    /// When the robot's file cannot be used or has no such arms.
    pub fn unchecked(experiment: &Experiment) -> Result<Self, SimulationError> {
        let settings = &experiment.robot;
        let loaded = match &settings.urdf {
            None => built_in(settings),
            Some(path) => load(path, settings)?,
        };
        let model = loaded.model;
        let working = arm(&model, ("tool_link", &settings.tool_link), &settings.rest_posture_rad, experiment);
        let has_idle = !settings.idle_posture_rad.is_empty();
        let idle = has_idle.then(|| arm(&model, ("idle_tool_link", &settings.idle_tool_link), &settings.idle_posture_rad, experiment));
        let (arm, idle) = match (working, idle.transpose()) {
            (Ok(working), Ok(idle)) => (working, idle),
            (working, idle) => {
                let faults = [working.err(), idle.err(), check_parts(experiment, &model).err()];
                return Err(SimulationError::Several(faults.into_iter().flatten().collect()));
            }
        };
        if let Err(lengths) = check_lengths(settings, arm.joints(), idle.as_ref().map(ArmModel::joints)) {
            return Err(SimulationError::Several([Some(lengths), check_parts(experiment, &model).err()].into_iter().flatten().collect()));
        }
        Ok(Self { experiment: experiment.clone(), robot: model, warnings: loaded.warnings, arm, idle })
    }

    /// The working arm's model.
    pub(super) fn working(&self) -> &ArmModel {
        &self.arm
    }

    /// The other arm's model, if it moves.
    pub(super) fn idle(&self) -> Option<&ArmModel> {
        self.idle.as_ref()
    }

    /// A copy of the working arm's model.
    pub(super) fn arm(&self) -> ArmModel {
        self.arm.clone()
    }

    /// Number of the working arm's joints.
    pub(super) fn joints(&self) -> usize {
        self.arm.joints()
    }

    /// A controller of the other arm.
    pub(super) fn hold(&self) -> Option<HoldPosture> {
        let settings = &self.experiment.robot;
        self.idle.clone().map(|model| HoldPosture::new(model, settings.impedance.clone(), settings.idle_posture_rad.clone()))
    }

    /// A tracker of tool poses.
    pub(super) fn tracker(&self) -> PoseTracker {
        PoseTracker::new(self.arm(), self.experiment.robot.impedance.clone(), self.experiment.physics.step_s)
    }

    /// The wrench estimate of the working arm.
    pub(super) fn observer(&self) -> WrenchObserver {
        let sensor = &self.experiment.robot.sensor;
        WrenchObserver::new(self.arm(), sensor.model, sensor.filter_cutoff_hz, self.experiment.physics.step_s)
    }

    /// The effort sensors in run number `run`.
    pub(super) fn sensors(&self, run: u64) -> EffortSensors {
        EffortSensors::new(&self.experiment.robot.sensor, self.arm.joints(), self.experiment.seed, run)
    }

    /// Joint angles at which the tool is at `base_from_tool`; in the error, the pose is called `name`, and `help` says what to do.
    pub(super) fn posture(
        &self,
        base_from_tool: &Isometry3<f64>,
        name: impl Into<PoseName>,
        help: &'static str,
    ) -> Result<Vec<f64>, SimulationError> {
        let mut arm = self.arm();
        let mut q = vec![0.0; arm.joints()];
        let outcome = arm.reach(base_from_tool, &mut q);
        if outcome.converged { Ok(q) } else { Err(unreachable(&arm, &outcome, &q, name.into(), help)) }
    }

    /// The joints of the working arm, from the shoulder.
    #[must_use]
    pub fn arm_joints(&self) -> Vec<Joint> {
        self.arm.chain_joints().cloned().collect()
    }

    /// What a world is made of in the setting `parameters` with the working arm at `posture_rad`; `watch` measures clearances.
    pub(super) fn world_settings<'a>(&'a self, parameters: &'a Parameters, posture_rad: &'a [f64], watch: bool) -> WorldSettings<'a> {
        let settings = &self.experiment.robot;
        WorldSettings {
            physics: &self.experiment.physics,
            robot: &self.robot,
            tool: &settings.tool_link,
            grasp: &settings.grasp_link,
            posture_rad,
            idle_tool: (!settings.idle_posture_rad.is_empty()).then_some(settings.idle_tool_link.as_str()),
            idle_posture_rad: &settings.idle_posture_rad,
            dry_friction_nm: settings.sensor.dry_friction_nm,
            finger_friction: settings.finger_friction,
            objects: &self.experiment.objects,
            parameters,
            watch,
        }
    }

    /// The world of [`Self::world_settings`].
    pub(super) fn world(&self, parameters: &Parameters, posture_rad: &[f64], watch: bool) -> Result<World, SimulationError> {
        Ok(World::new(&self.world_settings(parameters, posture_rad, watch))?)
    }

    /// Number of steps in `seconds`.
    pub(super) fn steps(&self, seconds: f64) -> u64 {
        (seconds / self.experiment.physics.step_s).round() as u64
    }
}
