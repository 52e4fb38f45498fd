//! Where a run and its repetition part.

use std::fmt;

use crate::simulation::WorldTrace;
use crate::world::{QUANTITIES, StateTrace};

/// The first step at which a run and its repetition are known to differ.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayDifference {
    /// The phase of the world in which they part.
    pub phase: String,
    /// The world's number in it.
    pub number: u64,
    /// What differs there.
    pub what: DifferenceKind,
}

/// What differs.
#[derive(Clone, Debug, PartialEq)]
pub enum DifferenceKind {
    /// The worlds themselves: what each of the two has.
    World(String),
    /// States, found from hashes that are kept every few steps.
    Between {
        /// The last step up to which all hashes agree; `None` when there is none.
        equal_up_to: Option<u64>,
        /// The first step with another hash.
        step: u64,
        /// What differs at that step: body and quantity. Empty when a difference has come and gone since.
        parts: Vec<(String, &'static str)>,
    },
    /// Recorded hashes that contradict each other, so that no run can have left them.
    Edited {
        /// The first step with such hashes.
        step: u64,
        /// The body and quantity whose hash does not belong to the step's total; `None` when it is the total that does not belong to its bodies'.
        part: Option<(String, &'static str)>,
    },
    /// States, found from the states themselves.
    Exact {
        /// The first step that differs.
        step: u64,
        /// What differs most in it: the body.
        body: String,
        /// The quantity.
        quantity: &'static str,
        /// By how much, in `unit`.
        by: f64,
        /// Its unit.
        unit: &'static str,
        /// How many other bodies differ in that step.
        others: usize,
    },
}

/// Where `repeated` first leaves `recorded`, world by world in the order of the run; `None` when it never does.
pub fn first_difference(recorded: &[WorldTrace], repeated: &[WorldTrace]) -> Option<ReplayDifference> {
    let of = |world: &WorldTrace, what| Some(ReplayDifference { phase: world.phase.clone(), number: world.number, what });
    for (place, world) in recorded.iter().enumerate() {
        let Some(other) = repeated.get(place).filter(|other| (&other.phase, other.number) == (&world.phase, world.number)) else {
            return of(world, DifferenceKind::World("the repetition has no such world".to_owned()));
        };
        if let Some(what) = between(&world.trace, &other.trace) {
            return of(world, what);
        }
    }
    let more = repeated.get(recorded.len())?;
    of(more, DifferenceKind::World("only the repetition has such a world".to_owned()))
}

/// The first of the steps that both keep at which they differ.
fn between(recorded: &StateTrace, repeated: &StateTrace) -> Option<DifferenceKind> {
    if recorded.bodies != repeated.bodies {
        let names = |trace: &StateTrace| trace.bodies.join(", ");
        return Some(DifferenceKind::World(format!("recorded: {}; repeated: {}", names(recorded), names(repeated))));
    }
    let mut equal_up_to = None;
    for (index, &step) in recorded.steps.iter().enumerate() {
        let Ok(other) = repeated.steps.binary_search(&step) else { continue };
        let mut parts = parts(&recorded.bodies, recorded.quantities_at(index), repeated.quantities_at(other));
        let same_total = recorded.hashes[index] == repeated.hashes[other];
        if !same_total && parts.is_empty() && meet_after(step, recorded, repeated) {
            return Some(DifferenceKind::Edited { step, part: None });
        }
        if !same_total {
            return Some(DifferenceKind::Between { equal_up_to, step, parts });
        }
        if !parts.is_empty() {
            return Some(DifferenceKind::Edited { step, part: Some(parts.swap_remove(0)) });
        }
        equal_up_to = Some(step);
    }
    let last = |trace: &StateTrace| trace.steps.last().copied().unwrap_or(0);
    let lengths = (last(recorded), last(repeated));
    (lengths.0 != lengths.1).then(|| DifferenceKind::World(format!("recorded: {} steps; repeated: {} steps", lengths.0, lengths.1)))
}

/// Whether the totals of a later step agree. Each is one over all states up to its step: had the states ever differed, they never would again.
fn meet_after(step: u64, recorded: &StateTrace, repeated: &StateTrace) -> bool {
    recorded.steps.iter().zip(&recorded.hashes).filter(|(later, _)| **later > step).any(|(later, hash)| {
        let other = repeated.steps.binary_search(later);
        other.is_ok_and(|other| repeated.hashes[other] == *hash)
    })
}

fn parts(bodies: &[String], recorded: &[[u32; 4]], repeated: &[[u32; 4]]) -> Vec<(String, &'static str)> {
    let of = |(body, (a, b)): (&String, (&[u32; 4], &[u32; 4]))| {
        let differing = (0..4).filter(|&i| a[i] != b[i]).map(|i| (body.clone(), QUANTITIES[i].name));
        differing.collect::<Vec<_>>()
    };
    bodies.iter().zip(recorded.iter().zip(repeated)).flat_map(of).collect()
}

/// The first step whose states differ, among those that both traces hold whole.
pub fn exact_difference(recorded: &StateTrace, repeated: &StateTrace) -> Option<DifferenceKind> {
    for ((step, ours), (_, theirs)) in recorded.states.iter().zip(&repeated.states) {
        let mut largest: Option<(f64, usize, usize)> = None;
        let mut bodies = 0;
        for (body, (a, b)) in ours.iter().zip(theirs).enumerate() {
            let differs = |i: &usize| a[*i].to_bits() != b[*i].to_bits();
            bodies += usize::from((0..13).any(|i| differs(&i)));
            for (index, quantum) in QUANTITIES.iter().enumerate().filter(|(_, quantum)| quantum.place.clone().any(|i| differs(&i))) {
                let by = quantum.place.clone().map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
                if largest.is_none_or(|(most, ..)| by > most) {
                    largest = Some((by, body, index));
                }
            }
        }
        if let Some((by, body, index)) = largest {
            let Some(name) = recorded.bodies.get(body).cloned() else { continue };
            let quantum = &QUANTITIES[index];
            let (quantity, unit) = (quantum.name, quantum.unit);
            return Some(DifferenceKind::Exact { step: *step, body: name, quantity, by, unit, others: bodies - 1 });
        }
    }
    None
}

impl fmt::Display for ReplayDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}: ", self.phase, self.number + 1)?;
        match &self.what {
            DifferenceKind::World(what) => f.write_str(what),
            DifferenceKind::Exact { step, body, quantity, by, unit, others } => {
                let unit = if *unit == "1" { String::new() } else { format!(" {unit}") };
                let more = if *others == 0 { String::new() } else { format!(", and {others} other bodies differ too") };
                write!(f, "first differs in step {step}: the {quantity} of `{body}` by {by:.3e}{unit}{more}")
            }
            DifferenceKind::Edited { step, part: None } => {
                write!(f, "the file's total of step {step} does not belong to its bodies' hashes, all of which are repeated: edited?")
            }
            DifferenceKind::Edited { step, part: Some((body, quantity)) } => {
                write!(
                    f,
                    "the file's hash of the {quantity} of `{body}` in step {step} does not belong to its total, which is repeated: edited?"
                )
            }
            DifferenceKind::Between { equal_up_to, step, parts } => {
                match equal_up_to {
                    Some(equal) => write!(f, "first differs in a step after {equal}, up to {step}")?,
                    None => write!(f, "first differs in step {step} or before")?,
                }
                match parts.first() {
                    None => write!(f, "; at {step} itself all states are equal again"),
                    Some((body, quantity)) => {
                        let more = if parts.len() == 1 { String::new() } else { format!(" and {} others", parts.len() - 1) };
                        write!(f, "; at {step} the {quantity} of `{body}`{more} differ")
                    }
                }
            }
        }
    }
}
