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
        }),
    }
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
