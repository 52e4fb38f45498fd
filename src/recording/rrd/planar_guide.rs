//! A page in the recording that says how to read it.

use rerun::TextDocument;

use super::planar_entity::{ENTITIES, GUIDE, PHASE_INPUT};
use super::planar_recorder::PlanarRecorder;
use super::recorder::Fault;
use crate::planar::{Case, PlanarOutcome, Transitions, obstacles};

/// Logs the page.
pub(super) fn log_guide(recorder: &PlanarRecorder, name: &str, seed: u64, outcome: &PlanarOutcome) -> Result<(), Fault> {
    let told = format!("This is `{name}`, seed {seed}; {} demonstrations.", outcome.demonstrations.len());
    let mut page = format!("{}{READING}\n\n{told}\n\n", widths(outcome));
    page.push_str("## Clearances\n\n");
    page.extend(outcome.cases.iter().map(clearances));
    page.extend(outcome.transitions.iter().map(shares));
    page.push_str(&format!("\n## Timeline\n\n- `{}`: {}\n\n## Entities\n\n", PHASE_INPUT.name, PHASE_INPUT.meaning));
    page.extend(ENTITIES.iter().map(|entity| format!("- `{}`: {}\n", entity.pattern, entity.meaning)));
    recorder.always(GUIDE.path(), &TextDocument::from_markdown(page))
}

/// Which obstacle has which colour, where there are several.
fn widths(outcome: &PlanarOutcome) -> String {
    let named = obstacles(&outcome.cases).iter().filter_map(|one| Some(format!("{}: {}", one.look?.1, one.name()))).collect::<Vec<_>>();
    if named.is_empty() { String::new() } else { format!("Obstacles and what passes them: {}.\n\n", named.join("; ")) }
}

/// What every method makes of a situation, in a line.
fn clearances(case: &Case) -> String {
    let each: Vec<String> = case
        .movements
        .iter()
        .map(|movement| {
            let hit = if movement.collides { ", collides" } else { "" };
            format!("{} {:.2} m{hit}", movement.method.title(), movement.clearance_m)
        })
        .collect();
    let told = if case.taught { "taught" } else { "unseen" };
    format!("- `{}` ({}, {told}): {}\n", case.name, case.guidance.key().replace('_', " "), each.join("; "))
}

/// How often each transition of the graph is taken.
fn shares(transitions: &Transitions) -> String {
    let edges = transitions.graph.edges.iter().map(|edge| format!("{} to {}: {:.2}", edge.from, edge.to, edge.probability));
    format!("\n## Shares of departures in the transition graph\n\n{}\n", edges.collect::<Vec<_>>().join("; "))
}

const READING: &str = "\
Grey paths: a person showed how to pass an elliptic obstacle. Coloured paths: what each method made of it, thin for situations that were
demonstrated, thick for others. Movements should end at the dark points, which were taught, and the yellow ones, which were not. A large vermilion
point is a collision, at the deepest point. Dots move along the paths with the cursor over the phase. Lines of the grid are 1 m apart.

Plots show forcing terms over the phase: grey what the demonstrations ask for (4), light lines what the model makes of taught situations,
magenta what it makes of others; each chain has a colour of its own, and each width a page, or demonstrated and
new situations one each. Ellipses are the states of the model at two standard deviations.";
