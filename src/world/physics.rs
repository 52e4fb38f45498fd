//! The engine and its settings: double precision, deterministic, fixed step.

use rapier3d_f64::prelude::{Group, InteractionGroups, InteractionTestMode, PhysicsWorld, RigidBodyHandle, Vector};

use super::WorldError;
use super::parts::Parts;

/// The engine's step.
#[derive(Clone, Debug, PartialEq)]
pub struct PhysicsSettings {
    /// Step (s), 1e-4 … 2e-3. Default 1e-3: with one solver iteration the wrench estimate is then exact.
    pub step_s: f64,
    /// Solver iterations per step, 1 … 16. Default 1; each costs a mass matrix.
    pub solver_iterations: usize,
    /// Acceleration of gravity in the world frame (m/s²). Default 9.81 along -z.
    pub gravity_m_per_s2: [f64; 3],
}

impl Default for PhysicsSettings {
    fn default() -> Self {
        Self { step_s: 1e-3, solver_iterations: 1, gravity_m_per_s2: [0.0, 0.0, -9.81] }
    }
}

/// Natural frequency of a contact, as of a spring between the two bodies (Hz).
const CONTACT_FREQUENCY_HZ: f64 = 60.0;

/// An empty engine.
pub(super) fn engine(settings: &PhysicsSettings) -> PhysicsWorld {
    let mut engine = PhysicsWorld::new();
    engine.gravity = Vector::from(settings.gravity_m_per_s2);
    let parameters = &mut engine.integration_parameters;
    parameters.dt = settings.step_s;
    parameters.num_solver_iterations = settings.solver_iterations;
    // Recycled contacts keep old anchors until a pair has moved 5 cm: a ball between open fingers then feels forces across a gap.
    parameters.contact_recycling = false;
    // At 1 kHz and arm speeds nothing moves a millimetre per step, so continuous collision detection has nothing to find.
    parameters.max_ccd_substeps = 0;
    // The defaults are made for games: 5 mm of tolerated penetration, 20 mm of look-ahead.
    parameters.normalized_allowed_linear_error = 2e-4;
    parameters.normalized_prediction_distance = 4e-3;
    // How soft things are: a 50 g toy then yields about 4 N/mm between the fingers, and hard enough that nothing sinks into the table.
    parameters.contact_softness.natural_frequency = CONTACT_FREQUENCY_HZ;
    parameters.static_contact_softness.natural_frequency = CONTACT_FREQUENCY_HZ;
    engine
}

/// Advances the engine by one step; an error when a body left the finite numbers.
pub(super) fn step(engine: &mut PhysicsWorld, parts: &Parts, step_number: u64) -> Result<(), WorldError> {
    engine.step();
    match engine.quarantine().bodies().first() {
        None => Ok(()),
        Some(&handle) => Err(WorldError::Diverged {
            step: step_number,
            time_s: step_number as f64 * engine.integration_parameters.dt,
            body: name_of(engine, parts, handle),
            fastest: fastest(engine, parts),
        }),
    }
}

/// How many of the fastest bodies are told.
const FASTEST: usize = 5;

/// The fastest bodies and their speeds (m/s), the fastest first; the engine has put those that left the finite numbers back to where they were.
fn fastest(engine: &PhysicsWorld, parts: &Parts) -> Vec<(String, f64)> {
    let moving = engine.bodies.iter().filter(|(_, body)| body.linvel().length() > 0.0);
    let mut speeds: Vec<(RigidBodyHandle, f64)> = moving.map(|(handle, body)| (handle, body.linvel().length())).collect();
    speeds.sort_by(|a, b| b.1.total_cmp(&a.1));
    speeds.truncate(FASTEST);
    speeds.into_iter().map(|(handle, speed)| (name_of(engine, parts, handle), speed)).collect()
}

/// What reports call a body: the name of the first part that can be touched of it.
fn name_of(engine: &PhysicsWorld, parts: &Parts, handle: RigidBodyHandle) -> String {
    let colliders = engine.bodies.get(handle).map_or(&[][..], |body| body.colliders());
    let named = colliders.iter().find_map(|&collider| Some(parts.of(engine.colliders.get(collider)?.user_data)?.1.name.as_str()));
    named.map_or_else(|| format!("number {}, which has no shape,", handle.into_raw_parts().0), |name| format!("`{name}`"))
}

/// Who may touch whom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layer {
    /// Torso, pedestal, head.
    RobotFixed,
    /// The first links of an arm, which overlap the torso by construction.
    ArmProximal,
    /// The rest of an arm, with its gripper.
    ArmDistal,
    /// Table, blocks, basket.
    Scenery,
    /// Things that move.
    Movable,
}

impl Layer {
    /// The engine's collision groups of this layer. Links of one arm never touch each other: its joints' limits see to that.
    pub(super) fn groups(self) -> InteractionGroups {
        const FIXED: Group = Group::GROUP_1;
        const PROXIMAL: Group = Group::GROUP_2;
        const DISTAL: Group = Group::GROUP_3;
        const SCENERY: Group = Group::GROUP_4;
        const MOVABLE: Group = Group::GROUP_5;
        let (member, filter) = match self {
            Self::RobotFixed => (FIXED, DISTAL | MOVABLE),
            Self::ArmProximal => (PROXIMAL, PROXIMAL | DISTAL | SCENERY | MOVABLE),
            Self::ArmDistal => (DISTAL, FIXED | PROXIMAL | DISTAL | SCENERY | MOVABLE),
            Self::Scenery => (SCENERY, PROXIMAL | DISTAL | MOVABLE),
            Self::Movable => (MOVABLE, FIXED | PROXIMAL | DISTAL | SCENERY | MOVABLE),
        };
        InteractionGroups::new(member, filter, InteractionTestMode::And)
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder, SharedShape};

    use super::super::parts::{Owner, Part};
    use super::*;

    /// Contract: when a body leaves the finite numbers, the error names it, the step, and the fastest bodies that are left, the fastest first.
    #[test]
    fn a_divergence_names_the_fastest_bodies() {
        let (mut engine, mut parts) =
            (engine(&PhysicsSettings { gravity_m_per_s2: [0.0; 3], ..PhysicsSettings::default() }), Parts::default());
        let speeds = [2.0, 7.0, 0.0, 5.0, 3.0, 4.0, 6.0];
        let bodies: Vec<RigidBodyHandle> = speeds
            .iter()
            .enumerate()
            .map(|(index, speed)| {
                let part = parts.add(Part { name: format!("ball_{index}"), owner: Owner::Object(index), handle: false });
                let place = Vector::new(0.0, 10.0 * index as f64, 0.0);
                let body = engine.insert_body(RigidBodyBuilder::dynamic().translation(place).linvel(Vector::new(*speed, 0.0, 0.0)));
                engine.insert_collider(ColliderBuilder::new(SharedShape::ball(0.1)).user_data(part as u128), Some(body));
                body
            })
            .collect();
        step(&mut engine, &parts, 1).expect("all is finite");
        engine.bodies.get_mut(bodies[2]).expect("there").set_linvel(Vector::new(f64::NAN, 0.0, 0.0), true);
        let Err(WorldError::Diverged { step, body, fastest, .. }) = step(&mut engine, &parts, 2) else { panic!("it diverges") };
        assert_eq!((step, body.as_str()), (2, "`ball_2`"));
        let names: Vec<&str> = fastest.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["`ball_1`", "`ball_6`", "`ball_3`", "`ball_5`", "`ball_4`"]);
        assert!((fastest[0].1 - 7.0).abs() < 1e-9, "{fastest:?}");
    }
}
