//! Execution: the learned skill runs in a setting that was never shown, and the person may help.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::person::{Person, helper};
use super::setup::Setup;
use super::snapshot::{Kept, Rest, TakenUp};
use super::step_loop::{Phase, Published, StepLoop};
use super::{FinalObject, Progress, SimulationError, Snapshot, Snapshots, StepRecord};
use crate::control::{Controller, SkillController};
use crate::learning::{Skill, SkillExecution};
use crate::world::{Clearance, ContactEpisode, EffortSensors, StateTrace, World};

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
    pub snapshots: Snapshots,
    pub steps: u64,
}

/// Number of the execution among the runs that draw sensor noise: no lesson or replay has it.
const EXECUTION_RUN: u64 = u64::MAX;

/// What adds up from step to step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Sums {
    /// Steps since the movement was over.
    settled: u64,
    human_peak_force_n: f64,
    tool_peak_force_n: f64,
    tool_impulse: Vector3<f64>,
}

/// Executes `skill` in the experiment's setting: from its beginning, or on from a snapshot.
pub(super) fn execute(setup: &Setup, skill: &Skill, from: Option<&Snapshot>, progress: &dyn Progress) -> Result<Executed, SimulationError> {
    let experiment = &setup.experiment;
    let query = experiment.question();
    let execution = SkillExecution::new(skill, &query)?;
    let duration = execution.duration_s();
    let goal = setup.tool_at(execution.goal().as_slice()).translation.vector;
    let (posture, follower) = setup.follower(&execution)?;

    let mut world = setup.starts_apart(setup.world(&experiment.parameters, &posture, true), "the skill's start")?;
    let step_s = experiment.physics.step_s;
    let feedback = (experiment.execution.feedback, setup.arm());
    let mut controller = SkillController::new(skill, execution, follower, setup.observer(), feedback, step_s)?;
    let names: Vec<String> = experiment.objects.iter().map(|object| object.name.clone()).collect();
    let mut person = helper(&experiment.execution.help, &experiment.human, &names, experiment.seed);
    let mut sensors = setup.sensors(EXECUTION_RUN);
    let mut sums = Sums { settled: 0, human_peak_force_n: 0.0, tool_peak_force_n: 0.0, tool_impulse: Vector3::zeros() };
    if let Some(snapshot) = from {
        sums = take_up(snapshot, &mut world, &mut controller, person.as_mut(), &mut sensors)?;
    }
    let settle = setup.steps(experiment.execution.settle_s);
    // A phase that waits ends later, but never later than this.
    let slowest = experiment.execution.phase_stopping.map_or(1.0, |stopping| stopping.slowest);
    let steps = setup.steps(duration / slowest + experiment.execution.settle_s) + 1;
    let every = setup.steps(1.0 / experiment.log_rate_hz).max(1);
    let mut records = Vec::with_capacity((setup.steps(duration) / every) as usize + 1);
    let mut snapshots = Snapshots::new();
    let mut hold = setup.hold();
    let mut run = StepLoop {
        world: &mut world,
        controller: &mut controller,
        person: person.as_mut(),
        sensors: &mut sensors,
        idle: hold.as_mut(),
        step_s,
        phase: Phase { name: "execute", progress },
    };
    run.world.keep_touches(every);
    run.world.trace(experiment.trace.every_steps, experiment.trace.detail_of("execute", 0), steps);
    let left = steps.saturating_sub(run.world.step());
    // Each stretch between two snapshots is a run of the loop.
    let stretch = experiment.trace.snapshot_every_steps;
    let made = loop_with_snapshots(&mut run, left, stretch, &mut snapshots, &mut sums, |now, sums| {
        sums.human_peak_force_n = now.hand.force.norm().max(sums.human_peak_force_n);
        sums.tool_peak_force_n = now.world.tool_force().norm().max(sums.tool_peak_force_n);
        sums.tool_impulse += now.world.tool_force() * step_s;
        if now.world.step().is_multiple_of(every) {
            let record = record(now, names.len(), sums.tool_impulse);
            progress.stepped(&record);
            records.push(record);
        }
        sums.settled += u64::from(now.controller.telemetry().time_fraction >= 1.0);
        slowest == 1.0 || sums.settled <= settle
    });
    Ok(Executed {
        steps: world.step(),
        cut_short: made.err(),
        records,
        human_peak_force_n: sums.human_peak_force_n,
        tool_peak_force_n: sums.tool_peak_force_n,
        goal,
        collisions: world.contacts().to_vec(),
        clearances: world.clearances().to_vec(),
        final_objects: final_objects(&world, &names),
        state_hash: world.state_hash(),
        trace: world.take_trace(),
        snapshots,
    })
}

/// Makes `left` steps, and a snapshot whenever the world's step is a multiple of `every` (never for 0).
fn loop_with_snapshots(
    run: &mut StepLoop<SkillController>,
    mut left: u64,
    every: u64,
    snapshots: &mut Snapshots,
    sums: &mut Sums,
    mut publish: impl FnMut(&Published<SkillController>, &mut Sums) -> bool,
) -> Result<(), SimulationError> {
    while left > 0 {
        let now = run.world.step();
        let stretch = if every == 0 { left } else { left.min(every - now % every) };
        if !run.run_while(stretch, |_, _| {}, |now| publish(now, sums))? {
            return Ok(());
        }
        left -= stretch;
        if left > 0 {
            let rest = Rest {
                controller: run.controller.snapshot(),
                person: run.person.snapshot(),
                noise_words: run.sensors.words_used(),
                sums: sums.clone(),
            };
            snapshots.all.push(Snapshot::of(run.world.step(), &Kept { world: run.world.state(), rest })?);
        }
    }
    Ok(())
}

/// Puts everything where the snapshot has it.
fn take_up(
    snapshot: &Snapshot,
    world: &mut World,
    controller: &mut SkillController,
    person: &mut dyn Person,
    sensors: &mut EffortSensors,
) -> Result<Sums, SimulationError> {
    let TakenUp { world: there, rest } = snapshot.open()?;
    if !world.restore(there) || !controller.restore(rest.controller) {
        return Err(SimulationError::Snapshot("it is of another robot, scene or skill".to_owned()));
    }
    person.restore(&rest.person);
    sensors.go_on_from(rest.noise_words);
    Ok(rest.sums)
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
        touches: now.world.recent_touches().to_vec(),
        kinetic_energy_j: now.world.kinetic_energy_j(),
    }
}
