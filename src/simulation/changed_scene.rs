//! Whether what a run logged of its objects still says something when its scene is changed.

use nalgebra::Isometry3;

use super::Experiment;
use crate::world::{Object, ObjectPart, fixed_parts, object_parts, support_height_m};

/// The objects that were free to go somewhere in `run`, and in `asked` begin elsewhere, are of another shape, or are not there: where they
/// would go only a simulation tells. What stands still may be changed, for it is where the scene puts it.
#[must_use]
pub fn moved_otherwise(run: &Experiment, asked: &Experiment) -> Vec<String> {
    let objects = asked.objects.iter().chain(&run.objects).filter(|object| object.moves());
    let mut names: Vec<String> = Vec::new();
    for name in objects.map(|object| &object.name) {
        if !names.contains(name) && standing(run, name) != standing(asked, name) {
            names.push(name.clone());
        }
    }
    names
}

/// Whether an object of an experiment moves, where it begins, and what it is made of.
fn standing(experiment: &Experiment, name: &str) -> Option<(bool, Isometry3<f64>, Vec<ObjectPart>)> {
    let (objects, parameters) = (&experiment.objects, &experiment.parameters);
    let object: &Object = objects.iter().find(|object| object.name == name)?;
    let pose = object.pose(parameters, support_height_m(objects, object, parameters));
    let parts = object_parts(object, parameters).into_iter().chain(fixed_parts(object));
    Some((object.moves(), pose, parts.collect()))
}
