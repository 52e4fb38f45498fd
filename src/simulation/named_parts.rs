//! Names of a scenario that must be those of links, objects or parts of objects.

use super::{Experiment, NamedPart, RobotSettings, SimulationError};
use crate::control::{ArmModel, ArmModelError};
use crate::robot::{self, RobotModel};
use crate::world::{Object, Parameters, fixed_parts, object_parts};

/// Every part that criteria and allowed contacts name is a link of the robot, an object, or one of an object's parts; no contact is allowed inside
/// one object, which has none; and no two are called the same.
pub(super) fn check_parts(experiment: &Experiment, robot: &RobotModel) -> Result<(), SimulationError> {
    let links = || robot.frames.iter().map(|frame| frame.name.as_str());
    let parts: Vec<String> = experiment.objects.iter().flat_map(|object| parts_of(object, &experiment.parameters)).collect();
    let is_part = |name: &str| parts.iter().any(|part| part == name || part.strip_prefix(name).is_some_and(|rest| rest.starts_with('.')));
    let unknown = experiment.named_parts.iter().filter(|part| !is_part(&part.name) && !links().any(|link| link == part.name));
    let unknown = unknown.map(|NamedPart { key, name }| {
        let near = robot::nearest_name(name, links().chain(parts.iter().map(String::as_str)));
        let told = match experiment.object_of(name) {
            Some(object) => {
                let of_object = parts.iter().filter(|part| part.split('.').next() == Some(object));
                format!("object `{object}` has no part `{name}`, only {}", of_object.map(String::as_str).collect::<Vec<_>>().join(", "))
            }
            None => format!("the robot has no link `{name}`, and the scene no object of that name"),
        };
        SimulationError::Scene(told + &did_you_mean(near)).at(key)
    });
    let ends = experiment.named_parts.windows(2).filter(|pair| pair[0].key.strip_suffix('a') == pair[1].key.strip_suffix('b'));
    let inside = ends.filter_map(|pair| {
        let object = experiment.object_of(&pair[0].name)?;
        let told = || format!("both ends are of object `{object}`, whose parts never touch each other: it would allow nothing");
        (pair[0].name != pair[1].name && experiment.object_of(&pair[1].name) == Some(object))
            .then(|| SimulationError::Scene(told()).at(&pair[1].key))
    });
    let twins = experiment.objects.iter().filter(|object| links().any(|link| link == object.name)).map(|object| {
        let told = format!(
            "object `{0}`: a link of the robot is called `{0}` too, and what is said of one would hold for both: name it otherwise",
            object.name
        );
        SimulationError::Scene(told).at(format!("object.{}", object.name))
    });
    SimulationError::all(unknown.chain(inside).chain(twins).collect())
}

/// The arm of `robot` that ends in the link that the key `robot.KEY` names.
pub(super) fn arm(
    robot: &RobotModel,
    (key, link): (&str, &str),
    rest_rad: &[f64],
    settings: &Experiment,
) -> Result<ArmModel, SimulationError> {
    ArmModel::new(robot, link, rest_rad, settings.physics.gravity_m_per_s2).map_err(|error| {
        let near = robot::nearest_name(link, robot.frames.iter().map(|frame| frame.name.as_str()));
        let told = match (&error, near) {
            (ArmModelError::UnknownLink(unknown), Some(_)) if unknown == link => {
                SimulationError::Scene(format!("{error}{}", did_you_mean(near)))
            }
            _ => SimulationError::Arm(error),
        };
        told.at(format!("robot.{key}"))
    })
}

/// Every list of joint values has one number per joint.
pub(super) fn check_lengths(settings: &RobotSettings, joints: usize, idle_joints: Option<usize>) -> Result<(), SimulationError> {
    let impedance = &settings.impedance;
    let lists = [
        ("robot.rest_posture_rad", settings.rest_posture_rad.len(), &settings.tool_link, Some(joints)),
        ("robot.impedance.stiffness_nm_per_rad", impedance.stiffness_nm_per_rad.len(), &settings.tool_link, Some(joints)),
        ("robot.impedance.damping_nms_per_rad", impedance.damping_nms_per_rad.len(), &settings.tool_link, Some(joints)),
        ("robot.idle_posture_rad", settings.idle_posture_rad.len(), &settings.idle_tool_link, idle_joints),
        ("robot.impedance.stiffness_nm_per_rad", impedance.stiffness_nm_per_rad.len(), &settings.idle_tool_link, idle_joints),
    ];
    let wrong = lists.into_iter().filter_map(|(key, found, link, joints)| {
        let joints = joints.filter(|joints| *joints != found)?;
        let told = format!("{key} has {found} numbers, but the arm that ends in `{link}` has {joints} joints: give one number per joint");
        Some(SimulationError::Scene(told).at(key))
    });
    SimulationError::all(wrong.collect())
}

/// What contacts and distances call the parts of an object: itself, or `OBJECT.PART`.
fn parts_of(object: &Object, parameters: &Parameters) -> Vec<String> {
    let all = object_parts(object, parameters).into_iter().chain(fixed_parts(object));
    let called = all.map(|part| if part.name.is_empty() { object.name.clone() } else { format!("{}.{}", object.name, part.name) });
    called.collect()
}

fn did_you_mean(near: Option<&str>) -> String {
    near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"))
}
