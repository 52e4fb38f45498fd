//! Where every solid of a scene is when the joints and the objects are known, and how far it moves at most when they move.

use rapier3d_f64::prelude::{Collider, Pose};

use super::even_motion::Ball;
use super::{World, convert};
use crate::robot::{JointKind, RobotModel};

/// What carries a solid.
enum Carrier {
    /// Nothing that moves.
    World(Pose),
    /// A body of the working arm, by its index in the model.
    Body(usize, Pose),
    /// An object.
    Object(usize, Pose),
}

/// Where everything is at one moment.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub time_s: f64,
    /// Positions of the working arm's tree (rad or m).
    pub positions: Vec<f64>,
    /// `world_from_object` of every object.
    pub objects: Vec<Pose>,
}

/// A robot and objects whose solids are carried along.
pub(super) struct Mechanism {
    model: RobotModel,
    /// Joints of the working arm's tree, parents first.
    tree: Vec<usize>,
    carriers: Vec<Carrier>,
    balls: Vec<Ball>,
    /// For every solid: the longest way (m) of one of its points when a joint of the tree moves by 1 (rad or m).
    levers: Vec<Vec<f64>>,
}

impl Mechanism {
    /// Of the colliders of a world, in the order of the solids.
    pub(super) fn new(world: &World, model: &RobotModel, colliders: &[&Collider]) -> Self {
        let tree = world.limbs.working.clone();
        let carriers: Vec<Carrier> = colliders.iter().map(|collider| carrier(world, model, &tree, collider)).collect();
        let balls: Vec<Ball> = colliders.iter().map(|collider| Ball::around(collider.shape())).collect();
        let levers = carriers.iter().zip(&balls).map(|(carrier, ball)| levers(model, &tree, carrier, ball)).collect();
        Self { model: model.clone(), tree, carriers, balls, levers }
    }

    /// The longest path of a point of solid `index` between two states (m).
    ///
    /// A turn by q moves a point at distance r from the axis by at most q r; r is at most the way from joint to joint to the solid's ball.
    pub(super) fn travel_m(&self, index: usize, before: &State, after: &State) -> f64 {
        match &self.carriers[index] {
            Carrier::World(_) => 0.0,
            Carrier::Body(..) => {
                let moved = before.positions.iter().zip(&after.positions).map(|(from, to)| (to - from).abs());
                moved.zip(&self.levers[index]).map(|(by, lever)| by * lever).sum()
            }
            Carrier::Object(object, offset) => {
                self.balls[index].travel_m(&(before.objects[*object] * *offset), &(after.objects[*object] * *offset))
            }
        }
    }

    /// `world_from_body` of every body at a fraction of the way between two states; only those of the working arm are filled in.
    pub(super) fn bodies(&self, before: &State, after: &State, fraction: f64, poses: &mut Vec<Pose>) {
        poses.clear();
        poses.resize(self.model.bodies.len(), Pose::IDENTITY);
        for (place, &joint) in self.tree.iter().enumerate() {
            let position = before.positions[place] + fraction * (after.positions[place] - before.positions[place]);
            let joint = &self.model.joints[joint];
            poses[joint.child_body] = poses[joint.parent_body] * convert::pose(&joint.parent_from_child(position));
        }
    }

    /// `world_from_solid` at a fraction of the way between two states, with the bodies as [`Self::bodies`] says.
    pub(super) fn pose(&self, index: usize, before: &State, after: &State, fraction: f64, bodies: &[Pose]) -> Pose {
        match &self.carriers[index] {
            Carrier::World(pose) => *pose,
            Carrier::Body(body, offset) => bodies[*body] * *offset,
            Carrier::Object(object, offset) => {
                self.balls[index].pose(&(before.objects[*object] * *offset), &(after.objects[*object] * *offset), fraction)
            }
        }
    }
}

fn carrier(world: &World, model: &RobotModel, tree: &[usize], collider: &Collider) -> Carrier {
    let offset = collider.position_wrt_parent().copied().unwrap_or(Pose::IDENTITY);
    let parent = collider.parent();
    if let Some(object) = world.objects.iter().position(|&handle| Some(handle) == parent) {
        return Carrier::Object(object, offset);
    }
    let body = world.robot.bodies.iter().position(|&handle| Some(handle) == parent);
    match body.filter(|&body| tree.iter().any(|&joint| model.joints[joint].child_body == body)) {
        Some(body) => Carrier::Body(body, offset),
        None => Carrier::World(*collider.position()),
    }
}

fn levers(model: &RobotModel, tree: &[usize], carrier: &Carrier, ball: &Ball) -> Vec<f64> {
    let mut levers = vec![0.0; tree.len()];
    let Carrier::Body(body, offset) = carrier else { return levers };
    let mut body = *body;
    let mut reach = offset.transform_point(ball.center).length() + ball.radius_m;
    while let Some(place) = tree.iter().position(|&joint| model.joints[joint].child_body == body) {
        let joint = &model.joints[tree[place]];
        let slides = joint.kind == JointKind::Prismatic;
        levers[place] = if slides { 1.0 } else { reach };
        reach += joint.parent_from_joint.translation.vector.norm();
        reach += if slides { joint.lower.abs().max(joint.upper.abs()) } else { 0.0 };
        body = joint.parent_body;
    }
    levers
}
