//! Forcing terms of an arm's skill over the phase with the states that make them: the paper's Fig. 6(a).

use nalgebra::Matrix2;

use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use super::outline::covariance_ellipse;
use crate::demonstration::Parameters;
use crate::learning::phmm::Sequence;
use crate::learning::{LearningError, Skill, motion_sequences};
use crate::palette::{BLUE, GREEN, GREY, ORANGE, PURPLE, Rgb, SKY_BLUE, VERMILION};
use crate::simulation::{Experiment, RunOutcome};

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [560.0, 230.0];
/// Gaussians are drawn at this many standard deviations.
const DEVIATIONS: f64 = 2.0;
/// Points of a curve.
const POINTS: usize = 201;
/// Colours of the taught situations, in the order of teaching; those after the last share it.
const TAUGHT: [Rgb; 5] = [BLUE, GREEN, ORANGE, PURPLE, SKY_BLUE];

/// One panel per motion column: what the demonstrations ask for (4), the forcing term for every taught situation and for the executed one, and
/// the states at two standard deviations.
///
/// # Errors
/// When the demonstrations or the parameters of the execution do not fit the skill.
pub fn skill_forcing(outcome: &RunOutcome, experiment: &Experiment) -> Result<Figure, LearningError> {
    let shown = motion_sequences(&outcome.dataset, &experiment.learning)?;
    let situations = situations(outcome, experiment);
    let columns = &outcome.skill.motion.columns;
    let panels = columns.iter().enumerate().map(|(column, name)| panel((column, name), &shown, &outcome.skill, &situations));
    let panels = panels.collect::<Result<Vec<Chart>, LearningError>>()?;
    Ok(Figure { title: "Forcing terms and states".to_owned(), panels, columns: 1, panel_size_pt: PANEL_PT })
}

/// A situation that is drawn.
struct Situation {
    theta: Parameters,
    legend: String,
    color: Rgb,
    width_pt: f64,
}

/// The taught situations, each once, and the executed one.
fn situations(outcome: &RunOutcome, experiment: &Experiment) -> Vec<Situation> {
    let mut taught: Vec<&Parameters> = Vec::new();
    for demonstration in &outcome.dataset.demonstrations {
        if !taught.contains(&&demonstration.theta_m) {
            taught.push(&demonstration.theta_m);
        }
    }
    let named = |theta: &Parameters| theta.iter().map(|(name, value)| format!("{name} {value}")).collect::<Vec<_>>().join(", ");
    let shown = taught.iter().enumerate().map(|(k, theta)| Situation {
        theta: (*theta).clone(),
        legend: named(theta),
        color: TAUGHT[k.min(TAUGHT.len() - 1)],
        width_pt: 0.9,
    });
    let theta: Parameters =
        experiment.theta_m.iter().filter_map(|name| Some((name.clone(), experiment.parameters.get(name)?))).collect();
    let legend = format!("executed: {}", named(&theta));
    shown.chain([Situation { theta, legend, color: VERMILION, width_pt: 1.8 }]).collect()
}

fn panel(
    (column, name): (usize, &str),
    shown: &[Sequence],
    skill: &Skill,
    situations: &[Situation],
) -> Result<Chart, LearningError> {
    let mut chart = Chart::plot("", [Axis::new("phase input (-)"), Axis::new(&format!("forcing of {name}"))]);
    let row = column + 1;
    let points = |sequence: &Sequence| sequence.values.chunks_exact(sequence.dimension).map(|values| [values[0], values[row]]).collect();
    chart.marks.extend(shown.iter().map(|sequence| Mark::line("demonstrated", GREY, 0.6, points(sequence))));
    for situation in situations {
        let theta = skill.motion.parameters.resolve(&situation.theta)?;
        if let Some(phmm) = skill.motion.phmm() {
            let phi = skill.motion.parameters.features.at(&theta);
            for (state, covariance) in phmm.covariances.iter().enumerate() {
                let mean = phmm.mean_at(state, &phi);
                let of = Matrix2::new(covariance[(0, 0)], covariance[(0, row)], covariance[(row, 0)], covariance[(row, row)]);
                chart.marks.push(Mark::area("", situation.color, 0.12, covariance_ellipse([mean[0], mean[row]], &of, DEVIATIONS)));
            }
        }
        let mut shaping = skill.motion.shaping_at(&theta)?;
        let mut forcing = vec![0.0; skill.motion.columns.len()];
        let curve = (0..POINTS).map(|i| {
            let u = i as f64 / (POINTS - 1) as f64;
            shaping.forcing(u, &mut forcing);
            [skill.motion.phase_input.at(u, skill.motion.alpha), forcing[column]]
        });
        chart.marks.push(Mark::line(&situation.legend, situation.color, situation.width_pt, curve.collect()));
    }
    Ok(chart)
}
