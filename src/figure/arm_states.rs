//! Which state of a skill follows which in a setting: the paper's Fig. 4.

use super::arm_run::ArmRun;
use super::chart::Figure;
use super::transitions::transitions;
use crate::learning::LearningError;
use crate::learning::phmm::TransitionGraph;

/// Width of the panel (pt).
const WIDTH_PT: f64 = 700.0;
/// Height of the panel with one chain, and of every other one (pt).
const HEIGHT_PT: [f64; 2] = [120.0, 110.0];

/// How to read it.
const READING: &str = "*: movements start here; where there are several ways, on each arrow the share of the departures that take it";

/// The transition graph with its chains; `None` for a skill without states.
///
/// # Errors
/// When parameters are missing.
pub fn arm_states(run: &ArmRun) -> Result<Option<Figure>, LearningError> {
    let motion = &run.skill.motion;
    let Some(phmm) = motion.phmm() else { return Ok(None) };
    let theta = run.skill.request(&run.question)?.theta;
    let graph = TransitionGraph::of(phmm, &motion.parameters.features.at(&theta));
    let chains = graph.chains();
    let panel = transitions(READING, &graph, &chains, WIDTH_PT);
    Ok(Some(Figure {
        title: format!("States and how they follow: {}", run.name),
        panels: vec![panel],
        columns: 1,
        panel_size_pt: [WIDTH_PT, HEIGHT_PT[0] + HEIGHT_PT[1] * chains.len().saturating_sub(1) as f64],
    }))
}
