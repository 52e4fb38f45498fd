//! One world: what it takes from controller and person in a step, and what can be seen of it.

use std::hash::Hasher;

use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyHandle};
use twox_hash::XxHash3_64;

use super::contacts::ContactBook;
use super::door::Door;
use super::hook::Hook;
use super::parts::Parts;
use super::robot_body::{Limbs, RobotBody};
use super::state_trace::{Tracer, state_of};
use super::watch::EngineWatch;
use super::{HandWrench, Object, ObjectKind, Parameters, PhysicsSettings, WorldError, convert, overlap, physics, scene};
use crate::robot::{JointCommand, RobotModel};

/// What a world is made of.
#[derive(Clone, Debug)]
pub struct WorldSettings<'a> {
    /// The engine's step.
    pub physics: &'a PhysicsSettings,
    /// The robot; its base frame is the world's.
    pub robot: &'a RobotModel,
    /// Link of the robot that is the tool (the grasp centre); the arm that carries it works.
    pub tool: &'a str,
    /// Link that a person takes hold of.
    pub grasp: &'a str,
    /// The working arm's posture at the start (rad).
    pub posture_rad: &'a [f64],
    /// Link that is the tool of the other arm; `None` when no other arm moves.
    pub idle_tool: Option<&'a str>,
    /// The other arm's posture (rad).
    pub idle_posture_rad: &'a [f64],
    /// Dry friction of each joint of the working arm, besides the robot's own (N m).
    pub dry_friction_nm: f64,
    /// Coefficient of friction of the working arm's fingers; what two surfaces have in common is the mean of theirs.
    pub finger_friction: f64,
    /// The scene.
    pub objects: &'a [Object],
    /// The setting.
    pub parameters: &'a Parameters,
    /// Whether distances and touches are watched, at every step and in between.
    pub watch: bool,
}

/// The simulated world.
pub struct World {
    pub(super) engine: PhysicsWorld,
    pub(super) parts: Parts,
    pub(super) robot: RobotBody,
    pub(super) limbs: Limbs,
    pub(super) objects: Vec<RigidBodyHandle>,
    pub(super) movable: Vec<bool>,
    pub(super) finger_range: FingerRange,
    pub(super) contacts: ContactBook,
    pub(super) watch: Option<EngineWatch>,
    pub(super) held: Vec<usize>,
    pub(super) doors: Vec<Door>,
    pub(super) hook: Option<Hook>,
    pub(super) joint_state: (Vec<f64>, Vec<f64>),
    pub(super) hand: HandWrench,
    pub(super) hasher: XxHash3_64,
    pub(super) tracer: Option<Tracer>,
    pub(super) step: u64,
}

impl World {
    /// Builds the world at time 0.
    ///
    /// # Errors
    /// When the robot lacks the tool, the grasp or an arm, a collision shape cannot be used, or something starts inside something else.
    pub fn new(settings: &WorldSettings) -> Result<Self, WorldError> {
        let world = Self::build(settings)?;
        overlap::refuse(&world.engine, &world.parts)?;
        Ok(world)
    }

    /// The world as the settings say, whatever stands inside what.
    pub(super) fn build(settings: &WorldSettings) -> Result<Self, WorldError> {
        let mut engine = physics::engine(settings.physics);
        let mut parts = Parts::default();
        let model = settings.robot;
        let limbs = Limbs::find(model, settings.tool, settings.grasp, settings.idle_tool)?;
        let working_q = starting_positions(model, &limbs.working, &limbs.arm, settings.posture_rad)?;
        let idle_q = starting_positions(model, &limbs.idle, &limbs.idle_arm, settings.idle_posture_rad)?;
        let finger_range = limbs.fingers.first().map(|&dof| &model.joints[limbs.working[dof]]).map(|joint| (joint.lower, joint.upper));
        let mut robot = RobotBody::new(&mut engine, model, &limbs, (&working_q, &idle_q), settings.finger_friction, &mut parts)?;
        for &dof in &limbs.arm {
            let own = model.joints[limbs.working[dof]].friction;
            robot.working.set_friction(&mut engine, dof, own + settings.dry_friction_nm);
        }
        let (objects, doors) = scene::build(&mut engine, settings.objects, settings.parameters, &mut parts);
        let movable: Vec<bool> = settings.objects.iter().map(Object::is_movable).collect();
        let names: Vec<String> = settings.objects.iter().map(|o| o.name.clone()).collect();
        let moving: Vec<bool> = settings.objects.iter().map(Object::moves).collect();
        let watch = settings.watch.then(|| EngineWatch::new(&engine, &parts, &names, &moving));
        let hook = hook_of(settings, &limbs, &robot, &objects);
        let n = limbs.working.len();
        let mut world = Self {
            engine,
            parts,
            robot,
            limbs,
            objects,
            movable,
            finger_range,
            contacts: ContactBook::default(),
            watch,
            held: Vec::new(),
            doors,
            hook,
            joint_state: (vec![0.0; n], vec![0.0; n]),
            hand: HandWrench::default(),
            hasher: XxHash3_64::with_seed(0),
            tracer: None,
            step: 0,
        };
        world.command_gripper(1.0);
        world.read_joints();
        Ok(world)
    }

    /// Tells the working arm what to do in the next step.
    pub fn command_arm(&mut self, command: &JointCommand) {
        self.robot.working.command(&self.limbs.arm, command);
    }

    /// Tells the other arm what to do in the next step.
    pub fn command_idle_arm(&mut self, command: &JointCommand) {
        if let Some(idle) = &mut self.robot.idle {
            idle.command(&self.limbs.idle_arm, command);
        }
    }

    /// Makes the gripper seek `opening` (0 closed … 1 open) with its limited force; a hook's clamp closes below one half.
    pub fn command_gripper(&mut self, opening: f64) {
        if let Some(hook) = &mut self.hook {
            hook.closed = opening < 0.5;
        }
        if let (Some((closed, open)), Some(&leader)) = (self.finger_range, self.limbs.fingers.first()) {
            self.robot.working.seek(&mut self.engine, leader, closed + opening.clamp(0.0, 1.0) * (open - closed));
        }
    }

    /// What the person's hand does in the next step.
    pub fn push(&mut self, hand: HandWrench) {
        self.hand = hand;
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// When a body's state is no longer finite.
    pub fn advance(&mut self) -> Result<(), WorldError> {
        self.robot.working.act(&mut self.engine);
        if let Some(idle) = &mut self.robot.idle {
            idle.act(&mut self.engine);
        }
        self.apply_hand();
        if let Some(hook) = &mut self.hook {
            hook.act(&mut self.engine);
        }
        self.doors.iter().for_each(|door| door.act(&mut self.engine));
        self.step += 1;
        physics::step(&mut self.engine, &self.parts, self.step)?;
        self.robot.working.settle_efforts(&self.engine);
        if let Some(hook) = &mut self.hook {
            hook.read(&self.engine);
        }
        self.read_joints();
        let time_s = self.time_s();
        self.contacts.recent.begin(self.step);
        self.contacts.record(&self.engine, &self.parts, &self.movable, time_s);
        self.update_held();
        self.watch_step(time_s);
        self.hash_state();
        self.record_trace();
        Ok(())
    }

    /// What the shapes tell about the step beyond the engine's contacts.
    fn watch_step(&mut self, time_s: f64) {
        let Some(watch) = &mut self.watch else { return };
        let start_s = (self.step - 1) as f64 * self.engine.integration_parameters.dt;
        watch.follow(&self.engine, &self.held, (start_s, time_s));
        for touch in &watch.book.touches {
            self.contacts.note(touch, &self.parts);
        }
    }

    fn apply_hand(&mut self) {
        let handle = self.robot.bodies[self.limbs.grasp_body];
        if self.hand != HandWrench::default()
            && let Some(body) = self.engine.bodies.get_mut(handle)
        {
            body.add_force_at_point(convert::vector(&self.hand.force), convert::vector(&self.hand.point.coords), true);
            body.add_torque(convert::vector(&self.hand.moment), true);
        }
    }

    pub(super) fn read_joints(&mut self) {
        let (q, v) = &mut self.joint_state;
        self.robot.working.read(&self.engine, q, v);
    }

    /// An object is held while two fingers touch it.
    fn update_held(&mut self) {
        self.held.clear();
        for object in (0..self.movable.len()).filter(|&i| self.movable[i]) {
            let mut fingers = self.contacts.grips.iter().filter(|(_, o)| *o == object).map(|(body, _)| *body);
            if let Some(first) = fingers.next()
                && fingers.any(|other| other != first)
            {
                self.held.push(object);
            }
        }
    }

    fn hash_state(&mut self) {
        for (_, body) in self.engine.bodies.iter().filter(|(_, body)| body.is_dynamic()) {
            for number in state_of(body) {
                self.hasher.write_u64(number.to_bits());
            }
        }
    }
}

/// The hook, when the robot has no fingers and there are cabinets to open.
fn hook_of(settings: &WorldSettings, limbs: &Limbs, robot: &RobotBody, bodies: &[RigidBodyHandle]) -> Option<Hook> {
    let mut hook = None;
    for (object, &door) in settings.objects.iter().zip(bodies).filter(|_| limbs.fingers.is_empty()) {
        let ObjectKind::Cabinet(cabinet) = &object.kind else { continue };
        let hook = hook.get_or_insert_with(|| Hook::new(robot.bodies[limbs.tool_body], limbs.body_from_tool));
        hook.add(cabinet, settings.parameters, object.center(settings.parameters).y, door);
    }
    hook
}

/// Range of a gripper's leading finger: where it is closed and where it is open (m).
pub(super) type FingerRange = Option<(f64, f64)>;

/// Positions of the joints of a tree at the start: the arm's posture, and fingers that are open.
fn starting_positions(model: &RobotModel, tree: &[usize], arm: &[usize], posture: &[f64]) -> Result<Vec<f64>, WorldError> {
    if posture.len() != arm.len() {
        return Err(WorldError::Robot {
            robot: model.name.clone(),
            what: format!("arm of {} joints (its arm has {})", posture.len(), arm.len()),
            help: "give one angle per joint".into(),
        });
    }
    let mut positions: Vec<f64> =
        tree.iter().map(|&joint| &model.joints[joint]).map(|joint| if joint.upper.is_finite() { joint.upper } else { 0.0 }).collect();
    for (&dof, &angle) in arm.iter().zip(posture) {
        positions[dof] = angle;
    }
    follow_leaders(model, tree, &mut positions);
    Ok(positions)
}

/// Puts the joints of a tree that follow others where those are.
pub(super) fn follow_leaders(model: &RobotModel, tree: &[usize], positions: &mut [f64]) {
    for (dof, &joint) in tree.iter().enumerate() {
        if let Some(mimic) = &model.joints[joint].mimic {
            let leader = tree.iter().position(|&j| j == mimic.joint).map_or(0.0, |place| positions[place]);
            positions[dof] = mimic.multiplier * leader + mimic.offset;
        }
    }
}
