//! Replay: the arm repeats a demonstration alone; the wrench it then measures becomes the demonstration's force profile.

use super::person::Nobody;
use super::setup::Setup;
use super::step_loop::{Phase, StepLoop};
use super::teaching::Lesson;
use super::{Progress, SimulationError};
use crate::control::{Controller, TrajectoryController};
use crate::world::StateTrace;

/// What a replay measured.
pub(super) struct Replay {
    /// Force (N) and torque (N m) at the lesson's sample times, base axes, by the environment on the tool.
    pub wrench: Vec<[f64; 6]>,
    /// Hash of the world's states.
    pub state_hash: u64,
    /// What was kept of them.
    pub trace: StateTrace,
    /// Engine steps.
    pub steps: u64,
}

/// Replays `lesson` in the setting in which it was led.
pub(super) fn replay(setup: &Setup, lesson: &Lesson, progress: &dyn Progress) -> Result<Replay, SimulationError> {
    let step_s = setup.experiment.physics.step_s;
    let mut world = setup.world(&lesson.parameters, &lesson.start_posture, false)?;
    let mut controller = TrajectoryController::new(lesson.path.clone(), setup.tracker(), setup.observer());
    let duration = lesson.path.times_s.last().copied().unwrap_or(0.0);
    let every = setup.steps(duration / (lesson.path.times_s.len().max(2) - 1) as f64).max(1);
    let steps = setup.steps(duration) + 1;
    let mut wrench = Vec::with_capacity(lesson.path.times_s.len());
    let mut hold = setup.hold();
    let mut run = StepLoop {
        world: &mut world,
        controller: &mut controller,
        person: &mut Nobody,
        sensors: &mut setup.sensors(2 * lesson.number + 1),
        idle: hold.as_mut(),
        step_s,
        phase: Phase { name: "replay", progress },
    };
    let kept = &setup.experiment.trace;
    run.world.trace(kept.every_steps, kept.detail_of("replay", lesson.number), steps);
    run.run(
        steps,
        |_, _| {},
        |now| {
            if now.world.step().is_multiple_of(every) {
                wrench.push(now.controller.telemetry().wrench.into());
            }
        },
    )?;
    Ok(Replay { wrench, state_hash: world.state_hash(), trace: world.take_trace(), steps })
}
