//! Everything that decides an experiment, as plain data: scenario files are one way of writing it down.

use std::path::PathBuf;

use super::TraceSettings;
use crate::control::{Feedback, ImpedanceSettings};
use crate::learning::cpdmp::CouplingSettings;
use crate::learning::dmp::Integrator;
use crate::learning::{ExecutionSettings, LearningSettings, PhaseStopping};
use crate::world::{HumanSettings, Object, Parameters, PhysicsSettings, SensorSettings};

/// One experiment: who teaches what to which robot in which scene, and how the skill is executed.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// Its name, also that of its run folder.
    pub name: String,
    /// Decides every random number of the run.
    pub seed: u64,
    /// The setting in which the skill is executed.
    pub parameters: Parameters,
    /// The robot and its controller.
    pub robot: RobotSettings,
    /// The engine's step.
    pub physics: PhysicsSettings,
    /// The scene.
    pub objects: Vec<Object>,
    /// The person: their hand's strength and stiffness.
    pub human: HumanSettings,
    /// Where the demonstrations come from.
    pub demonstrations: DemonstrationSource,
    /// Which parameters the motion model is told (`theta_m`), by name.
    pub theta_m: Vec<String>,
    /// Which parameters the force model is told (`theta_f`), by name; empty for a fixed one.
    pub theta_f: Vec<String>,
    /// In which coordinates the motion is learned and executed.
    pub space: MotionSpace,
    /// How the skill is learned.
    pub learning: LearningSettings,
    /// How it is executed.
    pub execution: ExecutionPlan,
    /// Samples per second in the step log and the recording (Hz), from which criteria about moments are answered. Contacts, clearances and the
    /// person's peak force are taken at every engine step regardless.
    pub log_rate_hz: f64,
    /// What is kept of the states, so that a repetition can be held against the run.
    pub trace: TraceSettings,
    /// Links of the robot and objects that criteria and allowed contacts name; all of them must be there.
    pub named_parts: Vec<NamedPart>,
}

/// A name that stands for a link of the robot or an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedPart {
    /// The key that it is the value of, with its number in a list: `criterion.apart.links.0`.
    pub key: String,
    /// The name.
    pub name: String,
}

/// In which coordinates a motion is learned and executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum MotionSpace {
    /// Place of the tool in the base frame (m), with its orientation.
    #[default]
    Task,
    /// The arm's joints, from the shoulder (rad).
    Joint,
}

impl Experiment {
    /// The object that something is a part of, or is: `block` of `block.base`.
    pub(super) fn object_of(&self, part: &str) -> Option<&str> {
        let name = part.split('.').next();
        self.objects.iter().map(|object| object.name.as_str()).find(|object| name == Some(object))
    }

    /// The question that it puts to the skill.
    #[must_use]
    pub fn question(&self) -> ExecutionSettings {
        let theta = |names: &[String]| names.iter().filter_map(|name| Some((name.clone(), self.parameters.get(name)?))).collect();
        ExecutionSettings {
            theta_m: theta(&self.theta_m),
            theta_f: theta(&self.theta_f),
            duration_s: self.execution.duration_s,
            coupling: self.execution.coupling.clone(),
            integrator: self.execution.integrator,
            phase_stopping: self.execution.phase_stopping,
            ..Default::default()
        }
    }
}

/// Where the demonstrations come from.
#[derive(Clone, Debug)]
pub enum DemonstrationSource {
    /// The virtual human teaches them in this run.
    Teach(TeachingPlan),
    /// A recorded dataset.
    Dataset(PathBuf),
}

/// The robot, its posture and its joint controller.
#[derive(Clone, Debug)]
pub struct RobotSettings {
    /// A URDF file, or `None` for the built-in Baxter.
    pub urdf: Option<PathBuf>,
    /// Where `package://NAME/` is looked up besides the folders above the URDF file.
    pub package_directories: Vec<PathBuf>,
    /// Link that is the tool, at the grasp centre; the arm that carries it works.
    pub tool_link: String,
    /// Link that a person takes hold of.
    pub grasp_link: String,
    /// Link that is the other arm's tool; that arm holds `idle_posture_rad`.
    pub idle_tool_link: String,
    /// The posture that inverse kinematics prefers, joint by joint from the shoulder (rad).
    pub rest_posture_rad: Vec<f64>,
    /// The posture that the other arm holds (rad).
    pub idle_posture_rad: Vec<f64>,
    /// Coefficient of friction of the fingers' pads; what two surfaces have in common is the mean of theirs.
    pub finger_friction: f64,
    /// The joint impedance of both arms.
    pub impedance: ImpedanceSettings,
    /// What is wrong with joints and wrench estimate.
    pub sensor: SensorSettings,
}

/// How the virtual human teaches.
#[derive(Clone, Debug)]
pub struct TeachingPlan {
    /// Values of task parameters; every combination is one demonstration, the last parameter varying fastest.
    pub grid: Vec<(String, Vec<f64>)>,
    /// How often each combination is shown, at least once.
    pub repetitions: usize,
    /// Turn of the tool about the vertical (rad): at pi/2 the fingers of one that points down open along x.
    pub tool_yaw_rad: f64,
    /// By how much the tool is lifted from pointing down towards the front (rad): at pi/2 it points forward.
    pub tool_pitch_rad: f64,
    /// Turn of the tool about its own z axis (rad).
    pub tool_roll_rad: f64,
    /// How far the tool turns with the door of way-points that have an opening (0: not at all … 1: as the door).
    pub turns_with_door: f64,
    /// Damping of the joints while the arm is in zero gravity (N m s/rad).
    pub zero_gravity_damping_nms_per_rad: f64,
    /// How long a demonstration lasts (s).
    pub duration_s: f64,
    /// Samples per second of the dataset (Hz).
    pub record_rate_hz: f64,
    /// One standard deviation of a way-point's place from demonstration to demonstration, per axis (m).
    pub position_spread_m: f64,
    /// One standard deviation of a way-point's time, as a fraction of the duration.
    pub timing_spread: f64,
    /// Where the person leads the gripper, in the order of time.
    pub waypoints: Vec<Waypoint>,
}

/// A place through which the person leads the grasp centre of the gripper.
#[derive(Clone, Debug, PartialEq)]
pub struct Waypoint {
    /// When it is reached, from the start of the demonstration (s).
    pub time_s: f64,
    /// The object whose anchor the offset is relative to (see [`Object::anchor`]); the world's origin without one.
    pub at: Option<String>,
    /// Offset from the anchor, world axes; of a door, while it is closed (m).
    pub offset_m: [f64; 3],
    /// How far the door is open (rad); the place is carried along with it. None for way-points that are not at a door.
    pub opening_rad: Option<f64>,
    /// The opening that is commanded to the gripper from here on (0 closed, 1 open); unchanged without one.
    pub gripper: Option<f64>,
}

/// How the learned skill is executed.
#[derive(Clone, Debug)]
pub struct ExecutionPlan {
    /// The coupling (17)–(19) between force error and motion.
    pub coupling: CouplingSettings,
    /// How the movement is integrated.
    pub integrator: Integrator,
    /// Whether the skill hears of where the arm really is.
    pub feedback: Feedback,
    /// Whether the phase waits while the movement is off its path; the run then goes on until the skill's end.
    pub phase_stopping: Option<PhaseStopping>,
    /// Start, goal: taken from the demonstrations by regression. Duration (s): that of the demonstrations unless given.
    pub duration_s: Option<f64>,
    /// How long the run goes on after the skill's end before the world is judged (s).
    pub settle_s: f64,
    /// What the person does meanwhile.
    pub help: Help,
}

/// What the person does while the skill is executed.
#[derive(Clone, Debug, PartialEq)]
pub enum Help {
    /// Nothing.
    None,
    /// Brings the gripper over an object that they see, horizontally, from when the gripper comes near until it closes.
    Guide {
        /// The object's name.
        object: String,
        /// Horizontal distance from gripper to object at which the person takes hold (m).
        reach_m: f64,
        /// The largest force (N).
        force_max_n: f64,
        /// How much of the error along x and along y the person corrects (0 … 1): somebody who knows that the arm is on its way to the toy
        /// pushes sideways only.
        weight_xy: [f64; 2],
    },
    /// Pushes with a given force in given windows of time, rising and falling smoothly.
    Push {
        /// The force in world axes (N).
        force_n: [f64; 3],
        /// Start and end of each push, from the start of the skill (s).
        windows_s: Vec<[f64; 2]>,
    },
}
