//! What can be known before the first step: can the way be reached, does everything stand apart, do the demonstrations fit.

use nalgebra::{Isometry3, Translation3, Vector3};

use super::guide_path::GuidePath;
use super::setup::Setup;
use super::space::{PLACE_COLUMNS, first_pose};
use super::teaching::settings_of;
use super::{DemonstrationSource, MotionSpace, SimulationError, TeachingPlan};
use crate::control::WRENCH_COLUMNS;
use crate::demonstration::Dataset;
use crate::learning::cpdmp::ForceCoupling;
use crate::learning::{ShapingKind, wrench_columns};
use crate::math;
use crate::world::{Object, ObjectKind, Parameters, pointing_down};

impl Setup {
    /// Checks everything that needs no simulation: every way-point of every lesson can be reached, nothing starts inside something else or
    /// hangs in the air, a recorded dataset fits the experiment.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn preflight(&self) -> Result<(), SimulationError> {
        let start = match &self.experiment.demonstrations {
            DemonstrationSource::Teach(plan) => self.lessons_can_be_led(plan)?,
            DemonstrationSource::Dataset(folder) => {
                let dataset = self.in_space(Dataset::read(folder)?)?;
                self.fits(&dataset)?;
                dataset.demonstrations.first().and_then(|lesson| first_pose(&lesson.trajectory))
            }
        };
        self.stands(&self.experiment.parameters)?;
        if let Some(start) = start {
            let posture = self.posture(&start, "the start of the demonstrations")?;
            self.world(&self.experiment.parameters, &posture, false)?;
        }
        Ok(())
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

    /// Solves every lesson's way-points and builds its world; the pose at which the first lesson starts.
    fn lessons_can_be_led(&self, plan: &TeachingPlan) -> Result<Option<Isometry3<f64>>, SimulationError> {
        let mut first = None;
        for (number, parameters) in settings_of(plan, &self.experiment.parameters).iter().enumerate() {
            let mut variation = math::stream(self.experiment.seed, "human", number as u64);
            let path = GuidePath::new(plan, &self.experiment.objects, parameters, &mut variation);
            let pose = |knot: &Vector3<f64>| Isometry3::from_parts(Translation3::from(*knot), pointing_down(plan.tool_yaw_rad));
            let mut start = None;
            for (k, (waypoint, knot)) in plan.waypoints.iter().zip(path.knots()).enumerate() {
                let place = waypoint.at.as_deref().unwrap_or("the world");
                let posture = self.posture(&pose(knot), &format!("way-point {} (at {place}) of lesson {}", k + 1, number + 1))?;
                start = start.or(Some((pose(knot), posture)));
            }
            self.stands(parameters)?;
            if let Some((pose, posture)) = start {
                self.world(parameters, &posture, false)?;
                first = first.or(Some(pose));
            }
        }
        Ok(first)
    }

    /// Everything that can fall lies on a table: there is no floor.
    fn stands(&self, parameters: &Parameters) -> Result<(), SimulationError> {
        let objects = &self.experiment.objects;
        let hanging = objects.iter().filter(|o| o.is_free()).find(|o| !objects.iter().any(|table| carries(table, o, parameters)));
        match hanging {
            None => Ok(()),
            Some(object) => {
                let center = object.center(parameters);
                let place = format!("[{:.3}, {:.3}] m", center.x, center.y);
                Err(SimulationError::Scene(format!("object `{}` at {place} lies on no table and would fall for ever", object.name)))
            }
        }
    }
}

fn carries(table: &Object, object: &Object, parameters: &Parameters) -> bool {
    let ObjectKind::Table { size_m, .. } = &table.kind else { return false };
    let away = object.center(parameters) - table.center(parameters);
    away.x.abs() <= size_m.x / 2.0 && away.y.abs() <= size_m.y / 2.0
}
