//! Pages in the recording of a planar experiment: how it ended, the clearance of every movement, how to read what is shown, and what is in it.

use rerun::TextDocument;

use super::entity_path::Entity;
use super::planar_entity::{CLEARANCES, CONTENTS, ENTITIES, GRAPH, GUIDE, PHASE_INPUT, RESULT};
use super::planar_reading::reading;
use super::planar_recorder::PlanarRecorder;
use super::recorder::Fault;
use crate::planar::{Case, Movement, PlanarOutcome, Transitions};

/// Logs the pages; `result` says how the experiment ended, its first line what it is called.
pub(super) fn log_guide(recorder: &PlanarRecorder, outcome: &PlanarOutcome, result: &str) -> Result<(), Fault> {
    let page = |entity: &Entity, words: String| recorder.always(entity.path(), &TextDocument::from_markdown(words));
    page(&RESULT, ending(outcome, result))?;
    page(&CLEARANCES, clearances(outcome))?;
    page(&GUIDE, reading(outcome))?;
    page(&CONTENTS, contents(outcome))
}

/// How the experiment ended, and what collides.
fn ending(outcome: &PlanarOutcome, result: &str) -> String {
    let (headline, answers) = result.split_once('\n').unwrap_or((result, ""));
    let collisions: Vec<String> = outcome.cases.iter().filter_map(collisions).collect();
    let collide = if collisions.is_empty() { "none".to_owned() } else { collisions.join("; ") };
    let (headline, answers, collide) = (literal(headline), literal(answers).replace('\n', "  \n"), literal(&collide));
    format!("**{headline}**; {} demonstrations\n\n{answers}\n\nCollisions: {collide}\n", outcome.demonstrations.len())
}

/// Which movements collide in a situation.
fn collisions(case: &Case) -> Option<String> {
    let colliding: Vec<String> = case.movements.iter().filter(|movement| movement.collides).map(title).collect();
    (!colliding.is_empty()).then(|| format!("{} ({}{}): {}", case.name, told(case), case.novelty().name(), colliding.join(" and ")))
}

/// `side told, `, where there are sides.
fn told(case: &Case) -> String {
    case.guidance.told().map_or_else(String::new, |told| format!("{told}, "))
}

/// What every method makes of every situation, in a line each, and the shares of the graph's transitions.
fn clearances(outcome: &PlanarOutcome) -> String {
    let mut page = "Smallest distance of each movement to the obstacle; below 0 m it is inside.\n\n".to_owned();
    for case in &outcome.cases {
        let each: Vec<String> = case.movements.iter().map(clearance).collect();
        page.push_str(&format!("- `{}` ({}{}): {}\n", case.name, told(case), case.novelty().name(), each.join("; ")));
    }
    page.extend(outcome.transitions.iter().map(shares));
    page
}

/// How near a movement comes.
fn clearance(movement: &Movement) -> String {
    let hit = if movement.collides { ", collides" } else { "" };
    format!("{} {:.2} m{hit}", title(movement), movement.clearance_m)
}

/// What made a movement: a method, and of several chains which.
fn title(movement: &Movement) -> String {
    let chain = movement.chain.map_or_else(String::new, |chain| format!(" ({})", chain + 1));
    format!("{}{chain}", movement.method.title())
}

/// How often each transition of the graph is taken.
fn shares(transitions: &Transitions) -> String {
    let edges = transitions.graph.edges.iter().map(|edge| format!("{} to {}: {:.2}", edge.from, edge.to, edge.probability));
    format!("\nShares of departures in the transition graph: {}\n", edges.collect::<Vec<_>>().join("; "))
}

/// The timeline and the entities of the recording.
fn contents(outcome: &PlanarOutcome) -> String {
    let mut page = format!("Timeline:\n\n- `{}`: {}\n\nEntities:\n\n", PHASE_INPUT.name, PHASE_INPUT.meaning);
    let there = |entity: &&Entity| entity.pattern != GRAPH.pattern || outcome.transitions.is_some();
    page.extend(ENTITIES.iter().filter(there).map(|entity| format!("- `{}`: {}\n", entity.pattern, entity.meaning)));
    page
}

/// Words that mean in Markdown what they say.
fn literal(words: &str) -> String {
    words.chars().flat_map(|c| c.is_ascii_punctuation().then_some('\\').into_iter().chain([c])).collect()
}
