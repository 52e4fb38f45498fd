//! A page in the recording that says how its experiment ended, and how to read it.

use rerun::TextDocument;

use super::entity_path::Entity;
use super::planar_entity::{ENTITIES, GRAPH, GUIDE, PHASE_INPUT};
use super::planar_reading::reading;
use super::planar_recorder::PlanarRecorder;
use super::recorder::Fault;
use crate::planar::{Case, PlanarOutcome, Transitions};

/// Logs the page; `result` says how the experiment ended, its first line what it is called.
pub(super) fn log_guide(recorder: &PlanarRecorder, outcome: &PlanarOutcome, result: &str) -> Result<(), Fault> {
    let (headline, answers) = result.split_once('\n').unwrap_or((result, ""));
    let (headline, answers) = (literal(headline), literal(answers).replace('\n', "  \n"));
    let mut page = format!("**{headline}**; {} demonstrations\n\n{answers}\n\n{}\n\n", outcome.demonstrations.len(), reading(outcome));
    page.push_str("## Clearances\n\n");
    page.extend(outcome.cases.iter().map(clearances));
    page.extend(outcome.transitions.iter().map(shares));
    page.push_str(&format!("\n## Timeline\n\n- `{}`: {}\n\n## Entities\n\n", PHASE_INPUT.name, PHASE_INPUT.meaning));
    let there = |entity: &&Entity| entity.pattern != GRAPH.pattern || outcome.transitions.is_some();
    page.extend(ENTITIES.iter().filter(there).map(|entity| format!("- `{}`: {}\n", entity.pattern, entity.meaning)));
    recorder.always(GUIDE.path(), &TextDocument::from_markdown(page))
}

/// Words that mean in Markdown what they say.
fn literal(words: &str) -> String {
    words.chars().flat_map(|c| c.is_ascii_punctuation().then_some('\\').into_iter().chain([c])).collect()
}

/// What every method makes of a situation, in a line.
fn clearances(case: &Case) -> String {
    let each: Vec<String> = case
        .movements
        .iter()
        .map(|movement| {
            let hit = if movement.collides { ", collides" } else { "" };
            let chain = movement.chain.map_or_else(String::new, |chain| format!(" ({})", chain + 1));
            format!("{}{chain} {:.2} m{hit}", movement.method.title(), movement.clearance_m)
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
