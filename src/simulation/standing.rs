//! Whether a scene can be as described: nothing inside something else, nothing in the air, handles on their doors.

use super::SimulationError;
use super::setup::Setup;
use crate::world::{ObjectKind, Overlap, Parameters, World, WorldError};

impl Setup {
    /// A world in which nothing starts inside something else; `whose` start it is, the errors say.
    pub(super) fn starts_apart(&self, built: Result<World, SimulationError>, whose: &str) -> Result<World, SimulationError> {
        match built {
            Err(SimulationError::World(WorldError::Overlap(pairs))) => Err(self.inside_each_other(pairs, whose)),
            built => built,
        }
    }

    /// What starts inside something else, with the arm at `start` (rad); when nobody knows where that is, among the objects alone.
    pub(super) fn overlap(&self, parameters: &Parameters, start: Option<&[f64]>, whose: &str) -> Option<SimulationError> {
        let posture = start.unwrap_or(&self.experiment.robot.rest_posture_rad);
        match self.world(parameters, posture, false) {
            Err(SimulationError::World(WorldError::Overlap(mut pairs))) => {
                pairs.retain(|pair| {
                    start.is_some() || (self.experiment.object_of(&pair.a).is_some() && self.experiment.object_of(&pair.b).is_some())
                });
                (!pairs.is_empty()).then(|| self.inside_each_other(pairs, whose))
            }
            built => built.err().filter(|_| start.is_some()),
        }
    }

    fn inside_each_other(&self, pairs: Vec<Overlap>, whose: &str) -> SimulationError {
        let told = pairs.into_iter().map(|pair| {
            let culprit =
                self.experiment.object_of(&pair.a).or_else(|| self.experiment.object_of(&pair.b)).map(|object| format!("object.{object}"));
            // Of the robot alone it is the posture of the arm that nobody leads.
            let culprit = culprit.or_else(|| self.idle().map(|_| "robot.idle_posture_rad".to_owned()));
            SimulationError::Scene(format!("{whose}: {}", WorldError::Overlap(vec![pair]))).at_if(culprit)
        });
        SimulationError::Several(told.collect())
    }

    /// Everything that can fall lies on a table: there is no floor. Handles are on their doors.
    pub(super) fn stands(&self, parameters: &Parameters) -> Result<(), SimulationError> {
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
