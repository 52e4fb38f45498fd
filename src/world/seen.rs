//! What can be seen of a world: for the loop that steps it, for the person in it, and for records.

use std::hash::Hasher;

use nalgebra::{DMatrix, Isometry3, Vector3};
use rapier3d_f64::prelude::RigidBodyHandle;

use super::hook::Hook;
use super::simulated_world::World;
use super::{Clearance, ContactEpisode, GraspState, TouchPoint, convert};

/// What can be seen of a world.
impl World {
    /// Simulated time (s).
    pub fn time_s(&self) -> f64 {
        self.step as f64 * self.engine.integration_parameters.dt
    }

    /// Number of steps taken.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Number of joints of the working arm.
    pub fn arm_joints(&self) -> usize {
        self.limbs.arm.len()
    }

    /// Number of joints of the other arm.
    pub fn idle_joints(&self) -> usize {
        self.limbs.idle_arm.len()
    }

    /// Joint angles and velocities of the working arm (rad, rad/s).
    pub fn read_arm(&self, q: &mut [f64], v: &mut [f64]) {
        for (k, &dof) in self.limbs.arm.iter().enumerate() {
            q[k] = self.joint_state.0[dof];
            v[k] = self.joint_state.1[dof];
        }
    }

    /// Joint angles and velocities of the other arm (rad, rad/s).
    pub fn read_idle_arm(&self, q: &mut [f64], v: &mut [f64]) {
        if let Some(idle) = &self.robot.idle {
            idle.read_some(&self.engine, &self.limbs.idle_arm, q, v);
        }
    }

    /// True efforts of the working arm's drives in the last step (N m).
    pub fn read_efforts(&self, effort: &mut [f64]) {
        for (k, &dof) in self.limbs.arm.iter().enumerate() {
            effort[k] = self.robot.working.drives[dof].effort;
        }
    }

    /// Measured opening of the gripper (0 closed … 1 open); of a hook 0 while its clamp holds something; 1 without either.
    pub fn gripper_opening(&self) -> f64 {
        if self.hook.as_ref().is_some_and(Hook::holds) {
            return 0.0;
        }
        match (self.finger_range, self.limbs.fingers.first()) {
            (Some((closed, open)), Some(&leader)) => (self.joint_state.0[leader] - closed) / (open - closed),
            _ => 1.0,
        }
    }

    /// `world_from_tool`.
    pub fn tool_pose(&self) -> Isometry3<f64> {
        self.body_pose(self.robot.bodies[self.limbs.tool_body]) * self.limbs.body_from_tool
    }

    /// Pose and velocity of the place where a person takes hold.
    pub fn grasp_state(&self) -> GraspState {
        let handle = self.robot.bodies[self.limbs.grasp_body];
        let pose = self.body_pose(handle) * self.limbs.body_from_grasp;
        let (linear_velocity, angular_velocity) = self.engine.bodies.get(handle).map_or((Vector3::zeros(), Vector3::zeros()), |body| {
            let at = body.velocity_at_point(convert::vector(&pose.translation.vector));
            (convert::vector_back(at), convert::vector_back(body.angvel()))
        });
        GraspState { pose, linear_velocity, angular_velocity }
    }

    /// `tool_from_grasp`: constant, as both sit on the hand.
    pub fn tool_from_grasp(&self) -> Isometry3<f64> {
        self.tool_pose().inverse() * self.grasp_state().pose
    }

    /// `world_from_object` of the object with this index; of a cabinet, of its door.
    pub fn object_pose(&self, object: usize) -> Isometry3<f64> {
        self.body_pose(self.objects[object])
    }

    /// Speed of the object with this index (m/s).
    pub fn object_speed(&self, object: usize) -> f64 {
        self.engine.bodies.get(self.objects[object]).map_or(0.0, |body| body.linvel().length())
    }

    /// Force by the objects on fingers and tool in the last step, as the engine solved it: through a clamp and by contacts, pressing and
    /// rubbing (N, world).
    pub fn tool_force(&self) -> Vector3<f64> {
        self.contacts.tool_force + self.hook.as_ref().map_or_else(Vector3::zeros, |hook| hook.force)
    }

    /// `world_from_body` of every body of the robot model.
    pub fn robot_poses(&self, poses: &mut Vec<Isometry3<f64>>) {
        self.robot.poses(&self.engine, poses);
    }

    /// Kinetic energy of everything that moves (J).
    pub fn kinetic_energy_j(&self) -> f64 {
        self.engine.bodies.iter().filter(|(_, body)| body.is_dynamic()).map(|(_, body)| body.kinetic_energy()).sum()
    }

    /// All contacts so far.
    pub fn contacts(&self) -> &[ContactEpisode] {
        &self.contacts.episodes
    }

    /// Where what touches did so since the last record, when touches are kept for records; one point of a pair, where it was deepest.
    pub fn recent_touches(&self) -> &[TouchPoint] {
        &self.contacts.recent.points
    }

    /// Keeps touches for records that are made at steps that are multiples of `every`.
    pub fn keep_touches(&mut self, every: u64) {
        self.contacts.recent.every_steps = every;
    }

    /// Smallest distances so far, from each part of the robot to each thing that it could hit; none when they are not watched.
    pub fn clearances(&self) -> &[Clearance] {
        self.watch.as_ref().map_or(&[], |watch| &watch.book.smallest)
    }

    /// Hash over the bits of every moving body's state at every step so far.
    pub fn state_hash(&self) -> u64 {
        self.hasher.finish()
    }

    /// The engine's own mass matrix of the working arm with its gripper, in the posture of the last step.
    pub fn mass_matrix(&self) -> Option<DMatrix<f64>> {
        self.robot.mass_matrix(&self.engine)
    }

    fn body_pose(&self, handle: RigidBodyHandle) -> Isometry3<f64> {
        self.engine.bodies.get(handle).map_or_else(Isometry3::identity, |body| convert::pose_back(body.position()))
    }
}
