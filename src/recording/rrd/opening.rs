//! What a recording opens with: its layout, and what is written below the scene.

use rerun::blueprint::components::PlayState;

use super::chapters::{APPLICATION, Chapters};
use super::floor::floor_m;
use super::layout::Shown;
use super::recorder::Fault;
use super::{blueprint_property, contact_figure, layout, scene_key};
use crate::learning::ShapingKind;
use crate::learning::cpdmp::spread_unit;
use crate::robot::RobotModel;
use crate::simulation::{Experiment, Help, RunOutcome};

impl Chapters<'_> {
    /// The layout that the recording opens with; with a page for the lessons when there are some. Plots of what has been told before are
    /// as high as that. `skill` is the run with what was learned, if that is known.
    pub fn layout(&self, robot: &RobotModel, skill: Option<&RunOutcome>, taught: bool, play: PlayState) -> Result<(), Fault> {
        let Experiment { learning, execution, .. } = self.experiment;
        let betas = skill.map(|outcome| self.drawn_betas(outcome)).transpose()?;
        let shown = Shown {
            camera: self.camera(robot),
            floor_m: floor_m(self.experiment, robot),
            way_m: self.work.way,
            taught,
            baseline: self.compares(),
            beside: self.beside,
            states: (learning.shaping != ShapingKind::Lwr).then(|| scene_key::colors_in_title(&execution.coupling, betas.as_deref())),
            spread_unit: skill.map_or("mm or mrad", |outcome| spread_unit(&outcome.skill.motion.columns)),
            person: execution.help != Help::None,
            scenario: &self.experiment.name,
        };
        let (blueprint, properties) = layout::layout(&shown, &self.ranges, play)?;
        blueprint_property::send(&self.stream, APPLICATION, &blueprint, &properties)
    }

    /// What the colours in the scene mean; what touches is judged when the run is over.
    pub fn key(&self, outcome: &RunOutcome, is_over: bool) -> Result<(), Fault> {
        let (told, listens) = (self.told(outcome), self.experiment.execution.coupling.enabled);
        let contacts = is_over.then(|| contact_figure::contacts_of(outcome));
        scene_key::log_key(&self.recorder(&[]), told, (&self.drawn_betas(outcome)?, listens), (contacts, self.beside))
    }

    /// The result in words; none while the run goes on.
    pub fn result(&self, result: Option<&str>) -> Result<(), Fault> {
        scene_key::log_result(&self.recorder(&[]), self.experiment, result)
    }
}
