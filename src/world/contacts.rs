//! Keeps book of everything that touches, at every step.

use nalgebra::Point3;
use rapier3d_f64::prelude::{ContactPair, PhysicsWorld};

use super::convert;
use super::parts::{Owner, Parts};

/// All contacts of one pair of parts during a run.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactEpisode {
    /// A part of the robot, or an object (`left_hand`, `toy`).
    pub a: String,
    /// The other one (`block_1.near_post`).
    pub b: String,
    /// Whether the scene allows the pair to touch.
    pub allowed: bool,
    /// First time (s).
    pub first_time_s: f64,
    /// Last time (s).
    pub last_time_s: f64,
    /// Deepest penetration (m).
    pub max_depth_m: f64,
    /// Largest normal force (N).
    pub max_force_n: f64,
    /// When that was (s).
    pub max_force_time_s: f64,
    /// Where they touched then (m, world).
    pub point: Point3<f64>,
    pair: (usize, usize),
}

/// The book of contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactBook {
    /// One entry per pair that ever touched, in the order of first contact.
    pub episodes: Vec<ContactEpisode>,
    /// Bodies of the fingers that touch a movable object in this step, with the object.
    pub grips: Vec<(usize, usize)>,
}

impl ContactBook {
    /// Reads the contacts of the step that ended at `time_s`. `movable` tells which objects move.
    pub(super) fn record(&mut self, engine: &PhysicsWorld, parts: &Parts, movable: &[bool], time_s: f64) {
        self.grips.clear();
        let step = engine.integration_parameters.dt;
        for pair in engine.narrow_phase.contact_pairs() {
            let force = pair.total_impulse_magnitude() / step;
            let depth = pair.find_deepest_contact().map_or(f64::NEG_INFINITY, |(_, contact)| -contact.dist);
            if force <= 0.0 && depth < 0.0 {
                continue;
            }
            let part = |collider| engine.colliders.get(collider).and_then(|c| parts.of(c.user_data));
            let (Some(a), Some(b)) = (part(pair.collider1), part(pair.collider2)) else { continue };
            // The robot first, then what moves.
            let (a, b) = if rank(a.1.owner, movable) <= rank(b.1.owner, movable) { (a, b) } else { (b, a) };
            if let (Owner::Robot { body, finger: true, .. }, Owner::Object(object)) = (a.1.owner, b.1.owner)
                && movable[object]
            {
                self.grips.push((body, object));
            }
            let key = (a.0, b.0);
            let episode = match self.episodes.iter().position(|e| e.pair == key) {
                Some(index) => &mut self.episodes[index],
                None => {
                    self.episodes.push(ContactEpisode {
                        a: a.1.name.clone(),
                        b: b.1.name.clone(),
                        allowed: allowed(a.1.owner, b.1.owner, movable),
                        first_time_s: time_s,
                        last_time_s: time_s,
                        max_depth_m: 0.0,
                        max_force_n: 0.0,
                        max_force_time_s: time_s,
                        point: Point3::origin(),
                        pair: key,
                    });
                    let last = self.episodes.len() - 1;
                    &mut self.episodes[last]
                }
            };
            episode.last_time_s = time_s;
            episode.max_depth_m = episode.max_depth_m.max(depth.max(0.0));
            if force > episode.max_force_n {
                episode.max_force_n = force;
                episode.max_force_time_s = time_s;
                episode.point = place(engine, pair).unwrap_or(episode.point);
            }
        }
    }
}

/// The place of a pair's deepest contact (m, world).
fn place(engine: &PhysicsWorld, pair: &ContactPair) -> Option<Point3<f64>> {
    let (manifold, contact) = pair.find_deepest_contact()?;
    let collider = engine.colliders.get(pair.collider1)?;
    let in_collider = manifold.subshape_pos1().map_or(contact.local_p1, |shape| shape * contact.local_p1);
    Some(convert::point_back(collider.position() * in_collider))
}

fn rank(owner: Owner, movable: &[bool]) -> usize {
    match owner {
        Owner::Robot { .. } => 0,
        Owner::Object(index) if movable[index] => 1,
        Owner::Object(_) => 2,
    }
}

/// Movable objects may touch the gripper's fingers and lie on things; whether they may touch a particular object is a scenario's criterion.
fn allowed(a: Owner, b: Owner, movable: &[bool]) -> bool {
    match (a, b) {
        (Owner::Robot { finger, .. }, Owner::Object(object)) => finger && movable[object],
        (Owner::Object(_), Owner::Object(_)) => true,
        _ => false,
    }
}
