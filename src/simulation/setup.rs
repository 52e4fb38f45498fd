//! What every run of an experiment starts from: robot, arm models, worlds.

use std::path::Path;

use nalgebra::Isometry3;

use super::{Experiment, NamedPart, RobotSettings, SimulationError};
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

/// Every list of joint values has one number per joint.
fn check_lengths(settings: &RobotSettings, joints: usize, idle_joints: Option<usize>) -> Result<(), SimulationError> {
    let impedance = &settings.impedance;
    let lists = [
        ("robot.rest_posture_rad", settings.rest_posture_rad.len(), &settings.tool_link, Some(joints)),
        ("robot.impedance.stiffness_nm_per_rad", impedance.stiffness_nm_per_rad.len(), &settings.tool_link, Some(joints)),
        ("robot.impedance.damping_nms_per_rad", impedance.damping_nms_per_rad.len(), &settings.tool_link, Some(joints)),
        ("robot.idle_posture_rad", settings.idle_posture_rad.len(), &settings.idle_tool_link, idle_joints),
        ("robot.impedance.stiffness_nm_per_rad", impedance.stiffness_nm_per_rad.len(), &settings.idle_tool_link, idle_joints),
    ];
    let wrong = lists.into_iter().filter_map(|(key, found, link, joints)| {
        let joints = joints.filter(|joints| *joints != found)?;
        let told = format!("{key} has {found} numbers, but the arm that ends in `{link}` has {joints} joints: give one number per joint");
        Some(SimulationError::Scene(told).at(key))
    });
    SimulationError::all(wrong.collect())
}

/// Every part that criteria and allowed contacts name is a link of the robot, an object, or one of an object's parts, and no two are called the
/// same.
fn check_parts(experiment: &Experiment, robot: &RobotModel) -> Result<(), SimulationError> {
    let links = || robot.frames.iter().map(|frame| frame.name.as_str());
    let is_object = |name: &str| experiment.objects.iter().any(|object| name.split('.').next() == Some(object.name.as_str()));
    let unknown = experiment.named_parts.iter().filter(|part| !is_object(&part.name) && !links().any(|link| link == part.name));
    let told = unknown.map(|NamedPart { key, name }| {
        let near = robot::nearest_name(name, links().chain(experiment.objects.iter().map(|object| object.name.as_str())));
        let help = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        SimulationError::Scene(format!("the robot has no link `{name}`, and the scene no object of that name{help}")).at(key)
    });
    let twins = experiment.objects.iter().filter(|object| links().any(|link| link == object.name)).map(|object| {
        let told = format!(
            "object `{0}`: a link of the robot is called `{0}` too, and what is said of one would hold for both: name it otherwise",
            object.name
        );
        SimulationError::Scene(told).at(format!("object.{}", object.name))
    });
    SimulationError::all(told.chain(twins).collect())
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
        match self.key {
            Some(key) => error.at(key),
            None => error,
        }
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
        let settings = &experiment.robot;
        let loaded = match &settings.urdf {
            None => built_in(settings),
            Some(path) => load(path, settings)?,
        };
        let arm = ArmModel::new(&loaded.model, &settings.tool_link, &settings.rest_posture_rad, experiment.physics.gravity_m_per_s2)?;
        let idle = match settings.idle_posture_rad.is_empty() {
            true => None,
            false => Some(ArmModel::new(
                &loaded.model,
                &settings.idle_tool_link,
                &settings.idle_posture_rad,
                experiment.physics.gravity_m_per_s2,
            )?),
        };
        let lengths = check_lengths(settings, arm.joints(), idle.as_ref().map(ArmModel::joints));
        SimulationError::all([lengths, check_parts(experiment, &loaded.model)].into_iter().filter_map(Result::err).collect())?;
        Ok(Self { experiment: experiment.clone(), robot: loaded.model, warnings: loaded.warnings, arm, idle })
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
