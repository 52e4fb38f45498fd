//! What is kept of a world's states so that two runs can be compared: hashes every few steps, whole states where somebody looks closer.

use std::ops::{Range, RangeInclusive};

use rapier3d_f64::prelude::{RigidBody, RigidBodyHandle};
use twox_hash::XxHash3_64;

use super::World;

/// A body's state: position (m), orientation (quaternion, scalar last), linear velocity (m/s), angular velocity (rad/s); world frame.
pub type BodyState = [f64; 13];

/// One quantity of a body's state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantum {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its numbers in a [`BodyState`].
    pub place: Range<usize>,
}

/// The quantities of a body's state, in the order of their hashes.
pub const QUANTITIES: [Quantum; 4] = [
    Quantum { name: "position", unit: "m", place: 0..3 },
    Quantum { name: "orientation", unit: "1", place: 3..7 },
    Quantum { name: "linear velocity", unit: "m/s", place: 7..10 },
    Quantum { name: "angular velocity", unit: "rad/s", place: 10..13 },
];

/// What is kept of the states of one world, or of another series of numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StateTrace {
    /// Names of the moving bodies.
    pub bodies: Vec<String>,
    /// The steps of which hashes are kept, rising.
    pub steps: Vec<u64>,
    /// For each of them the hash over all states up to it.
    pub hashes: Vec<u64>,
    /// For each of them, body by body, the hash of each of the [`QUANTITIES`] at that step.
    pub quantities: Vec<[u32; 4]>,
    /// Whole states, body by body, of the steps that somebody asked for.
    pub states: Vec<(u64, Vec<BodyState>)>,
}

impl StateTrace {
    /// The trace of a series that is no world: the hash of every `every`-th point and of the last one. Its points stand for positions.
    pub fn of_series<'a>(name: &str, points: impl ExactSizeIterator<Item = &'a [f64]>, every: u64) -> Self {
        let mut trace = Self { bodies: vec![name.to_owned()], ..Self::default() };
        let mut hasher = XxHash3_64::with_seed(0);
        let last = points.len().saturating_sub(1) as u64;
        for (step, point) in (0..).zip(points) {
            point.iter().for_each(|number| std::hash::Hasher::write_u64(&mut hasher, number.to_bits()));
            if step % every == 0 || step == last {
                trace.push(step, std::hash::Hasher::finish(&hasher), std::iter::once([hash(point), 0, 0, 0]));
            }
        }
        trace
    }

    /// The part of the trace that comes after `step`, each hash over the states of its own step alone: what is left to compare of a run that was
    /// taken up there.
    pub fn after(&self, step: u64) -> Self {
        let mut rest = Self { bodies: self.bodies.clone(), states: self.states.clone(), ..Self::default() };
        for (index, &kept) in self.steps.iter().enumerate().filter(|(_, kept)| **kept > step) {
            let quantities = self.quantities_at(index);
            let bytes: Vec<u8> = quantities.iter().flatten().flat_map(|part| part.to_le_bytes()).collect();
            rest.push(kept, XxHash3_64::oneshot(&bytes), quantities.iter().copied());
        }
        rest
    }

    /// The hashes of the quantities at the `index`-th of the steps, body by body.
    pub fn quantities_at(&self, index: usize) -> &[[u32; 4]] {
        let bodies = self.bodies.len();
        self.quantities.get(index * bodies..(index + 1) * bodies).unwrap_or_default()
    }

    /// Adds the hashes of one step.
    pub fn push(&mut self, step: u64, hash: u64, quantities: impl Iterator<Item = [u32; 4]>) {
        self.steps.push(step);
        self.hashes.push(hash);
        self.quantities.extend(quantities);
    }
}

/// Keeps the trace of a world while it runs.
pub(super) struct Tracer {
    every: u64,
    detail: Option<RangeInclusive<u64>>,
    moving: Vec<RigidBodyHandle>,
    trace: StateTrace,
}

impl World {
    /// Keeps hashes of every `every`-th step (none for 0) and whole states of the steps of `detail`, in a run of `steps` steps.
    pub fn trace(&mut self, every: u64, detail: Option<RangeInclusive<u64>>, steps: u64) {
        if every == 0 {
            return;
        }
        let moving: Vec<RigidBodyHandle> =
            self.engine.bodies.iter().filter(|(_, body)| body.is_dynamic()).map(|(handle, _)| handle).collect();
        let bodies: Vec<String> = moving.iter().enumerate().map(|(index, handle)| self.name_of(*handle, index)).collect();
        let kept = (steps / every) as usize + 2;
        let trace = StateTrace {
            steps: Vec::with_capacity(kept),
            hashes: Vec::with_capacity(kept),
            quantities: Vec::with_capacity(kept * bodies.len()),
            bodies,
            states: Vec::new(),
        };
        self.tracer = Some(Tracer { every, detail, moving, trace });
    }

    /// Ends the trace, with the last step in it.
    pub fn take_trace(&mut self) -> StateTrace {
        let Some(mut tracer) = self.tracer.take() else { return StateTrace::default() };
        if tracer.trace.steps.last() != Some(&self.step) {
            tracer.keep(self);
        }
        tracer.trace
    }

    /// Keeps what is to be kept of the step that was just made.
    pub(super) fn record_trace(&mut self) {
        let Some(mut tracer) = self.tracer.take() else { return };
        if self.step.is_multiple_of(tracer.every) {
            tracer.keep(self);
        }
        if tracer.detail.as_ref().is_some_and(|range| range.contains(&self.step)) {
            let states = tracer.states(self).collect();
            tracer.trace.states.push((self.step, states));
        }
        self.tracer = Some(tracer);
    }

    /// What reports call a body: its first part that can be touched.
    fn name_of(&self, handle: RigidBodyHandle, index: usize) -> String {
        let colliders = self.engine.bodies.get(handle).map_or(&[][..], RigidBody::colliders);
        let part = colliders.iter().find_map(|collider| self.parts.of(self.engine.colliders.get(*collider)?.user_data));
        part.map_or_else(|| format!("moving body {index}"), |(_, part)| part.name.clone())
    }
}

impl Tracer {
    fn states<'a>(&'a self, world: &'a World) -> impl Iterator<Item = BodyState> + 'a {
        self.moving.iter().map(|handle| world.engine.bodies.get(*handle).map_or([f64::NAN; 13], state_of))
    }

    fn keep(&mut self, world: &World) {
        self.trace.steps.push(world.step);
        self.trace.hashes.push(world.state_hash());
        for handle in &self.moving {
            let state = world.engine.bodies.get(*handle).map_or([f64::NAN; 13], state_of);
            self.trace.quantities.push(QUANTITIES.map(|quantum| hash(&state[quantum.place])));
        }
    }
}

/// Pose and velocity of a body as plain numbers.
pub(super) fn state_of(body: &RigidBody) -> BodyState {
    let (p, r, v, w) = (body.translation(), body.rotation(), body.linvel(), body.angvel());
    [p.x, p.y, p.z, r.x, r.y, r.z, r.w, v.x, v.y, v.z, w.x, w.y, w.z]
}

/// The lower half of the hash over the bits of some numbers, without allocation.
fn hash(numbers: &[f64]) -> u32 {
    let mut bytes = [0; 32];
    for (place, number) in bytes.chunks_exact_mut(8).zip(numbers) {
        place.copy_from_slice(&number.to_bits().to_le_bytes());
    }
    XxHash3_64::oneshot(&bytes[..8 * numbers.len().min(4)]) as u32
}
