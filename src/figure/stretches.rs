//! Stretches of time that lie behind what is drawn over it: where forces moved the arm, and where the skill is over.

use std::cmp::Ordering;

use super::arm_run::ArmRun;
use super::mark::Mark;
use crate::palette::GREY;
use crate::palette::meaning::{COMPLIES, MINIMISES};
use crate::simulation::StepRecord;

impl ArmRun<'_> {
    /// What lies behind everything that is drawn over time: where forces moved the arm, and where the skill is over.
    pub(super) fn stretches(&self) -> impl Iterator<Item = Mark> + '_ {
        self.compliant_windows().chain(self.over())
    }

    /// The stretch after the end of the skill, in which the arm holds its place; none where the records end with the skill.
    fn over(&self) -> Option<Mark> {
        let first = self.steps.iter().find(|step| step.is_over())?;
        let ends = [first.time_s, self.steps.last()?.time_s];
        (ends[0] < ends[1]).then(|| Mark::band("the skill is over", GREY, 0.18, ends))
    }

    /// The stretches in which forces moved the arm, as marks: where it complied, and where it minimised the force error.
    fn compliant_windows(&self) -> impl Iterator<Item = Mark> + '_ {
        let acts = |step: &StepRecord| if step.activation > 0.0 { step.acting_beta().partial_cmp(&0.0) } else { None };
        let windows = self.steps.chunk_by(move |a, b| acts(a) == acts(b));
        windows.filter_map(move |window| {
            let ends = [window.first()?.time_s, window.last()?.time_s];
            match acts(window.first()?)? {
                Ordering::Less => Some(Mark::band("the arm complies", COMPLIES, 0.13, ends)),
                Ordering::Greater => Some(Mark::band("the arm minimises the force error", MINIMISES, 0.1, ends)),
                Ordering::Equal => None,
            }
        })
    }
}
