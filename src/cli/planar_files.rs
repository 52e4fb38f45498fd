//! The files of a planar experiment: demonstrations, paths, figures.

use super::figure_files::drawn;
use super::files::{DEMONSTRATIONS, SKILL, STATE_LOG};
use super::room::Room;
use crate::check::planar_traces;
use crate::figure::{Figure, planar_forcing, planar_paths, transitions};
use crate::planar::{Guidance, LearnedSkill, Method, Movement, PlanarOutcome, Transitions};
#[cfg(feature = "rerun")]
use crate::recording::write_planar_recording;
use crate::recording::{LoggedPath, write_path_log, write_state_log};
use crate::report::write_file;
use crate::scenario::{PlanarRun, RecordingPlan};

/// Writes everything: the archive first, what is drawn from it last.
pub(super) fn write((left, run): (&PlanarOutcome, &PlanarRun), plan: RecordingPlan, result: &str, room: &mut Room<'_>) {
    if plan.steps {
        room.put("paths.parquet", |place| write_path_log(place, &paths(left)).map_err(|error| error.to_string()));
    }
    for (index, learned) in left.skills.iter().enumerate() {
        room.put(&name_of_skill(index, learned), |place| {
            let text = learned.skill.to_json().map_err(|error| error.to_string())?;
            write_file(place, &text).map_err(|error| error.to_string())
        });
    }
    if plan.demonstrations {
        room.put(DEMONSTRATIONS, |place| {
            let dataset = run.dataset().map_err(|error| error.to_string())?;
            dataset.write(place).map_err(|error| error.to_string())
        });
    }
    if plan.hash_every_steps > 0 {
        let traces = planar_traces(left, plan.hash_every_steps);
        room.put(STATE_LOG, |place| write_state_log(place, &traces).map_err(|error| error.to_string()));
    }
    let figures = figures(&run.name, left);
    room.put("figures", |place| drawn(&figures, place));
    #[cfg(feature = "rerun")]
    if plan.rrd {
        room.put("recording.rrd", |place| {
            write_planar_recording(place, (&run.name, run.seed), left, result).map_err(|error| error.to_string())
        });
    }
}

/// Every skill has a file of its own. `skill.json` is the one that is learned from `demonstrations/`.
fn name_of_skill(index: usize, learned: &LearnedSkill) -> String {
    match index {
        0 => SKILL.to_owned(),
        _ => format!("skill_{}_{}.json", learned.method.key(), learned.guidance.key()),
    }
}

/// Every path: demonstrations first, then every movement of every setting.
fn paths(left: &PlanarOutcome) -> Vec<LoggedPath<'_>> {
    let shown =
        left.demonstrations.iter().map(|shown| LoggedPath { method: "demonstration", setting: &shown.name, points_m: &shown.path_m });
    let moved = left.cases.iter().flat_map(|case| case.movements.iter().map(|movement| logged(movement, &case.name)));
    shown.chain(moved).collect()
}

fn logged<'a>(movement: &'a Movement, setting: &'a str) -> LoggedPath<'a> {
    LoggedPath { method: movement.method.key(), setting, points_m: &movement.path_m }
}

/// The figures of an experiment: those of section 4.1, or those of section 4.2 with the side told and without.
pub(super) fn figures(name: &str, left: &PlanarOutcome) -> Vec<(&'static str, Figure)> {
    let title = |what: &str| format!("{name}: {what}");
    if left.cases_with(Guidance::OneSide).next().is_some() {
        return vec![
            ("paths", planar_paths(&title("paths to taught and other goals"), left, Guidance::OneSide)),
            ("forcing", planar_forcing(&title("forcing terms and states of CPDMP"), left, Guidance::OneSide, Method::Cpdmp)),
        ];
    }
    let mut figures = vec![
        ("paths_with_side", planar_paths(&title("the side is told"), left, Guidance::WithSide)),
        ("paths_without_side", planar_paths(&title("the side is not told"), left, Guidance::WithoutSide)),
        ("forcing_with_side", planar_forcing(&title("forcing terms and states, side told"), left, Guidance::WithSide, Method::Cpdmp)),
        ("forcing_chains", planar_forcing(&title("forcing terms and states, by chains"), left, Guidance::WithoutSide, Method::CpdmpChain)),
    ];
    figures.extend(left.transitions.iter().map(|t| ("transitions", graph(t))));
    figures
}

/// The states of the model that is not told the side, and how they follow each other.
fn graph(states: &Transitions) -> Figure {
    /// Width and height of the panel (pt).
    const PANEL_PT: [f64; 2] = [640.0, 250.0];
    let title = "States and chains, the side not told";
    let reading = "*: movements start here; where there are several ways, on each arrow the share of the departures that take it";
    let panel = transitions(reading, &states.graph, &states.chains, PANEL_PT[0]);
    Figure { title: title.to_owned(), panels: vec![panel], columns: 1, panel_size_pt: PANEL_PT }
}
