//! What the person does in each kind of run. They see the scene as people do, and act through a hand on the wrist.

use nalgebra::{Isometry3, Vector3};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::guide_path::GuidePath;
use super::{AppliedForce, Help};
use crate::math::{self, smooth_step};
use crate::world::{GraspState, Hand, HandSnapshot, HandWrench, HumanSettings, World};

/// Seconds in which a hand takes hold or lets go.
const TAKE_HOLD_S: f64 = 0.4;

/// Opening below which a gripper is seen to close, and how long the person then still holds on until the fingers grip (s).
const LOOKS_CLOSED: f64 = 0.8;
const LET_GO_DELAY_S: f64 = 1.0;

/// A person's part in a run.
pub(super) trait Person {
    /// What the hand does in the coming step.
    fn act(&mut self, world: &World, step_s: f64) -> HandWrench;

    /// What they remember from step to step; most do not.
    fn snapshot(&self) -> PersonSnapshot {
        PersonSnapshot::default()
    }

    /// Goes on from there.
    fn restore(&mut self, _from: &PersonSnapshot) {}
}

/// What a person remembers from step to step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct PersonSnapshot {
    since: Option<f64>,
    closed_since: Option<f64>,
    strength: f64,
    hand: HandSnapshot,
}

/// Nobody there.
pub(super) struct Nobody;

impl Person for Nobody {
    fn act(&mut self, _world: &World, _step_s: f64) -> HandWrench {
        HandWrench::default()
    }
}

/// Leads the arm along a way.
pub(super) struct Teacher {
    hand: Hand,
    path: GuidePath,
    force_max_n: f64,
    tool_from_grasp: Isometry3<f64>,
}

impl Teacher {
    pub(super) fn new(settings: &HumanSettings, path: GuidePath, world: &World) -> Self {
        let force_max_n = settings.teaching_force_max_n;
        Self { hand: Hand::new(settings.clone()), path, force_max_n, tool_from_grasp: world.tool_from_grasp() }
    }
}

impl Person for Teacher {
    fn act(&mut self, world: &World, step_s: f64) -> HandWrench {
        let point = self.path.at(world.time_s());
        let pose = point.pose * self.tool_from_grasp;
        let (place, omega) = (point.pose.translation.vector, point.angular_velocity);
        let linear_velocity = point.linear_velocity + omega.cross(&(pose.translation.vector - place));
        let wanted = GraspState { pose, linear_velocity, angular_velocity: omega };
        let gaze_error = place - world.tool_pose().translation.vector;
        self.hand.lead(step_s, &world.grasp_state(), &wanted, gaze_error, self.force_max_n)
    }
}

/// Brings the gripper over an object from when it comes near until it closes.
pub(super) struct Guide {
    hand: Hand,
    object: usize,
    reach_m: f64,
    force_max_n: f64,
    weight: [f64; 2],
    /// By how much this person misjudges where the object is (m).
    misjudged: Vector3<f64>,
    since: Option<f64>,
    closed_since: Option<f64>,
    strength: f64,
}

impl Guide {
    /// A person who differs a little from others, as `variation` draws.
    fn new(settings: &HumanSettings, object: usize, reach_m: f64, force_max_n: f64, weight: [f64; 2], variation: &mut ChaCha8Rng) -> Self {
        let mut draw = |spread: f64| spread * math::standard_normal(variation).clamp(-2.0, 2.0);
        let misjudged = Vector3::new(draw(settings.aim_spread_m), draw(settings.aim_spread_m), 0.0);
        let (strength, reach) = (1.0 + draw(settings.strength_spread), 1.0 + 0.5 * draw(settings.strength_spread));
        let settings = HumanSettings {
            helping_stiffness_n_per_m: settings.helping_stiffness_n_per_m * strength,
            helping_rate_n_per_ms: settings.helping_rate_n_per_ms * strength,
            ..settings.clone()
        };
        let reach_m = reach_m * reach;
        Self { hand: Hand::new(settings), object, reach_m, force_max_n, weight, misjudged, since: None, closed_since: None, strength: 0.0 }
    }
}

impl Person for Guide {
    fn act(&mut self, world: &World, step_s: f64) -> HandWrench {
        let away = world.object_pose(self.object).translation.vector + self.misjudged - world.tool_pose().translation.vector;
        let now = world.time_s();
        if self.since.is_none() && away.xy().norm() <= self.reach_m {
            self.since = Some(now);
        }
        if self.since.is_some() && self.closed_since.is_none() && world.gripper_opening() < LOOKS_CLOSED {
            self.closed_since = Some(now);
        }
        let done = self.closed_since.is_some_and(|closed| now >= closed + LET_GO_DELAY_S);
        let wanted = if self.since.is_some() && !done { 1.0 } else { 0.0 };
        self.strength += (wanted - self.strength).clamp(-step_s / TAKE_HOLD_S, step_s / TAKE_HOLD_S);
        if self.strength <= 0.0 {
            return HandWrench::default();
        }
        // Once the fingers close there is nothing left to correct: the hand only holds its place.
        let watching = self.closed_since.is_none();
        let gaze_error = if watching { Vector3::new(self.weight[0] * away.x, self.weight[1] * away.y, 0.0) } else { Vector3::zeros() };
        self.hand.help(step_s, &world.grasp_state(), gaze_error, smooth_step(self.strength, 0.0, 1.0), self.force_max_n)
    }

    fn snapshot(&self) -> PersonSnapshot {
        PersonSnapshot { since: self.since, closed_since: self.closed_since, strength: self.strength, hand: self.hand.snapshot() }
    }

    fn restore(&mut self, from: &PersonSnapshot) {
        (self.since, self.closed_since, self.strength) = (from.since, from.closed_since, from.strength);
        self.hand.restore(from.hand);
    }
}

/// Pushes with a given force in given windows of time.
pub(super) struct Pusher {
    force: Vector3<f64>,
    windows_s: Vec<[f64; 2]>,
}

impl Person for Pusher {
    fn act(&mut self, world: &World, _step_s: f64) -> HandWrench {
        let t = world.time_s();
        let strength = self
            .windows_s
            .iter()
            .map(|[from, to]| smooth_step(t, *from, from + TAKE_HOLD_S).min(smooth_step(t, *to, to - TAKE_HOLD_S)))
            .fold(0.0, f64::max);
        if strength <= 0.0 {
            return HandWrench::default();
        }
        let point = world.grasp_state().pose.translation.vector.into();
        HandWrench { point, force: self.force * strength, moment: Vector3::zeros() }
    }
}

/// The person of an execution; `seed` decides who it is. `objects` are the names of the scene's objects.
pub(super) fn helper(help: &Help, settings: &HumanSettings, objects: &[String], seed: u64) -> Box<dyn Person> {
    match help {
        Help::None => Box::new(Nobody),
        Help::Guide { object, reach_m, force_max_n, weight_xy } => match objects.iter().position(|name| name == object) {
            Some(index) => {
                let mut variation = math::stream(seed, "helper", 0);
                Box::new(Guide::new(settings, index, *reach_m, *force_max_n, *weight_xy, &mut variation))
            }
            None => Box::new(Nobody),
        },
        Help::Push { force_n, windows_s } => Box::new(Pusher { force: Vector3::from(*force_n), windows_s: windows_s.clone() }),
    }
}

/// The part of a hand's wrench that is drawn and recorded.
pub(super) fn applied(hand: &HandWrench) -> AppliedForce {
    AppliedForce { point: hand.point, force: hand.force }
}
