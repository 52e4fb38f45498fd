//! The files of a planar experiment: demonstrations, paths, figures.

use std::path::Path;

use super::figure_files::draw;
use super::files::STATE_LOG;
use crate::check::planar_traces;
use crate::figure::{Figure, planar_forcing, planar_paths, transitions};
use crate::planar::{Guidance, LearnedSkill, Method, Movement, PlanarOutcome, Transitions};
#[cfg(feature = "rerun")]
use crate::recording::write_planar_recording;
use crate::recording::{LoggedPath, write_path_log, write_state_log};
use crate::report::write_file;
use crate::scenario::{PlanarRun, RecordingPlan};

/// Writes everything into the folder. Returns what could not be written.
pub(super) fn write(left: &PlanarOutcome, run: &PlanarRun, plan: RecordingPlan, folder: &Path) -> Vec<String> {
    let mut failures = Vec::new();
    if plan.demonstrations {
        let written = run.dataset().map_err(|error| error.to_string());
        let written = written.and_then(|dataset| dataset.write(&folder.join("demonstrations")).map_err(|error| error.to_string()));
        failures.extend(written.err());
    }
    failures.extend(skills(left, folder));
    if plan.steps {
        failures.extend(write_path_log(&folder.join("paths.parquet"), &paths(left)).err().map(|error| error.to_string()));
    }
    if plan.hash_every_steps > 0 {
        let traces = planar_traces(left, plan.hash_every_steps);
        failures.extend(write_state_log(&folder.join(STATE_LOG), &traces).err().map(|error| error.to_string()));
    }
    #[cfg(feature = "rerun")]
    if plan.rrd {
        let written = write_planar_recording(&folder.join("recording.rrd"), &run.name, run.seed, left);
        failures.extend(written.err().map(|error| error.to_string()));
    }
    failures.extend(draw(&figures(left), &folder.join("figures")));
    failures
}

/// Every skill in a file of its own. `skill.json` is the one that is learned from `demonstrations/`.
fn skills(left: &PlanarOutcome, folder: &Path) -> Vec<String> {
    let write = |(index, learned): (usize, &LearnedSkill)| {
        let name = match index {
            0 => "skill.json".to_owned(),
            _ => format!("skill_{}_{}.json", learned.method.key(), learned.guidance.key()),
        };
        let text = learned.skill.to_json().map_err(|error| error.to_string())?;
        write_file(&folder.join(name), &text).map_err(|error| error.to_string())
    };
    left.skills.iter().enumerate().filter_map(|skill| write(skill).err()).collect()
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
pub(super) fn figures(left: &PlanarOutcome) -> Vec<(&'static str, Figure)> {
    if left.cases_with(Guidance::OneSide).next().is_some() {
        return vec![
            ("paths", planar_paths("Paths to taught and new goals", left, Guidance::OneSide)),
            ("forcing", planar_forcing("Forcing terms and states of CPDMP", left, Guidance::OneSide, Method::Cpdmp)),
        ];
    }
    let mut figures = vec![
        ("paths_with_side", planar_paths("The side is told", left, Guidance::WithSide)),
        ("paths_without_side", planar_paths("The side is not told", left, Guidance::WithoutSide)),
        ("forcing_with_side", planar_forcing("Forcing terms and states, side told", left, Guidance::WithSide, Method::Cpdmp)),
        ("forcing_chains", planar_forcing("Forcing terms and states, by chains", left, Guidance::WithoutSide, Method::CpdmpChain)),
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
