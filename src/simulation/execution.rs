//! Execution: the learned skill runs in a setting that was never shown, and the person may help.

use nalgebra::Vector3;

use super::person::helper;
use super::preflight::starts_apart;
use super::setup::Setup;
use super::step_loop::{Phase, Published, StepLoop};
use super::{FinalObject, Progress, SimulationError, StepRecord};
use crate::control::{Controller, SkillController};
use crate::learning::{Skill, SkillExecution};
use crate::world::{Clearance, ContactEpisode, StateTrace, World};

/// What an execution left behind.
pub(super) struct Executed {
    /// Why it ended before its time, if it did.
    pub cut_short: Option<SimulationError>,
    pub records: Vec<StepRecord>,
    pub human_peak_force_n: f64,
    pub tool_peak_force_n: f64,
    pub goal: Vector3<f64>,
    pub collisions: Vec<ContactEpisode>,
    pub clearances: Vec<Clearance>,
    pub final_objects: Vec<FinalObject>,
    pub state_hash: u64,
    pub trace: StateTrace,
    pub steps: u64,
}

/// Number of the execution among the runs that draw sensor noise: no lesson or replay has it.
const EXECUTION_RUN: u64 = u64::MAX;

/// Executes `skill` in the experiment's setting.
pub(super) fn execute(setup: &Setup, skill: &Skill, progress: &dyn Progress) -> Result<Executed, SimulationError> {
    let experiment = &setup.experiment;
    let query = experiment.question();
    let execution = SkillExecution::new(skill, &query)?;
    let duration = execution.duration_s();
    let goal = setup.tool_at(execution.goal().as_slice()).translation.vector;
    let (posture, follower) = setup.follower(&execution)?;

    let mut world = starts_apart(setup.world(&experiment.parameters, &posture, true), "the skill's start")?;
    let step_s = experiment.physics.step_s;
    let feedback = (experiment.execution.feedback, setup.arm());
    let mut controller = SkillController::new(skill, execution, follower, setup.observer(), feedback, step_s)?;
    let names: Vec<String> = experiment.objects.iter().map(|object| object.name.clone()).collect();
    let mut person = helper(&experiment.execution.help, &experiment.human, &names, experiment.seed);
    let settle = setup.steps(experiment.execution.settle_s);
    // A phase that waits ends later, but never later than this.
    let slowest = experiment.execution.phase_stopping.map_or(1.0, |stopping| stopping.slowest);
    let steps = setup.steps(duration / slowest + experiment.execution.settle_s) + 1;
    let mut settled = 0;
    let every = setup.steps(1.0 / experiment.log_rate_hz).max(1);
    let mut records = Vec::with_capacity((setup.steps(duration) / every) as usize + 1);
    let (mut human_peak_force_n, mut tool_peak_force_n): (f64, f64) = (0.0, 0.0);
    let mut tool_impulse = Vector3::zeros();
    let mut hold = setup.hold();
    let mut run = StepLoop {
        world: &mut world,
        controller: &mut controller,
        person: person.as_mut(),
        sensors: &mut setup.sensors(EXECUTION_RUN),
        idle: hold.as_mut(),
        step_s,
        phase: Phase { name: "execute", progress },
    };
    run.world.trace(experiment.trace.every_steps, experiment.trace.detail_of("execute", 0), steps);
    let made = run.run_while(
        steps,
        |_, _| {},
        |now| {
            human_peak_force_n = now.hand.force.norm().max(human_peak_force_n);
            tool_peak_force_n = now.world.tool_force().norm().max(tool_peak_force_n);
            tool_impulse += now.world.tool_force() * step_s;
            if now.world.step().is_multiple_of(every) {
                let record = record(now, names.len(), tool_impulse);
                progress.stepped(&record);
                records.push(record);
            }
            settled += u64::from(now.controller.telemetry().time_fraction >= 1.0);
            slowest == 1.0 || settled <= settle
        },
    );
    Ok(Executed {
        steps: world.step(),
        cut_short: made.err(),
        records,
        human_peak_force_n,
        tool_peak_force_n,
        goal,
        collisions: world.contacts().to_vec(),
        clearances: world.clearances().to_vec(),
        final_objects: final_objects(&world, &names),
        state_hash: world.state_hash(),
        trace: world.take_trace(),
    })
}

fn final_objects(world: &World, names: &[String]) -> Vec<FinalObject> {
    let object = |(index, name): (usize, &String)| FinalObject {
        name: name.clone(),
        position: world.object_pose(index).translation.vector.into(),
        speed_m_per_s: world.object_speed(index),
    };
    names.iter().enumerate().map(object).collect()
}

fn record(now: &Published<SkillController>, objects: usize, tool_impulse: Vector3<f64>) -> StepRecord {
    let telemetry = now.controller.telemetry();
    let mut bodies = Vec::new();
    now.world.robot_poses(&mut bodies);
    StepRecord {
        step: now.world.step(),
        time_s: now.world.time_s(),
        joint_position: now.observation.position.clone(),
        joint_velocity: now.observation.velocity.clone(),
        joint_effort: now.observation.effort.clone(),
        tool: now.world.tool_pose(),
        reference: telemetry.reference,
        wrench: telemetry.wrench,
        expected_force: telemetry.expected_force,
        coupling_displacement: telemetry.coupling_displacement,
        deviation: telemetry.deviation,
        phase: telemetry.phase,
        time_fraction: telemetry.time_fraction,
        state: telemetry.state,
        beta: telemetry.beta,
        activation: telemetry.activation,
        gripper_command: now.command.gripper,
        gripper_opening: now.observation.gripper_opening,
        human: now.hand,
        tool_force: now.world.tool_force(),
        tool_impulse,
        bodies,
        objects: (0..objects).map(|index| now.world.object_pose(index)).collect(),
        kinetic_energy_j: now.world.kinetic_energy_j(),
    }
}
