//! Keeps book of everything that touches, at every step.

use nalgebra::{Point3, Vector3};
use rapier3d_f64::prelude::{ColliderHandle, PhysicsWorld};

use super::contact_impulse::{impulse_on_second, normal_impulse};
use super::convert;
use super::gap::Gap;
use super::parts::{Owner, Part, Parts};
use super::proximity::Touch;
use super::recent_touches::RecentTouches;

/// All contacts of one pair of parts during a run.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactEpisode {
    /// A part of the robot, or an object (`left_hand`, `toy`).
    pub a: String,
    /// The other one (`block_1.near_post`).
    pub b: String,
    /// Whether the scene allows the pair to touch.
    pub allowed: bool,
    /// Why, if it is allowed.
    pub permission: Option<Permission>,
    /// First time (s).
    pub first_time_s: f64,
    /// Last time (s).
    pub last_time_s: f64,
    /// Deepest penetration (m).
    pub max_depth_m: f64,
    /// When it was deepest (s), and where (m, world): the middle of the two deepest points.
    pub deepest_time_s: f64,
    /// Where (m, world).
    pub deepest_point: Point3<f64>,
    /// Largest normal force (N); NaN when nothing was simulated, and of a touch that the engine did not see because it began and ended
    /// within a step.
    pub max_force_n: f64,
    /// The smallest distance so far, negative inside (m).
    least_m: f64,
    pair: (usize, usize),
}

/// Why a pair may touch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Permission {
    /// Fingers are there to grasp this movable object or handle.
    Grasp(String),
    /// Objects lie on, in and against each other.
    Objects,
    /// The scenario says so, in its entry of this name.
    Scenario(String),
}

/// The book of contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactBook {
    /// One entry per pair that ever touched, in the order of first contact.
    pub episodes: Vec<ContactEpisode>,
    /// Bodies of the fingers that touch a movable object in this step, with the object.
    pub grips: Vec<(usize, usize)>,
    /// Force by the objects on fingers and tool in this step, normal to the surfaces that touch and along them (N, world).
    pub tool_force: Vector3<f64>,
    /// What touched since the last record of a run.
    pub recent: RecentTouches,
}

impl ContactBook {
    /// Reads the contacts of the step that ended at `time_s`. `movable` tells which objects move.
    pub(super) fn record(&mut self, engine: &PhysicsWorld, parts: &Parts, movable: &[bool], time_s: f64) {
        self.grips.clear();
        self.tool_force = Vector3::zeros();
        let step = engine.integration_parameters.dt;
        for pair in engine.narrow_phase.contact_pairs() {
            let force = normal_impulse(pair) / step;
            let near = pair.find_deepest_contact().is_some_and(|(_, contact)| contact.dist <= 0.0);
            if force <= 0.0 && !near {
                continue;
            }
            let part = |collider| engine.colliders.get(collider).and_then(|c| parts.of(c.user_data));
            let (Some(a), Some(b)) = (part(pair.collider1), part(pair.collider2)) else { continue };
            // The robot first, then what moves.
            let ordered = rank(a.1.owner, movable) <= rank(b.1.owner, movable);
            let (a, b) = if ordered { (a, b) } else { (b, a) };
            let (first, second) = if ordered { (pair.collider1, pair.collider2) } else { (pair.collider2, pair.collider1) };
            if let (Owner::Robot { body, finger: true, .. }, Owner::Object(object)) = (a.1.owner, b.1.owner)
                && movable[object]
            {
                self.grips.push((body, object));
            }
            if let (Owner::Robot { finger: true, .. }, Owner::Object(_)) = (a.1.owner, b.1.owner) {
                let on_second = impulse_on_second(pair) / step;
                self.tool_force += if ordered { -on_second } else { on_second };
            }
            // The engine's contacts are those of the step's start: where the parts are now is asked of their shapes.
            let gap = colliders_gap(engine, first, second);
            let index = self.episode((a.0, b.0), parts, time_s);
            let episode = &mut self.episodes[index];
            episode.last_time_s = time_s;
            episode.max_force_n = episode.max_force_n.max(force);
            if let Some(gap) = gap {
                episode.deepen(time_s, &gap);
                self.recent.note(index, &gap, force);
            }
        }
    }

    /// Notes a touch that the shapes tell.
    pub(super) fn note(&mut self, touch: &Touch, parts: &Parts) {
        let index = self.episode(touch.parts, parts, touch.time_s);
        let episode = &mut self.episodes[index];
        episode.first_time_s = episode.first_time_s.min(touch.time_s);
        episode.last_time_s = episode.last_time_s.max(touch.time_s);
        episode.deepen(touch.time_s, &touch.gap);
        self.recent.note(index, &touch.gap, f64::NAN);
    }

    /// Number of the episode of a pair, the robot's part first, then what moves. Two parts of equal rank are told in either order, and are one pair.
    fn episode(&mut self, pair: (usize, usize), parts: &Parts, time_s: f64) -> usize {
        let same = |known: (usize, usize)| known == pair || known == (pair.1, pair.0);
        self.episodes.iter().position(|episode| same(episode.pair)).unwrap_or_else(|| {
            let (a, b) = (parts.get(pair.0), parts.get(pair.1));
            let permission = permission(a, b);
            self.episodes.push(ContactEpisode {
                a: a.name.clone(),
                b: b.name.clone(),
                allowed: permission.is_some(),
                permission,
                first_time_s: time_s,
                last_time_s: time_s,
                max_depth_m: 0.0,
                deepest_time_s: time_s,
                deepest_point: Point3::origin(),
                max_force_n: f64::NAN,
                least_m: f64::INFINITY,
                pair,
            });
            self.episodes.len() - 1
        })
    }
}

impl ContactEpisode {
    /// Where a hard contact keeps parts a hair apart, the nearest moment stands for the deepest.
    fn deepen(&mut self, time_s: f64, gap: &Gap) {
        if gap.distance_m < self.least_m {
            self.least_m = gap.distance_m;
            self.max_depth_m = gap.depth_m();
            self.deepest_time_s = time_s;
            self.deepest_point = convert::point_back(gap.middle());
        }
    }
}

fn colliders_gap(engine: &PhysicsWorld, a: ColliderHandle, b: ColliderHandle) -> Option<Gap> {
    let (a, b) = (engine.colliders.get(a)?, engine.colliders.get(b)?);
    Gap::between(a.position(), a.shape(), b.position(), b.shape())
}

fn rank(owner: Owner, movable: &[bool]) -> usize {
    match owner {
        Owner::Robot { .. } => 0,
        Owner::Object(index) if movable[index] => 1,
        Owner::Object(_) => 2,
    }
}

/// Fingers may touch what is there to be held, and objects lie on things; whether they may touch a particular object is a scenario's criterion.
fn permission(a: &Part, b: &Part) -> Option<Permission> {
    match (a.owner, b.owner) {
        (Owner::Robot { finger: true, .. }, Owner::Object(_)) if b.handle => Some(Permission::Grasp(b.name.clone())),
        (Owner::Object(_), Owner::Object(_)) => Some(Permission::Objects),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::Vector;

    use super::super::parts::Limb;
    use super::*;

    #[test]
    fn a_pair_is_one_pair_in_either_order() {
        let mut parts = Parts::default();
        for (body, name) in ["torso", "left_lower_forearm"].into_iter().enumerate() {
            let owner = Owner::Robot { body, finger: false, limb: if body == 0 { Limb::Fixed } else { Limb::Working } };
            parts.add(Part { name: name.to_owned(), owner, handle: false });
        }
        let touch =
            |parts, time_s, distance_m| Touch { parts, time_s, gap: Gap { distance_m, point_a: Vector::ZERO, point_b: Vector::ZERO } };
        let mut book = ContactBook::default();
        book.note(&touch((0, 1), 1.0, -0.001), &parts);
        book.note(&touch((1, 0), 0.5, -0.002), &parts);
        let [episode] = &book.episodes[..] else { panic!("{} pairs", book.episodes.len()) };
        assert_eq!((episode.first_time_s, episode.last_time_s, episode.max_depth_m), (0.5, 1.0, 0.002));
        assert!(episode.max_force_n.is_nan(), "shapes tell no force");
    }
}
