//! A robot that is moved by hand through a scene: no forces and no controller, only geometry.

use std::cell::RefCell;

use nalgebra::Isometry3;
use rapier3d_f64::prelude::{Collider, Pose};

use super::contacts::ContactBook;
use super::gap::Gap;
use super::mechanism::{Mechanism, State};
use super::overlap;
use super::parts::{Limb, Owner, Parts};
use super::proximity::{Motion, ProximityBook, Watched};
use super::robot_body::Limbs;
use super::simulated_world::{FingerRange, follow_leaders};
use super::{Clearance, ContactEpisode, Object, World, WorldError, WorldSettings, convert};
use crate::robot::RobotModel;

/// How near two fingers must be to an object that they hold (m): the pads of a logged grasp may stand a little off.
const HELD_GAP_M: f64 = 1e-3;

/// Where everything is at one moment.
#[derive(Clone, Copy, Debug)]
pub struct Placement<'a> {
    /// The moment (s).
    pub time_s: f64,
    /// Joint angles of the working arm, from the shoulder (rad).
    pub arm_rad: &'a [f64],
    /// Opening of the gripper (0 closed … 1 open).
    pub gripper: f64,
    /// `world_from_object` of every object (of a cabinet, of its door), of which those that move are taken; without them, all stay where they are.
    pub objects: Option<&'a [Isometry3<f64>]>,
}

/// The scene and the robot in it. Between two placements every joint moves evenly, and every object goes straight and turns evenly: no touch
/// in between is missed, and no distance up to [`super::NEAR_M`] is told too large by more than [`super::RESOLUTION_M`], none beyond by more than
/// a fiftieth of it.
pub struct KinematicScene {
    mechanism: Mechanism,
    model: RobotModel,
    limbs: Limbs,
    finger_range: FingerRange,
    parts: Parts,
    /// Which objects can be held.
    movable: Vec<bool>,
    /// Which objects do not always stay where they start: those that are movable, and doors.
    moving: Vec<bool>,
    book: ProximityBook,
    contacts: ContactBook,
    held: Vec<usize>,
    travel_m: Vec<f64>,
    before: State,
    after: State,
    placed: bool,
}

impl KinematicScene {
    /// Builds the scene; the arm stands as the settings say until it is placed.
    ///
    /// # Errors
    /// When the robot lacks the tool, the grasp or an arm, a collision shape cannot be used, or something besides the working arm starts inside
    /// something else.
    pub fn new(settings: &WorldSettings) -> Result<Self, WorldError> {
        let world = World::build(settings)?;
        // Where the arm is, the movement says; everything else must stand apart as in a simulation.
        overlap::refuse_among(&world.engine, &world.parts, |owner| !matches!(owner, Owner::Robot { limb: Limb::Working, .. }))?;
        let names: Vec<&str> = settings.objects.iter().map(|object| object.name.as_str()).collect();
        let named = |collider: &&Collider| world.parts.of(collider.user_data).is_some();
        let colliders: Vec<&Collider> = world.engine.colliders.iter().map(|(_, collider)| collider).filter(named).collect();
        let solid = |collider: &&Collider| {
            let (part, about) = world.parts.of(collider.user_data)?;
            let name = if let Owner::Object(object) = about.owner { names[object].to_owned() } else { about.name.clone() };
            Some(Watched { part, owner: about.owner, name, shape: collider.shared_shape().clone() })
        };
        let moving: Vec<bool> = settings.objects.iter().map(Object::moves).collect();
        let solids: Vec<Watched> = colliders.iter().filter_map(solid).collect();
        let groups: Vec<_> = colliders.iter().map(|collider| collider.collision_groups()).collect();
        let places = (0..names.len()).map(|object| convert::pose(&world.object_pose(object))).collect();
        let state = State { time_s: 0.0, positions: vec![0.0; world.limbs.working.len()], objects: places };
        Ok(Self {
            mechanism: Mechanism::new(&world, settings.robot, &colliders),
            travel_m: vec![0.0; solids.len()],
            book: ProximityBook::new(solids, &moving, |a, b| groups[a].test(groups[b])),
            contacts: ContactBook::default(),
            held: Vec::new(),
            before: state.clone(),
            after: state,
            placed: false,
            model: settings.robot.clone(),
            finger_range: world.finger_range,
            parts: world.parts,
            movable: world.movable,
            moving,
            limbs: world.limbs,
        })
    }

    /// Moves everything from where it was placed last to `placement`; the first placement is where it begins.
    ///
    /// # Panics
    /// When the placement has another number of joints or objects than the scene.
    pub fn place(&mut self, placement: &Placement) {
        self.place_while(placement, &|| true);
    }

    /// As [`Self::place`], as long as `may_go_on`, which is asked before every distance; once it may not, contacts and clearances are incomplete.
    ///
    /// # Panics
    /// As [`Self::place`].
    pub fn place_while(&mut self, placement: &Placement, may_go_on: &dyn Fn() -> bool) {
        std::mem::swap(&mut self.before, &mut self.after);
        self.arrive(placement);
        if !std::mem::replace(&mut self.placed, true) {
            self.before = self.after.clone();
        }
        let Self { mechanism, book, before, after, travel_m, .. } = self;
        for (i, travel_m) in travel_m.iter_mut().enumerate() {
            *travel_m = mechanism.travel_m(i, before, after);
        }
        let bodies = RefCell::new((f64::NAN, Vec::new()));
        let pose_at = |i: usize, fraction: f64| {
            let (at, poses) = &mut *bodies.borrow_mut();
            if *at != fraction {
                *at = fraction;
                mechanism.bodies(before, after, fraction, poses);
            }
            mechanism.pose(i, before, after, fraction, poses)
        };
        let (start_s, end_s) = (before.time_s, after.time_s);
        let motion = Motion { start_s, end_s, travel_m, pose_at: &pose_at, timed_within: true, may_go_on };
        book.follow(&motion, &self.held);
        self.held = held(book, &pose_at, &self.movable);
        for touch in &self.book.touches {
            self.contacts.note(touch, &self.parts);
        }
    }

    fn arrive(&mut self, placement: &Placement) {
        let Self { model, limbs, after, .. } = self;
        assert_eq!(placement.arm_rad.len(), limbs.arm.len(), "one angle per joint of the arm");
        after.time_s = placement.time_s;
        after.objects.clone_from(&self.before.objects);
        if let Some(poses) = placement.objects {
            assert_eq!(poses.len(), after.objects.len(), "one pose per object");
            for (place, (pose, moves)) in after.objects.iter_mut().zip(poses.iter().zip(&self.moving)) {
                if *moves {
                    *place = convert::pose(pose);
                }
            }
        }
        for (&dof, &angle) in limbs.arm.iter().zip(placement.arm_rad) {
            after.positions[dof] = angle;
        }
        if let Some((closed, open)) = self.finger_range {
            let opening = closed + placement.gripper.clamp(0.0, 1.0) * (open - closed);
            limbs.fingers.iter().for_each(|&dof| after.positions[dof] = opening);
        }
        follow_leaders(model, &limbs.working, &mut after.positions);
    }

    /// All contacts so far; they have no forces.
    pub fn contacts(&self) -> &[ContactEpisode] {
        &self.contacts.episodes
    }

    /// Smallest distances so far, from each part of the robot to each thing that it could hit.
    pub fn clearances(&self) -> &[Clearance] {
        &self.book.smallest
    }
}

/// The objects at which two fingers are, at the end of a motion.
fn held(book: &ProximityBook, pose_at: &dyn Fn(usize, f64) -> Pose, movable: &[bool]) -> Vec<usize> {
    let near = |a: usize, b: usize| {
        let (solid_a, solid_b) = (&book.solids[a], &book.solids[b]);
        let gap = Gap::between(&pose_at(a, 1.0), &*solid_a.shape, &pose_at(b, 1.0), &*solid_b.shape);
        gap.is_some_and(|gap| gap.distance_m <= HELD_GAP_M)
    };
    let of_object = |object: usize| (0..book.solids.len()).filter(move |&i| book.solids[i].owner == Owner::Object(object));
    let fingers = |object: usize| {
        let mut bodies: Vec<usize> = Vec::new();
        for (i, solid) in book.solids.iter().enumerate() {
            if let Owner::Robot { body, finger: true, .. } = solid.owner
                && !bodies.contains(&body)
                && of_object(object).any(|b| near(i, b))
            {
                bodies.push(body);
            }
        }
        bodies.len()
    };
    (0..movable.len()).filter(|&object| movable[object] && fingers(object) >= 2).collect()
}
