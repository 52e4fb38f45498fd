//! A hook at the handles of cabinets: the clamp that closes around a bar, and what the door does to it.

use nalgebra::{Isometry3, Point3, Vector3};
use rapier3d_f64::prelude::{ImpulseJointHandle, IntegrationParameters, PhysicsWorld, RigidBodyHandle, SphericalJointBuilder};

use super::cabinet::{Cabinet, Grip};
use super::{Parameters, convert};
use crate::math::smooth_step;

/// How near to a bar's axis the hook's middle must be for the clamp to close around it (m).
const REACH_M: f64 = 0.01;
/// How long the closing clamp takes to draw the bar to its middle (s).
const CENTRING_S: f64 = 0.5;

/// A hook that can hold the handles of doors.
pub(super) struct Hook {
    tool_body: RigidBodyHandle,
    body_from_tool: Isometry3<f64>,
    /// What its clamp may close around.
    bars: Vec<Bar>,
    /// Whether the hook is told to close.
    pub closed: bool,
    clamp: Option<Clamp>,
    /// Force by the door on the hook through the clamp in the last step (N, world).
    pub force: Vector3<f64>,
}

/// A handle's bar.
struct Bar {
    door: RigidBodyHandle,
    /// Its middle, in the door's frame, and half its length (m).
    middle: Point3<f64>,
    half_length_m: f64,
}

/// A closed clamp: a ball joint between the hook's middle and a point of the door that moves gently to the bar's axis.
struct Clamp {
    joint: ImpulseJointHandle,
    /// Where the joint first holds the door, and where it does when the clamp has closed, in the door's frame (m).
    first: Point3<f64>,
    axis: Point3<f64>,
    /// Steps since it took hold.
    steps: u64,
}

impl Hook {
    /// An open hook, which is the tool, on the body `tool_body`. It finds no bars yet.
    pub(super) fn new(tool_body: RigidBodyHandle, body_from_tool: Isometry3<f64>) -> Self {
        Self { tool_body, body_from_tool, bars: Vec::new(), closed: false, clamp: None, force: Vector3::zeros() }
    }

    /// Lets the clamp close around the bars of `cabinet`, whose hinge is at `hinge_y_m` (world), if that is how they are held.
    pub(super) fn add(&mut self, cabinet: &Cabinet, parameters: &Parameters, hinge_y_m: f64, door: RigidBodyHandle) {
        if cabinet.grip == Grip::Clamp {
            let half_length_m = cabinet.handle_length_m / 2.0;
            let bars = cabinet.bars(hinge_y_m, parameters).into_iter();
            self.bars.extend(bars.map(|(_, middle)| Bar { door, middle, half_length_m }));
        }
    }

    /// Whether the clamp holds a bar.
    pub(super) fn holds(&self) -> bool {
        self.clamp.is_some()
    }

    /// Opens and closes the clamp, before a step.
    pub(super) fn act(&mut self, engine: &mut PhysicsWorld) {
        match (&mut self.clamp, self.closed) {
            (None, true) => self.clamp = self.close(engine),
            (Some(clamp), true) => clamp.centre(engine),
            (Some(clamp), false) => {
                engine.remove_impulse_joint(clamp.joint);
                self.clamp = None;
                self.force = Vector3::zeros();
            }
            (None, false) => {}
        }
    }

    /// Clamps the nearest bar within reach, where it is.
    fn close(&self, engine: &mut PhysicsWorld) -> Option<Clamp> {
        let pose = |handle| engine.bodies.get(handle).map(|body| convert::pose_back(body.position()));
        let tool = pose(self.tool_body)? * Point3::from(self.body_from_tool.translation.vector);
        // Of each bar: how far its axis is away, the hook's middle in the door's frame, and the axis's point beside it.
        let at = |bar: &Bar| {
            let (first, middle) = (pose(bar.door)?.inverse_transform_point(&tool), bar.middle);
            let axis = Point3::new(middle.x, middle.y, first.z.clamp(middle.z - bar.half_length_m, middle.z + bar.half_length_m));
            Some(((axis - first).norm(), bar.door, first, axis))
        };
        let (away_m, door, first, axis) = self.bars.iter().filter_map(at).min_by(|a, b| a.0.total_cmp(&b.0))?;
        if away_m > REACH_M {
            return None;
        }
        let joint = SphericalJointBuilder::new()
            .local_anchor1(convert::vector(&self.body_from_tool.translation.vector))
            .local_anchor2(convert::vector(&first.coords))
            .contacts_enabled(true);
        Some(Clamp { joint: engine.insert_impulse_joint(self.tool_body, door, joint), first, axis, steps: 0 })
    }

    /// After a step: reads what the clamp did.
    pub(super) fn read(&mut self, engine: &PhysicsWorld) {
        let Some(clamp) = &self.clamp else { return };
        let Some(joint) = engine.impulse_joints.get(clamp.joint) else { return };
        let Some(body) = engine.bodies.get(self.tool_body) else { return };
        // The engine's impulses act along the axes of the joint's first frame, which are those of the hook's body.
        let impulse = Vector3::new(joint.impulses[0], joint.impulses[1], joint.impulses[2]);
        let rotation = convert::pose_back(body.position()).rotation;
        self.force = rotation * impulse / sub_step_s(&engine.integration_parameters);
    }
}

/// How long the impulses of joints act, which are those of the last of a step's solver iterations (s).
fn sub_step_s(parameters: &IntegrationParameters) -> f64 {
    parameters.dt / parameters.num_solver_iterations as f64
}

impl Clamp {
    /// Draws the bar's axis into the middle, along a minimum-jerk path.
    fn centre(&mut self, engine: &mut PhysicsWorld) {
        let before_s = self.steps as f64 * engine.integration_parameters.dt;
        if before_s > CENTRING_S {
            return;
        }
        self.steps += 1;
        let drawn = smooth_step(before_s + engine.integration_parameters.dt, 0.0, CENTRING_S);
        let at = self.first + (self.axis - self.first) * drawn;
        if let Some(joint) = engine.impulse_joints.get_mut(self.joint, false) {
            joint.data.set_local_anchor2(convert::vector(&at.coords));
        }
    }
}
