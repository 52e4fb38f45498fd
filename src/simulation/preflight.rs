//! What can be known before the first step: can the way be reached, does everything stand apart, do the demonstrations fit.

use std::path::Path;

use super::guide_path::GuidePath;
use super::named_parts::check_parts;
use super::reachable::MOVE;
use super::setup::Setup;
use super::space::{PLACE_COLUMNS, first_pose};
use super::teaching::settings_of;
use super::{DemonstrationSource, MotionSpace, Progress, SimulationError, TeachingPlan};
use crate::control::WRENCH_COLUMNS;
use crate::demonstration::{Dataset, Demonstration};
use crate::learning::cpdmp::ForceCoupling;
use crate::learning::{ShapingKind, wrench_columns};
use crate::math;
use crate::world::Parameters;

impl Setup {
    /// Checks everything that needs no simulation: what is named is there, postures are within the limits of the joints, the way of every lesson and of the execution
    /// can be gone, nothing starts inside something else or hangs in the air, handles are on their doors, a recorded dataset fits the
    /// experiment. Returns warnings about a dataset.
    ///
    /// # Errors
    /// The names and postures that are wrong; every object that does not stand or has its handle beside its door; every way-point that cannot be
    /// reached and what does not begin apart, of the first lesson in which it is so.
    pub fn preflight(&self, progress: &dyn Progress) -> Result<Vec<String>, SimulationError> {
        let scene = match &self.experiment.demonstrations {
            DemonstrationSource::Teach(plan) => self.lessons_can_be_led(plan, progress).map(|()| Vec::new()),
            DemonstrationSource::Dataset(folder) => self.dataset_can_be_used(folder),
        };
        let before = [check_parts(&self.experiment, &self.robot), self.postures_within_limits()];
        let mut faults: Vec<SimulationError> = before.into_iter().filter_map(Result::err).collect();
        match scene {
            Err(stopped @ SimulationError::StoppedBefore { .. }) if faults.is_empty() => return Err(stopped),
            Err(SimulationError::StoppedBefore { .. }) => {}
            Err(scene) => faults.push(scene),
            Ok(warnings) if faults.is_empty() => return Ok(warnings),
            Ok(_) => {}
        }
        SimulationError::all(faults).map(|()| Vec::new())
    }

    /// Reads the dataset in `folder` for the experiment and looks whether its first demonstration begins well in its own setting; returns what is
    /// outside what it shows.
    fn dataset_can_be_used(&self, folder: &Path) -> Result<Vec<String>, SimulationError> {
        let dataset = self.in_space(Dataset::read(folder)?)?;
        self.fits(&dataset)?;
        self.stands(&self.experiment.parameters)?;
        if let Some(lesson) = dataset.demonstrations.first()
            && let Some(start) = first_pose(&lesson.trajectory)
        {
            let posture = self.posture(&start, "the start of the demonstrations", RECORD_AGAIN)?;
            let own: Vec<(String, f64)> = lesson.theta_m.iter().chain(&lesson.theta_f).cloned().collect();
            let built = self.world(&self.experiment.parameters.with(&own), &posture, false);
            self.starts_apart(built, "the start of the demonstrations")?;
        }
        Ok(self.undemonstrated(&dataset))
    }

    /// A warning for every parameter that the experiment gives a value outside those of the demonstrations.
    fn undemonstrated(&self, dataset: &Dataset) -> Vec<String> {
        let mut warnings = Vec::new();
        for (name, asked) in &self.experiment.parameters.0 {
            let theta =
                |one: &Demonstration| one.theta_m.iter().chain(&one.theta_f).find(|(known, _)| known == name).map(|(_, value)| *value);
            let shown: Vec<f64> = dataset.demonstrations.iter().filter_map(theta).collect();
            let (low, high) =
                shown.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)));
            if !shown.is_empty() && !(low..=high).contains(asked) {
                warnings.push(format!("`{name}` is {asked}, but was demonstrated from {low} to {high} only: the skill extrapolates"));
            }
        }
        warnings
    }

    /// Whether the columns and parameters of a dataset are those that the experiment needs.
    ///
    /// # Errors
    /// When they are not.
    pub fn fits(&self, dataset: &Dataset) -> Result<(), SimulationError> {
        let refuse = |what: String| Err(SimulationError::Mismatch(what));
        let of_tool = dataset.motion.len() >= 3 && dataset.motion.iter().zip(PLACE_COLUMNS).all(|(found, wanted)| found == wanted);
        if self.experiment.space == MotionSpace::Task && !of_tool {
            return refuse(format!("their motion is [{}], but must begin with x_m, y_m, z_m of the tool", dataset.motion.join(", ")));
        }
        if let Some(unknown) = dataset.wrench.iter().find(|name| !WRENCH_COLUMNS.contains(&name.as_str())) {
            return refuse(format!("the arm does not measure `{unknown}` of their wrench, only {}", WRENCH_COLUMNS.join(", ")));
        }
        self.coupling_fits(dataset)?;
        let experiment = &self.experiment;
        for (key, told, found) in
            [("theta_m", &experiment.theta_m, dataset.parameters_m()), ("theta_f", &experiment.theta_f, dataset.parameters_f())]
        {
            let (mut told, mut found) = (told.clone(), found);
            told.sort();
            found.sort();
            if told != found {
                return refuse(format!("learning.{key} is [{}], but theirs is [{}]", told.join(", "), found.join(", ")));
            }
        }
        Ok(())
    }

    /// Whether forces can act on the motion as the coupling says: `K1 J^T K2` has the shape of motion and wrench.
    fn coupling_fits(&self, dataset: &Dataset) -> Result<(), SimulationError> {
        let (coupling, learning) = (&self.experiment.execution.coupling, &self.experiment.learning);
        let has_model = !dataset.wrench.is_empty() && learning.shaping == ShapingKind::Phmm;
        let wrench = wrench_columns(&dataset.motion, has_model.then_some(dataset.wrench.as_slice()), &coupling.space);
        if coupling.enabled
            && let Err(error) = ForceCoupling::new(coupling, &dataset.motion, &wrench)
        {
            return Err(SimulationError::Mismatch(format!("[coupling]: {error}")));
        }
        Ok(())
    }

    /// Goes every lesson's way in thought, and the one that a lesson would take in the setting of the execution, and builds their worlds.
    fn lessons_can_be_led(&self, plan: &TeachingPlan, progress: &dyn Progress) -> Result<(), SimulationError> {
        let lessons = settings_of(plan, &self.experiment.parameters);
        let mut found: Vec<SimulationError> = Vec::new();
        for (number, parameters) in lessons.iter().enumerate() {
            let whose = format!("lesson {}", number + 1);
            found = add_new(self.against_leading(plan, parameters, (number as u64, &whose), progress, found.is_empty())?, found);
        }
        let exact = TeachingPlan { position_spread_m: 0.0, timing_spread: 0.0, ..plan.clone() };
        let whose = "a lesson in the setting of the execution";
        found = add_new(self.against_leading(&exact, &self.experiment.parameters, (0, whose), progress, found.is_empty())?, found);
        SimulationError::all(found)
    }

    /// What keeps a lesson from being led: what does not stand, what of the way is out of reach (up to its first pose that is, or `all` way-points),
    /// what is inside something else at its start.
    fn against_leading(
        &self,
        plan: &TeachingPlan,
        parameters: &Parameters,
        (number, whose): (u64, &str),
        progress: &dyn Progress,
        all: bool,
    ) -> Result<Vec<SimulationError>, SimulationError> {
        let mut variation = math::stream(self.experiment.seed, "human", number);
        let path = GuidePath::new(plan, &self.experiment.objects, parameters, &mut variation);
        let stands = self.stands(parameters);
        let (start, gone) = match self.can_go(plan, &path, whose, progress) {
            Ok(start) => (Some(start), Vec::new()),
            Err(stopped @ SimulationError::StoppedBefore { .. }) => return Err(stopped),
            Err(first) => {
                let others = if all { self.out_of_reach(plan, &path, whose, progress) } else { Vec::new() };
                (self.posture(&path.at(0.0).pose, whose, MOVE).ok(), add_new(others, vec![first]))
            }
        };
        // In a scene that does not stand, more would only be consequences.
        let inside = if stands.is_ok() { self.overlap(parameters, start.as_deref(), whose) } else { None };
        Ok(stands.err().into_iter().chain(gone).chain(inside).collect())
    }
}

/// What helps when the arm cannot be where recorded demonstrations begin.
const RECORD_AGAIN: &str = "record them with this robot, or describe the one that they were recorded with";

/// `known`, and those of `found` that say something of a part of the scenario of which it says nothing, or of none.
fn add_new(found: Vec<SimulationError>, mut known: Vec<SimulationError>) -> Vec<SimulationError> {
    let keys: Vec<String> = known.iter().flat_map(SimulationError::parts).filter_map(|(key, _)| key.map(str::to_owned)).collect();
    let is_new = |error: &SimulationError| error.parts().iter().any(|(key, _)| key.is_none_or(|key| keys.iter().all(|known| known != key)));
    known.extend(found.into_iter().flat_map(SimulationError::split).filter(is_new));
    known
}
