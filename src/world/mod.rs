//! The simulated world: the engine, the robot in it, the scene, and the person.
//!
//! Frame: the robot's base frame (x forward, y left, z up); SI units. This is the only room that knows the physics engine.

mod articulation;
mod cabinet;
mod contact_impulse;
mod contacts;
mod convert;
mod door;
mod drive;
mod error;
mod even_motion;
mod gap;
mod hook;
mod kinematic_scene;
mod mechanism;
mod object;
mod overlap;
mod parameters;
mod parts;
mod passage;
mod physics;
mod proximity;
mod recent_touches;
mod robot_body;
mod scene;
mod seen;
mod sensors;
mod sight;
mod simulated_world;
mod snapshot;
mod state_trace;
mod virtual_human;
mod watch;

pub use cabinet::{Cabinet, Grip, door_turn, opening_rad};
pub use contacts::{ContactEpisode, Permission};
pub use error::{Overlap, WorldError};
pub use kinematic_scene::{KinematicScene, Placement};
pub use object::{Object, ObjectKind, Solid, support_height_m};
pub use parameters::{Parameters, Quantity};
pub use passage::{NEAR_M, RESOLUTION_M};
pub use physics::PhysicsSettings;
pub use proximity::{Clearance, nearest_of_each};
pub use recent_touches::TouchPoint;
pub use scene::{ObjectPart, PartShape, fixed_parts, object_parts};
pub use sensors::{EffortSensors, SensorSettings};
pub use sight::Shapes;
pub use simulated_world::{World, WorldSettings};
pub use snapshot::{WorldSnapshot, WorldState};
pub use state_trace::{BodyState, QUANTITIES, Quantum, StateTrace};
pub use virtual_human::{GraspState, Hand, HandSnapshot, HandWrench, HumanSettings, pointing_down, tool_orientation};
