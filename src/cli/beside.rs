//! What a scenario wants to have executed beside its run. It is shown and reported, and nothing depends on it.

use super::judged_run::{JudgedRun, Left};
use crate::check::{allow, judge};
use crate::report::{BesideReport, PhaseReport};
use crate::scenario::{Scenario, Work};
use crate::simulation::{Progress, execute_beside};

/// Executes it after a whole run, and adds it to what the run left and reports. What cannot be executed is a warning.
pub(super) fn beside(run: &mut JudgedRun, scenario: &Scenario, progress: &dyn Progress) {
    let (Some(Left::Arm(left)), Work::Arm(experiment)) = (&mut run.left, &scenario.work) else { return };
    if scenario.beside.is_empty() || run.report.error.is_some() {
        return;
    }
    let started_s = progress.elapsed_s();
    let executed = execute_beside((experiment, left), &scenario.beside, progress);
    for (variation, executed) in scenario.beside.iter().zip(executed) {
        match executed {
            Ok(mut beside) => {
                allow(&mut beside.outcome.collisions, &scenario.allowed_contacts);
                let criteria = judge(&beside.outcome, &variation.experiment, &scenario.criteria);
                run.report.beside.push(BesideReport::of(&beside, &criteria));
                left.beside.push(beside);
            }
            Err(error) => run.report.warnings.push(format!("`{}` could not be executed beside the run: {error}", variation.name)),
        }
    }
    let wall_s = progress.elapsed_s() - started_s;
    progress.note(&format!("beside: {wall_s:.1} s"));
    let steps = run.report.beside.iter().map(|one| one.steps).sum();
    run.report.phases.push(PhaseReport { name: "beside".to_owned(), steps, wall_s });
}
