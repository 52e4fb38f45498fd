//! An arm in the engine: reduced-coordinate joints that are driven by torques.
//!
//! The engine has no generalised forces, so a joint torque is a pair of opposite torques on the two links that it joins. What must be stable
//! at any gain (the drives' damping and the joints' own) is given to the engine as implicit damping; the effort sensor sees the drive's part.

use nalgebra::{DMatrix, Isometry3, Translation3};
use rapier3d_f64::prelude::{
    GenericJoint, GenericJointBuilder, JointAxesMask, JointAxis, MassProperties, MotorModel, MultibodyDofCoupling, MultibodyJointHandle,
    PhysicsWorld, Pose, RigidBodyBuilder, Vector,
};

use super::convert;
use super::drive::Drive;
use crate::robot::{Joint, JointCommand, JointKind, RobotModel};

/// Stiffness (N/m) and damping (N s/m) with which the gripper's drive seeks its commanded opening; its force limit is the joint's effort limit.
const GRIPPER_STIFFNESS_N_PER_M: f64 = 2000.0;
const GRIPPER_DAMPING_NS_PER_M: f64 = 60.0;

/// A tree of joints that hangs on a fixed body: an arm with its gripper.
pub(super) struct Articulation {
    handle: MultibodyJointHandle,
    /// Degree of freedom i moves the link `drives[i].link`.
    pub drives: Vec<Drive>,
}

impl Articulation {
    /// Builds the joints `joints` of `model` (parents first), starting at `positions` (rad or m), on a fixed body at `world_from_root`.
    pub(super) fn new(
        engine: &mut PhysicsWorld,
        model: &RobotModel,
        joints: &[usize],
        positions: &[f64],
        world_from_root: &Isometry3<f64>,
    ) -> Option<Self> {
        let root = engine.insert_body(RigidBodyBuilder::fixed().pose(convert::pose(world_from_root)));
        let mut link_of_body = vec![None; model.bodies.len()];
        let mut drives = Vec::with_capacity(joints.len());
        let mut handle = None;
        for &index in joints {
            let joint = &model.joints[index];
            let parent = link_of_body[joint.parent_body].unwrap_or(root);
            let link = engine.insert_body(link_body(model, joint.child_body));
            handle = engine.multibody_joints.insert(parent, link, engine_joint(joint), true);
            link_of_body[joint.child_body] = Some(link);
            drives.push(Drive::new(index, joint, parent, link));
        }
        let mut arm = Self { handle: handle?, drives };
        arm.set_joint_properties(engine, model);
        arm.place(engine, positions);
        arm.measure_inertias(engine, model);
        Some(arm)
    }

    fn set_joint_properties(&mut self, engine: &mut PhysicsWorld, model: &RobotModel) {
        let ids: Vec<usize> =
            self.drives.iter().map(|d| engine.multibody_joints.rigid_body_link(d.link).map_or(0, |link| link.id)).collect();
        let Some((multibody, _)) = engine.multibody_joints.get_mut(self.handle) else { return };
        multibody.set_self_contacts_enabled(false);
        for (i, drive) in self.drives.iter().enumerate() {
            let joint = &model.joints[drive.joint];
            multibody.damping_mut()[i] = joint.damping;
            multibody.frictions_mut()[i] = joint.friction;
            let Some(mimic) = &joint.mimic else { continue };
            let Some(leader) = self.drives.iter().position(|d| d.joint == mimic.joint) else { continue };
            let axis = |k: usize| free_axis(&model.joints[self.drives[k].joint]);
            multibody.add_dof_coupling(MultibodyDofCoupling {
                link1: ids[leader],
                dof1: 0,
                axis1: axis(leader),
                link2: ids[i],
                dof2: 0,
                axis2: axis(i),
                coeff: mimic.multiplier,
                offset: mimic.offset,
            });
        }
    }

    /// Puts the joints at `positions` before the first step.
    fn place(&mut self, engine: &mut PhysicsWorld, positions: &[f64]) {
        let PhysicsWorld { bodies, colliders, multibody_joints, .. } = engine;
        for drive in &self.drives {
            if let Some(body) = bodies.get_mut(drive.link) {
                body.recompute_mass_properties_from_colliders(colliders);
            }
        }
        let Some((multibody, _)) = multibody_joints.get_mut(self.handle) else { return };
        multibody.forward_kinematics(bodies, true);
        multibody.apply_displacements(positions);
        multibody.forward_kinematics(bodies, false);
        multibody.update_rigid_bodies(bodies, true);
    }

    /// Fills the drives' inertias: one over the diagonal of the inverse mass matrix.
    fn measure_inertias(&mut self, engine: &PhysicsWorld, model: &RobotModel) {
        let Some((multibody, _)) = engine.multibody_joints.get(self.handle) else { return };
        let n = multibody.ndofs();
        let mut mass = DMatrix::<f64>::zeros(n, n);
        for (i, drive) in self.drives.iter().enumerate() {
            let Some(link) = engine.bodies.get(drive.link) else { return };
            let body = &model.bodies[model.joints[drive.joint].child_body];
            let rotation = convert::pose_back(link.position()).rotation.to_rotation_matrix();
            let inertia = rotation * body.inertia * rotation.transpose();
            let jacobian = multibody.body_jacobian(i + 1);
            let (linear, angular) = (jacobian.rows(0, 3), jacobian.rows(3, 3));
            mass += linear.transpose() * linear * body.mass_kg + angular.transpose() * inertia * angular;
        }
        let Some(inverse) = mass.try_inverse() else { return };
        for (i, drive) in self.drives.iter_mut().enumerate() {
            drive.inertia = 1.0 / inverse[(i, i)];
        }
    }

    /// Sets the dry friction of the joint of degree of freedom `dof` (N m).
    pub(super) fn set_friction(&mut self, engine: &mut PhysicsWorld, dof: usize, friction_nm: f64) {
        if let Some((multibody, _)) = engine.multibody_joints.get_mut(self.handle) {
            multibody.frictions_mut()[dof] = friction_nm;
        }
    }

    /// Reads positions and velocities of the degrees of freedom (rad, rad/s or m, m/s).
    pub(super) fn read(&self, engine: &PhysicsWorld, q: &mut [f64], v: &mut [f64]) {
        let Some((multibody, _)) = engine.multibody_joints.get(self.handle) else { return };
        let velocity = multibody.generalized_velocity();
        for (i, link) in multibody.links().skip(1).enumerate().take(q.len()) {
            let coords = link.joint().coords();
            q[i] = coords[link_axis(link.joint().data)];
            v[i] = velocity[i];
        }
    }

    /// As [`Self::read`], of the degrees of freedom `dofs` only.
    pub(super) fn read_some(&self, engine: &PhysicsWorld, dofs: &[usize], q: &mut [f64], v: &mut [f64]) {
        let Some((multibody, _)) = engine.multibody_joints.get(self.handle) else { return };
        let velocity = multibody.generalized_velocity();
        for (k, &dof) in dofs.iter().enumerate() {
            let Some(link) = multibody.link(dof + 1) else { continue };
            q[k] = link.joint().coords()[link_axis(link.joint().data)];
            v[k] = velocity[dof];
        }
    }

    /// Tells the drives of the degrees of freedom `dofs` (in the order of the command) what to do in the next step.
    pub(super) fn command(&mut self, dofs: &[usize], command: &JointCommand) {
        for (k, &i) in dofs.iter().enumerate() {
            self.drives[i].command = (command.torque_nm[k], command.damping_nms_per_rad[k]);
        }
    }

    /// Applies the commanded torques within the drives' limits of effort and velocity. Clears all forces of the last step.
    pub(super) fn act(&mut self, engine: &mut PhysicsWorld) {
        let step_s = engine.integration_parameters.dt;
        let PhysicsWorld { bodies, multibody_joints, .. } = engine;
        let Some((multibody, _)) = multibody_joints.get_mut(self.handle) else { return };
        for drive in &self.drives {
            if let Some(body) = bodies.get_mut(drive.link) {
                body.reset_torques(false);
                body.reset_forces(false);
            }
        }
        for (i, drive) in self.drives.iter_mut().enumerate() {
            let (torque, damping) = drive.command;
            multibody.damping_mut()[i] = drive.passive_damping + damping;
            let v = multibody.generalized_velocity()[i];
            drive.effort = drive.limited(torque - damping * v, v, step_s) - drive.excess + damping * v;
            let Some(rotation) = bodies.get(drive.link).map(|body| *body.rotation()) else { continue };
            let torque = rotation * drive.axis * drive.effort;
            if let Some(body) = bodies.get_mut(drive.link) {
                body.add_torque(torque, true);
            }
            if let Some(body) = bodies.get_mut(drive.parent) {
                body.add_torque(-torque, true);
            }
        }
    }

    /// After the step: what each drive delivered, with the damping at the new velocity.
    ///
    /// The damping reacts to the velocity at the end of the step, so an impact may carry the effort over its limit for that step. What was
    /// over is taken back in the next one, so over a stretch of steps the mean effort exceeds the limit by no more than one step's share.
    pub(super) fn settle_efforts(&mut self, engine: &PhysicsWorld) {
        let Some((multibody, _)) = engine.multibody_joints.get(self.handle) else { return };
        for (i, drive) in self.drives.iter_mut().enumerate() {
            drive.effort -= drive.command.1 * multibody.generalized_velocity()[i];
            drive.excess = drive.effort - drive.effort.clamp(-drive.effort_limit, drive.effort_limit);
        }
    }

    /// Makes the drive of a prismatic joint seek `position_m` with at most its effort limit.
    pub(super) fn seek(&mut self, engine: &mut PhysicsWorld, dof: usize, position_m: f64) {
        let link = self.drives[dof].link;
        let Some(id) = engine.multibody_joints.rigid_body_link(link).map(|link| link.id) else { return };
        if let Some((multibody, _)) = engine.multibody_joints.get_mut(self.handle)
            && let Some(link) = multibody.link_mut(id)
        {
            link.joint.data.set_motor_position(JointAxis::LinX, position_m, GRIPPER_STIFFNESS_N_PER_M, GRIPPER_DAMPING_NS_PER_M);
        }
    }

    /// The engine's own mass matrix of this tree in the posture of the last step (kg m², kg m, kg): what it factorised, less the damping.
    pub(super) fn mass_matrix(&self, engine: &PhysicsWorld) -> Option<DMatrix<f64>> {
        let (multibody, _) = engine.multibody_joints.get(self.handle)?;
        let n = multibody.ndofs();
        let inverse = multibody.inv_augmented_mass().solve(&DMatrix::identity(n, n))?;
        let augmented = inverse.try_inverse()?;
        let implicit = (multibody.damping() * engine.integration_parameters.dt) + multibody.armature();
        Some(augmented - DMatrix::from_diagonal(&implicit))
    }
}

fn link_body(model: &RobotModel, body: usize) -> RigidBodyBuilder {
    let body = &model.bodies[body];
    let mass = MassProperties::with_inertia_matrix(convert::vector(&body.center_of_mass), body.mass_kg, convert::matrix(&body.inertia));
    RigidBodyBuilder::dynamic().additional_mass_properties(mass).can_sleep(false)
}

fn engine_joint(joint: &Joint) -> GenericJoint {
    let prismatic = joint.kind == JointKind::Prismatic;
    let axis = convert::vector(&joint.axis);
    let turned = Pose::from_parts(Vector::ZERO, GenericJoint::complete_ang_frame(axis));
    let frame = Isometry3::from_parts(Translation3::identity(), convert::pose_back(&turned).rotation);
    let mask = if prismatic { JointAxesMask::LOCKED_PRISMATIC_AXES } else { JointAxesMask::LOCKED_REVOLUTE_AXES };
    let free = if prismatic { JointAxis::LinX } else { JointAxis::AngX };
    let mut builder = GenericJointBuilder::new(mask)
        .local_frame1(convert::pose(&(joint.parent_from_joint * frame)))
        .local_frame2(convert::pose(&frame))
        .contacts_enabled(false);
    if joint.kind != JointKind::Continuous {
        builder = builder.limits(free, [joint.lower, joint.upper]);
    }
    // A joint that mimics another has no drive of its own.
    if prismatic && joint.mimic.is_none() {
        builder = builder
            .motor_model(free, MotorModel::ForceBased)
            .set_motor(free, joint.lower, 0.0, GRIPPER_STIFFNESS_N_PER_M, GRIPPER_DAMPING_NS_PER_M)
            .motor_max_force(free, joint.effort_limit);
    }
    builder.build()
}

fn free_axis(joint: &Joint) -> usize {
    if joint.kind == JointKind::Prismatic { 0 } else { 3 }
}

fn link_axis(joint: GenericJoint) -> usize {
    if joint.locked_axes.contains(JointAxesMask::LIN_X) { 3 } else { 0 }
}
