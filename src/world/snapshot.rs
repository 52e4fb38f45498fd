//! A world between two steps as something that can be kept, and taken up again in the same bits.
//!
//! The engine says of itself what it needs to go on; beside it stand what drives, hook and fingers remember from step to step. What is only
//! told about a run, such as contacts and distances so far, is not part of it.

use nalgebra::Vector3;
use rapier3d_f64::prelude::PhysicsWorld;
use serde::{Deserialize, Serialize};

use super::World;
use super::articulation::Articulation;
use super::hook::{Hook, HookSnapshot};

/// A world as it is kept. Serialized, it is what a [`WorldSnapshot`] is read from.
#[derive(Serialize)]
pub struct WorldState<'a> {
    engine: &'a PhysicsWorld,
    memory: Memory,
}

/// A world as it was kept.
#[derive(Deserialize)]
pub struct WorldSnapshot {
    engine: PhysicsWorld,
    memory: Memory,
}

/// What a world remembers beside the engine.
#[derive(Serialize, Deserialize)]
struct Memory {
    step: u64,
    working: Vec<DriveMemory>,
    idle: Option<Vec<DriveMemory>>,
    hook: Option<HookSnapshot>,
    tool_force: Vector3<f64>,
}

/// Effort and excess of a drive in the last step (N m or N).
type DriveMemory = (f64, f64);

impl World {
    /// The world as it is, between two steps.
    pub fn state(&self) -> WorldState<'_> {
        let memory = Memory {
            step: self.step,
            working: remembered(&self.robot.working),
            idle: self.robot.idle.as_ref().map(remembered),
            hook: self.hook.as_ref().map(Hook::snapshot),
            tool_force: self.contacts.tool_force,
        };
        WorldState { engine: &self.engine, memory }
    }

    /// Goes on from where a world of the same settings was. Returns whether the snapshot fits this one; contacts, distances and the hash of all
    /// states begin anew.
    pub fn restore(&mut self, from: WorldSnapshot) -> bool {
        let WorldSnapshot { engine, memory } = from;
        let sizes = |engine: &PhysicsWorld| (engine.bodies.len(), engine.colliders.len(), engine.multibody_joints.iter().count());
        let alike = (sizes(&engine), memory.working.len(), memory.idle.as_ref().map(Vec::len), memory.hook.is_some())
            == (
                sizes(&self.engine),
                self.robot.working.drives.len(),
                self.robot.idle.as_ref().map(|idle| idle.drives.len()),
                self.hook.is_some(),
            );
        if !alike {
            return false;
        }
        self.engine = engine;
        self.step = memory.step;
        remember(&mut self.robot.working, &memory.working);
        if let (Some(idle), Some(there)) = (&mut self.robot.idle, &memory.idle) {
            remember(idle, there);
        }
        if let (Some(hook), Some(there)) = (&mut self.hook, memory.hook) {
            hook.restore(there);
        }
        self.contacts.tool_force = memory.tool_force;
        if let Some(watch) = &mut self.watch {
            watch.look_again(&self.engine);
        }
        self.read_joints();
        true
    }
}

fn remembered(arm: &Articulation) -> Vec<DriveMemory> {
    arm.drives.iter().map(|drive| (drive.effort, drive.excess)).collect()
}

fn remember(arm: &mut Articulation, memory: &[DriveMemory]) {
    for (drive, &(effort, excess)) in arm.drives.iter_mut().zip(memory) {
        (drive.effort, drive.excess) = (effort, excess);
    }
}
