//! What can be known before the first step: can the way be reached, does everything stand apart, do the demonstrations fit.

use std::path::Path;

use super::guide_path::GuidePath;
use super::setup::{PoseName, Setup};
use super::space::{PLACE_COLUMNS, first_pose};
use super::teaching::settings_of;
use super::{DemonstrationSource, MotionSpace, Progress, SimulationError, TeachingPlan};
use crate::control::WRENCH_COLUMNS;
use crate::demonstration::{Dataset, Demonstration};
use crate::learning::cpdmp::ForceCoupling;
use crate::learning::{ShapingKind, wrench_columns};
use crate::math;
use crate::world::{ObjectKind, Parameters, World, WorldError};

impl Setup {
    /// Checks everything that needs no simulation: postures are within the limits of the joints, the way of every lesson and of the execution
    /// can be gone, nothing starts inside something else or hangs in the air, handles are on their doors, a recorded dataset fits the
    /// experiment. Returns warnings about a dataset.
    ///
    /// # Errors
    /// The postures that are wrong; every object that does not stand or has its handle beside its door; of every part of the way that cannot be
    /// gone or does not begin apart the first lesson in which it is so.
    pub fn preflight(&self, progress: &dyn Progress) -> Result<Vec<String>, SimulationError> {
        let scene = match &self.experiment.demonstrations {
            DemonstrationSource::Teach(plan) => self.lessons_can_be_led(plan, progress).map(|()| Vec::new()),
            DemonstrationSource::Dataset(folder) => self.dataset_can_be_used(folder),
        };
        match (self.postures_within_limits(), scene) {
            (Err(postures), Err(scene)) => Err(SimulationError::Several(vec![postures, scene])),
            (postures, scene) => postures.and(scene),
        }
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
        let mut note = |led: Result<(), SimulationError>| match led {
            Err(stopped @ SimulationError::StoppedBefore { .. }) => Err(stopped),
            Err(error) => {
                let known = |key: &str| found.iter().flat_map(SimulationError::parts).any(|(other, _)| other == Some(key));
                if !error.parts().iter().all(|(key, _)| key.is_some_and(known)) {
                    found.push(error);
                }
                Ok(())
            }
            Ok(()) => Ok(()),
        };
        for (number, parameters) in lessons.iter().enumerate() {
            note(self.can_be_led(plan, parameters, (number as u64, &format!("lesson {}", number + 1)), progress))?;
        }
        let exact = TeachingPlan { position_spread_m: 0.0, timing_spread: 0.0, ..plan.clone() };
        note(self.can_be_led(&exact, &self.experiment.parameters, (0, "a lesson in the setting of the execution"), progress))?;
        SimulationError::all(found)
    }

    fn can_be_led(
        &self,
        plan: &TeachingPlan,
        parameters: &Parameters,
        (number, whose): (u64, &str),
        progress: &dyn Progress,
    ) -> Result<(), SimulationError> {
        self.stands(parameters)?;
        let mut variation = math::stream(self.experiment.seed, "human", number);
        let path = GuidePath::new(plan, &self.experiment.objects, parameters, &mut variation);
        let start = self.can_go(plan, &path, whose, progress)?;
        self.starts_apart(self.world(parameters, &start, false), whose).map(|_| ())
    }

    /// A world in which nothing starts inside something else; `whose` start it is, the errors say.
    pub(super) fn starts_apart(&self, built: Result<World, SimulationError>, whose: &str) -> Result<World, SimulationError> {
        let Err(SimulationError::World(WorldError::Overlap(pairs))) = built else { return built };
        let objects = &self.experiment.objects;
        let object = |part: &str| objects.iter().find(|object| part.split('.').next() == Some(object.name.as_str()));
        let told = pairs.into_iter().map(|pair| {
            let culprit = object(&pair.a).or_else(|| object(&pair.b)).map(|object| format!("object.{}", object.name));
            let error = SimulationError::Scene(format!("{whose}: {}", WorldError::Overlap(vec![pair])));
            PoseName { what: String::new(), key: culprit }.told(error)
        });
        Err(SimulationError::Several(told.collect()))
    }

    /// Everything that can fall lies on a table: there is no floor. Handles are on their doors.
    fn stands(&self, parameters: &Parameters) -> Result<(), SimulationError> {
        let objects = &self.experiment.objects;
        let beside_door = objects.iter().filter_map(|object| {
            let ObjectKind::Cabinet(cabinet) = &object.kind else { return None };
            let hinge_y = object.center(parameters).y;
            let (distance, width) = (cabinet.handle_distance_m(hinge_y, parameters), cabinet.door_size_m.x);
            let told = || {
                let what = format!("the handle of `{}` is {distance:.3} m from the hinge, but its door is {width} m wide", object.name);
                let told = format!("{what}: change `handle_lateral_m` or `door_size_m`");
                SimulationError::Scene(told).at(format!("object.{}.handle_lateral_m", object.name))
            };
            (!cabinet.has_handle_on_door(hinge_y, parameters)).then(told)
        });
        let hanging = objects.iter().filter(|o| o.is_free() && !objects.iter().any(|table| table.carries(o, parameters)));
        let falling = hanging.map(|object| {
            let center = object.center(parameters);
            let place = format!("[{:.3}, {:.3}] m", center.x, center.y);
            let what = format!("object `{}` at {place} lies on no table and would fall for ever", object.name);
            let told = format!("{what}: put it on a table, or give the table another size");
            SimulationError::Scene(told).at(format!("object.{}", object.name))
        });
        SimulationError::all(beside_door.chain(falling).collect())
    }
}

/// What helps when the arm cannot be where recorded demonstrations begin.
const RECORD_AGAIN: &str = "record them with this robot, or describe the one that they were recorded with";
