//! The traces of a planar experiment: every path, likelihood and forcing term as a series that can be compared.

use crate::planar::PlanarOutcome;
use crate::simulation::WorldTrace;
use crate::world::StateTrace;

/// The traces of a planar experiment, with the hash of every `every`-th number or point.
pub fn planar_traces(outcome: &PlanarOutcome, every: u64) -> Vec<WorldTrace> {
    if every == 0 {
        return Vec::new();
    }
    let mut traces: Vec<WorldTrace> = Vec::new();
    let mut add = |phase: &str, name: &str, points: &[&[f64]]| {
        // A model without iterations has no likelihoods.
        if points.is_empty() {
            return;
        }
        let number = traces.iter().filter(|world| world.phase == phase).count() as u64;
        let trace = StateTrace::of_series(name, points.iter().copied(), every);
        traces.push(WorldTrace { phase: phase.to_owned(), number, trace });
    };
    for shown in &outcome.demonstrations {
        add("show", &shown.name, &shown.path_m.iter().map(<[f64; 2]>::as_slice).collect::<Vec<_>>());
    }
    for model in &outcome.models {
        add("learn", model.method.key(), &model.log_likelihood.chunks(1).collect::<Vec<_>>());
    }
    for case in &outcome.cases {
        for movement in &case.movements {
            let name = format!("{}, {}", movement.method.key(), case.name);
            add("move", &name, &movement.path_m.iter().map(<[f64; 2]>::as_slice).collect::<Vec<_>>());
        }
    }
    traces
}
