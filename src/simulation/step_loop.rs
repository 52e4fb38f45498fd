//! The step loop: sense, decide, act, advance, publish. Teaching, replay and execution are runs of this one loop.

use super::person::{Person, applied};
use super::{AppliedForce, Progress, SimulationError};
use crate::control::{Command, Controller, HoldPosture, Observation};
use crate::robot::JointCommand;
use crate::world::{EffortSensors, HandWrench, World};

/// Everything that takes part in a run.
pub(super) struct StepLoop<'a, C: Controller> {
    pub world: &'a mut World,
    pub controller: &'a mut C,
    pub person: &'a mut dyn Person,
    pub sensors: &'a mut EffortSensors,
    pub idle: Option<&'a mut HoldPosture>,
    /// Step of control and engine (s).
    pub step_s: f64,
    pub phase: Phase<'a>,
}

/// Which phase of a run the loop is in, and who says whether it may go on.
#[derive(Clone, Copy)]
pub(super) struct Phase<'a> {
    pub name: &'static str,
    pub progress: &'a dyn Progress,
}

impl Phase<'_> {
    fn goes_on(self, world: &World) -> Result<(), SimulationError> {
        if self.progress.may_go_on() { Ok(()) } else { Err(SimulationError::Stopped { phase: self.name, time_s: world.time_s() }) }
    }
}

/// What a sink sees after each step.
pub(super) struct Published<'a, C: Controller> {
    pub world: &'a World,
    pub controller: &'a C,
    pub observation: &'a Observation,
    pub command: &'a Command,
    pub hand: AppliedForce,
}

impl<C: Controller> StepLoop<'_, C> {
    /// Runs `steps` steps. `before` may change the controller at the start of a step; `publish` sees what every step was decided on, starting
    /// with the initial state, before the world advances.
    pub(super) fn run(
        &mut self,
        steps: u64,
        before: impl FnMut(&mut C, &World),
        mut publish: impl FnMut(&Published<C>),
    ) -> Result<(), SimulationError> {
        let always = |now: &Published<C>| {
            publish(now);
            true
        };
        self.run_while(steps, before, always).map(|_| ())
    }

    /// The same for at most `steps` steps: the one after which `publish` says no is the last. Returns whether it never did.
    pub(super) fn run_while(
        &mut self,
        steps: u64,
        mut before: impl FnMut(&mut C, &World),
        mut publish: impl FnMut(&Published<C>) -> bool,
    ) -> Result<bool, SimulationError> {
        let joints = self.world.arm_joints();
        let mut observation = Observation::zero(joints);
        let mut command = Command::idle(joints);
        let mut idle = IdleArm::new(self.world.idle_joints());
        for _ in 0..steps {
            self.phase.goes_on(self.world)?;
            sense(self.world, self.sensors, &mut observation);
            before(self.controller, self.world);
            self.controller.decide(&observation, &mut command);
            if let Some(hold) = self.idle.as_deref_mut() {
                idle.decide(self.world, hold);
            }
            let hand = self.person.act(self.world, self.step_s);
            let goes_on = publish(&Published {
                world: self.world,
                controller: self.controller,
                observation: &observation,
                command: &command,
                hand: applied(&hand),
            });
            act(self.world, &command, &idle.command, hand);
            self.world.advance()?;
            if !goes_on {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

fn sense(world: &World, sensors: &mut EffortSensors, observation: &mut Observation) {
    observation.time_s = world.time_s();
    world.read_arm(&mut observation.position, &mut observation.velocity);
    world.read_efforts(&mut observation.effort);
    sensors.measure(&mut observation.effort);
    observation.gripper_opening = world.gripper_opening();
}

fn act(world: &mut World, command: &Command, idle: &JointCommand, hand: HandWrench) {
    world.command_arm(&command.joints);
    world.command_idle_arm(idle);
    world.command_gripper(command.gripper);
    world.push(hand);
}

/// Buffers of the arm that does not work.
struct IdleArm {
    q: Vec<f64>,
    v: Vec<f64>,
    command: JointCommand,
}

impl IdleArm {
    fn new(joints: usize) -> Self {
        Self { q: vec![0.0; joints], v: vec![0.0; joints], command: JointCommand::zero(joints) }
    }

    fn decide(&mut self, world: &World, hold: &mut HoldPosture) {
        world.read_idle_arm(&mut self.q, &mut self.v);
        hold.decide(&self.q, &mut self.command);
    }
}
