//! Smallest distances and touches of everything that can move and everything it could hit, also between steps.
//!
//! Touches are watched of every pair in which one can move against the other: the robot and each object, objects that move and each other
//! object, the arms and each other and the torso. Distances are told of the robot and what it holds. Left out are links of one limb against
//! each other, links that overlap by construction, and parts of one object.
//!
//! Every pair of parts carries a distance that it is proven to have at least; motion uses it up, and only when it no longer proves that
//! nothing new can have happened is the geometry asked again. So most pairs cost a subtraction per step.

use nalgebra::Point3;
use rapier3d_f64::prelude::{Pose, SharedShape};

use super::convert;
use super::gap::Gap;
use super::parts::{Limb, Owner};
use super::passage::{Moment, Passage, RESOLUTION_M, least_between, tolerance_m};

/// The smallest distance so far between a part of the robot and an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// The part of the robot, or what it holds.
    pub a: String,
    /// The object, or a part of the robot that does not belong to the arm.
    pub b: String,
    /// The distance; 0 when touching (m). Infinite before the first measurement.
    pub min_distance_m: f64,
    /// When (s).
    pub time_s: f64,
    /// Nearest point on `a` (m, world).
    pub point_a: Point3<f64>,
    /// Nearest point on `b` (m, world).
    pub point_b: Point3<f64>,
}

/// The smallest distance to each thing that was not touched.
#[must_use]
pub fn nearest_of_each(clearances: &[Clearance]) -> Vec<&Clearance> {
    let mut nearest: Vec<&Clearance> = Vec::new();
    for clearance in clearances {
        match nearest.iter_mut().find(|known| known.b == clearance.b) {
            Some(known) if known.min_distance_m <= clearance.min_distance_m => {}
            Some(known) => *known = clearance,
            None => nearest.push(clearance),
        }
    }
    nearest.retain(|clearance| clearance.min_distance_m > 0.0 && clearance.min_distance_m.is_finite());
    nearest
}

/// A part with its shape.
#[derive(Clone)]
pub(super) struct Watched {
    /// Its number among the parts.
    pub part: usize,
    /// Whose part it is.
    pub owner: Owner,
    /// What its distances are called after: the link or the object.
    pub name: String,
    /// Its shape.
    pub shape: SharedShape,
}

/// A touch of two parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// The parts.
    pub parts: (usize, usize),
    pub time_s: f64,
    pub gap: Gap,
}

/// How solids move from one moment to the next.
pub(super) struct Motion<'a> {
    pub start_s: f64,
    pub end_s: f64,
    /// The longest path of a point of each solid (m).
    pub travel_m: &'a [f64],
    /// `world_from_solid` at a fraction of the motion.
    pub pose_at: &'a dyn Fn(usize, f64) -> Pose,
    /// Whether touches that begin or end within the motion are timed within it. Otherwise a touch counts from the step at whose end it is, and
    /// only parts that pass through each other between two steps are looked for.
    pub timed_within: bool,
    /// Whether it may be looked at any longer; once not, nothing that is found counts.
    pub may_go_on: &'a dyn Fn() -> bool,
}

struct Pair {
    a: usize,
    b: usize,
    /// Whether its distance is told, too.
    distance: Told,
    /// Whether the same pair is watched the other way round, and that one tells of its touches.
    is_mirror: bool,
    /// Its place in the list of clearances.
    entry: usize,
    /// A distance that the pair has at least (m).
    proven_m: f64,
    /// The deepest so far, negative (m); 0 before the first touch.
    deepest_m: f64,
}

/// When the distance of a pair is told, besides its touches.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Told {
    Always,
    /// While the gripper holds this object.
    WhileHeld(usize),
}

/// Watches distances and touches.
pub(super) struct ProximityBook {
    /// One entry per part of the robot or object and thing that it could hit.
    pub smallest: Vec<Clearance>,
    /// The touches of the last motion.
    pub touches: Vec<Touch>,
    /// What is watched.
    pub solids: Vec<Watched>,
    pairs: Vec<Pair>,
}

impl ProximityBook {
    /// Watches `solids`: `moving` says which objects can move, `meets` whether two solids may touch at all.
    pub(super) fn new(solids: Vec<Watched>, moving: &[bool], meets: impl Fn(usize, usize) -> bool) -> Self {
        let mut book = Self { smallest: Vec::new(), touches: Vec::new(), solids, pairs: Vec::new() };
        for a in 0..book.solids.len() {
            for b in 0..book.solids.len() {
                let (owner_a, owner_b) = (book.solids[a].owner, book.solids[b].owner);
                let Some(distance) = watched(owner_a, owner_b, moving).filter(|_| meets(a, b)) else { continue };
                let entry = book.entry(a, b);
                let is_mirror = a > b && watched(owner_b, owner_a, moving).is_some();
                book.pairs.push(Pair { a, b, distance, is_mirror, entry, proven_m: f64::NEG_INFINITY, deepest_m: 0.0 });
            }
        }
        book
    }

    fn entry(&mut self, a: usize, b: usize) -> usize {
        let (a, b) = (&self.solids[a].name, &self.solids[b].name);
        if let Some(place) = self.smallest.iter().position(|known| &known.a == a && &known.b == b) {
            return place;
        }
        let (point_a, point_b) = (Point3::origin(), Point3::origin());
        self.smallest.push(Clearance { a: a.clone(), b: b.clone(), min_distance_m: f64::INFINITY, time_s: 0.0, point_a, point_b });
        self.smallest.len() - 1
    }

    /// Follows a motion that begins where the last one ended. `held` are the objects in the gripper.
    pub(super) fn follow(&mut self, motion: &Motion, held: &[usize]) {
        self.touches.clear();
        let Self { smallest, touches, solids, pairs } = self;
        for pair in pairs {
            let before_m = pair.proven_m;
            let travel_m = motion.travel_m[pair.a] + motion.travel_m[pair.b];
            pair.proven_m -= travel_m;
            let tells = pair.distance.applies(held);
            if pair.is_mirror && !tells {
                continue;
            }
            let entry = &mut smallest[pair.entry];
            // Of no interest unless it is nearer, where only touches are told.
            let known_m = if tells { entry.min_distance_m } else { 0.0 };
            if pair.proven_m > 0.0 && pair.proven_m >= known_m - tolerance_m(known_m) {
                continue;
            }
            // What touches at the end of a step is the engine's to tell, and so little cannot hide a passage: things at rest cost nothing.
            if !tells && !motion.timed_within && travel_m <= RESOLUTION_M {
                continue;
            }
            let gap_at = |fraction: f64| {
                if !(motion.may_go_on)() {
                    return None;
                }
                let (a, b) = (pair.a, pair.b);
                let (at_a, at_b) = ((motion.pose_at)(a, fraction), (motion.pose_at)(b, fraction));
                Gap::between(&at_a, &*solids[a].shape, &at_b, &*solids[b].shape)
            };
            let Some(end) = gap_at(1.0) else { continue };
            pair.proven_m = end.distance_m;
            let floor_m = if known_m > 0.0 { known_m } else { pair.deepest_m };
            let mut passage = Passage { gap_at, travel_m, floor_m, least: None, touch: None };
            let least_m = least_between(before_m, end.distance_m, travel_m);
            // The exact start is only asked for when what is known of it leaves something to find.
            let may_pass = motion.timed_within || end.distance_m > 0.0;
            let hides = least_m <= 0.0 || least_m < floor_m - tolerance_m(floor_m);
            let start = if may_pass && hides { (passage.gap_at)(0.0) } else { None };
            match start {
                Some(start) if motion.timed_within || start.distance_m > 0.0 => passage.search(start, end),
                _ => passage.arrive(end),
            }
            let parts = (solids[pair.a].part, solids[pair.b].part);
            note_touches(&passage, motion, parts, touches);
            if let Some(least) = passage.least {
                pair.deepest_m = pair.deepest_m.min(least.gap.distance_m);
                if tells {
                    note_distance(&least, motion, entry);
                }
            }
        }
    }
}

impl Told {
    fn applies(self, held: &[usize]) -> bool {
        match self {
            Self::Always => true,
            Self::WhileHeld(object) => held.contains(&object),
        }
    }
}

impl Motion<'_> {
    fn time_s(&self, fraction: f64) -> f64 {
        self.start_s + fraction * (self.end_s - self.start_s)
    }
}

/// Notes how the pair touched: first, last and deepest.
fn note_touches(passage: &Passage<impl Fn(f64) -> Option<Gap>>, motion: &Motion, parts: (usize, usize), touches: &mut Vec<Touch>) {
    let Some((first, last)) = passage.touch else { return };
    let touch = |fraction: f64, gap: Gap| Touch { parts, time_s: motion.time_s(fraction), gap };
    touches.extend((passage.gap_at)(first).map(|gap| touch(first, gap)));
    if last > first {
        touches.extend((passage.gap_at)(last).map(|gap| touch(last, gap)));
    }
    touches.extend(passage.least.map(|least| touch(least.fraction, least.gap)));
}

fn note_distance(least: &Moment, motion: &Motion, entry: &mut Clearance) {
    let distance_m = least.gap.distance_m.max(0.0);
    if distance_m < entry.min_distance_m {
        entry.min_distance_m = distance_m;
        entry.time_s = motion.time_s(least.fraction);
        entry.point_a = convert::point_back(least.gap.point_a);
        entry.point_b = convert::point_back(least.gap.point_b);
    }
}

/// Whether `a` is watched against `b`, the robot before objects and the working arm first, and whether their distance is told.
fn watched(a: Owner, b: Owner, moving: &[bool]) -> Option<Told> {
    match (a, b) {
        (Owner::Robot { limb: Limb::Working, .. }, Owner::Robot { limb, .. }) => (limb != Limb::Working).then_some(Told::Always),
        (Owner::Robot { limb: Limb::Idle, .. }, Owner::Robot { limb: Limb::Fixed, .. }) => Some(Told::Always),
        // An arm that holds still is watched too: it gives way a little, and a blow moves it.
        (Owner::Robot { limb: Limb::Working | Limb::Idle, .. }, Owner::Object(_)) => Some(Told::Always),
        (Owner::Robot { limb: Limb::Fixed, .. }, Owner::Object(object)) if moving[object] => Some(Told::Always),
        (Owner::Object(a), Owner::Object(b)) => (a != b && moving[a]).then_some(Told::WhileHeld(a)),
        _ => None,
    }
}
