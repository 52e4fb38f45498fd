//! Teaching: a person leads the weightless arm; what its encoders saw is the demonstration.

use nalgebra::DMatrix;

use super::astray::astray;
use super::guide_path::GuidePath;
use super::person::Teacher;
use super::reachable::MOVE;
use super::setup::Setup;
use super::space::joint_columns;
use super::step_loop::{Phase, Published, StepLoop};
use super::{LOOKS_HZ, LessonLook, Progress, SimulationError, TeachingPlan};
use crate::control::{ArmModel, ToolPath, ZeroGravity};
use crate::demonstration::{Demonstration, Trajectory};
use crate::math;
use crate::world::{Parameters, StateTrace};

/// One demonstration as it was led, before its wrench is known.
#[derive(Clone, Debug)]
pub(super) struct Lesson {
    /// Its number in the grid.
    pub number: u64,
    /// Name, from the task parameters.
    pub name: String,
    /// The setting in which it was led.
    pub parameters: Parameters,
    /// Joint angles at the start (rad).
    pub start_posture: Vec<f64>,
    /// What the encoders saw, as poses of the tool.
    pub path: ToolPath,
    /// The same as joint angles (rad).
    pub joints: Vec<Vec<f64>>,
    /// What somebody who stood beside it saw.
    pub looks: Vec<LessonLook>,
    /// Hash of the world's states.
    pub state_hash: u64,
    /// What was kept of them.
    pub trace: StateTrace,
    /// Which way-point it missed, in words, if it did.
    pub astray: Option<String>,
    /// Engine steps.
    pub steps: u64,
}

/// Every combination of the grid's values, the last parameter varying fastest, each as often as it is repeated.
pub(super) fn settings_of(plan: &TeachingPlan, base: &Parameters) -> Vec<Parameters> {
    let settings = plan.grid.iter().fold(vec![base.clone()], |settings, (name, values)| {
        settings.iter().flat_map(|s| values.iter().map(|v| s.with(&[(name.clone(), *v)]))).collect()
    });
    settings.into_iter().flat_map(|setting| std::iter::repeat_n(setting, plan.repetitions)).collect()
}

/// Teaches demonstration `number` in the setting `parameters`.
pub(super) fn teach(
    setup: &Setup,
    plan: &TeachingPlan,
    parameters: &Parameters,
    number: u64,
    progress: &dyn Progress,
) -> Result<Lesson, SimulationError> {
    let experiment = &setup.experiment;
    let mut variation = math::stream(experiment.seed, "human", number);
    let path = GuidePath::new(plan, &experiment.objects, parameters, &mut variation);
    let start_posture = setup.posture(&path.at(0.0).pose, "the first way-point", MOVE)?;
    let mut world = setup.world(parameters, &start_posture, false)?;
    let mut teacher = Teacher::new(&experiment.human, path.clone(), &world);
    let mut controller = ZeroGravity::new(setup.arm(), plan.zero_gravity_damping_nms_per_rad);
    let steps = setup.steps(plan.duration_s);
    let every = setup.steps(1.0 / plan.record_rate_hz).max(1);
    let path_so_far = ToolPath { times_s: Vec::new(), poses: Vec::new(), gripper: Vec::new() };
    let mut recorder = PathRecorder { arm: setup.arm(), path: path_so_far, joints: Vec::new() };
    let (mut looks, look_every) = (Vec::new(), setup.steps(1.0 / LOOKS_HZ).max(1));
    let mut hold = setup.hold();
    let mut run = StepLoop {
        world: &mut world,
        controller: &mut controller,
        person: &mut teacher,
        sensors: &mut setup.sensors(2 * number),
        idle: hold.as_mut(),
        step_s: experiment.physics.step_s,
        phase: Phase { name: "teach", progress },
    };
    run.world.trace(experiment.trace.every_steps, experiment.trace.detail_of("teach", number), steps + 1);
    run.run(
        steps + 1,
        |controller, world| controller.gripper = path.at(world.time_s()).gripper,
        |now| {
            if now.world.step().is_multiple_of(every) {
                recorder.record(now.observation.time_s, &now.observation.position, now.command.gripper);
            }
            if now.world.step().is_multiple_of(look_every) {
                looks.push(look(now, experiment.objects.len()));
            }
        },
    )?;
    let name = demonstration_name(plan, parameters, number);
    Ok(Lesson {
        number,
        name,
        astray: astray(&path, &recorder.path),
        parameters: parameters.clone(),
        start_posture,
        path: recorder.path,
        joints: recorder.joints,
        looks,
        state_hash: world.state_hash(),
        trace: world.take_trace(),
        steps: steps + 1,
    })
}

fn look(now: &Published<ZeroGravity>, objects: usize) -> LessonLook {
    let mut bodies = Vec::new();
    now.world.robot_poses(&mut bodies);
    LessonLook {
        time_s: now.world.time_s(),
        tool: now.world.tool_pose().translation.vector,
        gripper_command: now.command.gripper,
        human: now.hand,
        bodies,
        objects: (0..objects).map(|index| now.world.object_pose(index)).collect(),
    }
}

/// Joins what was led with the wrench (6 numbers per sample) measured when it was replayed.
pub(super) fn demonstration(setup: &Setup, lesson: &Lesson, wrench: &[[f64; 6]]) -> Result<Demonstration, SimulationError> {
    let path = &lesson.path;
    let samples = path.times_s.len().min(wrench.len());
    let columns: Vec<String> = COLUMNS.map(str::to_owned).into_iter().chain(joint_columns(setup.joints())).collect();
    let values = DMatrix::from_fn(samples, columns.len(), |i, j| {
        let (p, q) = (&path.poses[i].translation.vector, &path.poses[i].rotation.coords);
        match j {
            0..=2 => p[j],
            3..=6 => q[j - 3],
            7..=12 => wrench[i][j - 7],
            13 => path.gripper[i],
            _ => lesson.joints[i][j - COLUMNS.len()],
        }
    });
    let trajectory = Trajectory::new(path.times_s[..samples].to_vec(), columns, values)?;
    let theta = |names: &[String]| names.iter().filter_map(|name| Some((name.clone(), lesson.parameters.get(name)?))).collect();
    let experiment = &setup.experiment;
    Ok(Demonstration { name: lesson.name.clone(), trajectory, theta_m: theta(&experiment.theta_m), theta_f: theta(&experiment.theta_f) })
}

/// Columns of a taught demonstration besides time; the joints follow.
const COLUMNS: [&str; 14] = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw", "fx_n", "fy_n", "fz_n", "tx_nm", "ty_nm", "tz_nm", "gripper"];

/// `block_height_0.17_toy_lateral_-0.06`, with the number of the repetition if there are several.
fn demonstration_name(plan: &TeachingPlan, parameters: &Parameters, number: u64) -> String {
    let part = |name: &String| format!("{}_{}", name.trim_end_matches("_m"), parameters.get(name).unwrap_or(f64::NAN));
    let mut parts: Vec<String> = plan.grid.iter().map(|(name, _)| part(name)).collect();
    if plan.repetitions > 1 {
        parts.push((number % plan.repetitions as u64 + 1).to_string());
    }
    parts.join("_")
}

struct PathRecorder {
    arm: ArmModel,
    path: ToolPath,
    joints: Vec<Vec<f64>>,
}

impl PathRecorder {
    fn record(&mut self, time_s: f64, q: &[f64], gripper: f64) {
        self.path.times_s.push(time_s);
        self.path.poses.push(self.arm.tool_pose(q));
        self.path.gripper.push(gripper);
        self.joints.push(q.to_vec());
    }
}
