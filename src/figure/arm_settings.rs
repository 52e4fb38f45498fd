//! The forcing terms of all settings that were taught, with the states that make them: the paper's Fig. 6a.

use super::arm_forcing::{ForcingCurve, PANEL_PT, demanded, panel_of};
use super::arm_run::ArmRun;
use super::chart::Figure;
use super::mark::Mark;
use crate::demonstration::Parameters;
use crate::learning::{LearningError, motion_sequences};
use crate::palette::meaning::PLANNED;
use crate::palette::{BLUE, BROWN, GREY, MAGENTA, Rgb, VERMILION, VIOLET, YELLOW};

/// Colours of the settings, none of which is that of a plan, an execution or a kind of state elsewhere; of more settings than colours the first
/// ones are drawn.
const COLORS: [Rgb; 6] = [BLUE, VERMILION, MAGENTA, BROWN, VIOLET, YELLOW];

/// One panel per column of the motion, a colour per taught setting: what its demonstrations demand (4), the skill's forcing and, at two
/// standard deviations, the skill's states; on top of them the forcing in the setting of the execution, under its name. `None` when all were taught in one
/// setting, and for a skill that makes no difference between them.
///
/// # Errors
/// When the demonstrations cannot be used, or parameters are missing.
pub fn arm_settings(run: &ArmRun) -> Result<Option<Figure>, LearningError> {
    let (motion, lessons) = (&run.skill.motion, &run.dataset.demonstrations);
    let mut settings: Vec<&Parameters> = Vec::new();
    for lesson in lessons.iter().filter(|lesson| !lesson.theta_m.is_empty()) {
        if !settings.contains(&&lesson.theta_m) {
            settings.push(&lesson.theta_m);
        }
    }
    if settings.len() < 2 || motion.phmm().is_none() {
        return Ok(None);
    }
    let sequences = motion_sequences(run.dataset, run.learning)?;
    let curve = |theta: &Parameters| ForcingCurve::of(motion, &motion.parameters.resolve(theta)?);
    let curves = settings.iter().zip(COLORS).map(|(theta, _)| curve(theta)).collect::<Result<Vec<_>, _>>()?;
    let theta = run.skill.request(&run.question)?.theta;
    let asked = ForcingCurve::of(motion, &theta)?;
    let executed = format!("{}, executed", name_of(motion.parameters.names.iter().zip(theta.iter().copied())));
    let panel = |j: usize| {
        let mut chart = panel_of(motion, j);
        // In the legend once, not in the colour of one of them.
        chart.marks.push(Mark::line("taught, in the colour of its setting", GREY, 0.6, Vec::new()));
        chart.marks.push(Mark::area("state, two standard deviations", GREY, 0.15, Vec::new()));
        for ((theta, color), curve) in settings.iter().zip(COLORS).zip(&curves) {
            let of_setting = lessons.iter().zip(&sequences).filter(|(lesson, _)| lesson.theta_m == **theta);
            chart.marks.extend(of_setting.map(|(_, sequence)| Mark::line("", color.lighter(0.4), 0.6, demanded(sequence, j))));
            let outlines = run.states.iter().filter_map(|state| curve.outline(motion, state.state, j));
            chart.marks.extend(outlines.map(|outline| Mark::faint_area("", color, outline)));
            chart.marks.push(Mark::line(&name_of(theta.iter().map(|(name, value)| (name, *value))), color, 1.4, curve.along(j)));
        }
        chart.marks.push(Mark::dashes(&executed, PLANNED, 2.0, asked.along(j)));
        chart
    };
    let panels = (0..motion.columns.len()).map(panel).collect();
    let title = format!("Forcing terms of the taught settings: {}", run.name);
    Ok(Some(Figure { title, panels, columns: 1, panel_size_pt: PANEL_PT }))
}

/// `handle_y_m = 0.45, block_height_m = 0.2`, without the digits that a value has when it is read off an end of the movement.
fn name_of<'a>(theta: impl Iterator<Item = (&'a String, f64)>) -> String {
    theta.map(|(name, value)| format!("{name} = {}", (value * 1e6).round() / 1e6)).collect::<Vec<_>>().join(", ")
}
