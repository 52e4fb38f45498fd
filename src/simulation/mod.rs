//! Experiments: teach, replay, learn, execute. The only room that knows both the world and the controllers.
//!
//! Data flows one way: an [`Experiment`] goes in, a [`RunOutcome`] comes out, and everything told about a step is a [`StepRecord`].

mod arm_columns;
mod arm_motion;
mod astray;
mod beside;
mod changed_scene;
mod error;
mod execution;
mod experiment;
mod guide_path;
mod joint_limits;
mod lesson_record;
mod motion_check;
mod motion_columns;
mod named_parts;
mod outcome;
mod person;
mod preflight;
mod progress;
mod reachable;
mod replay;
mod run;
mod setup;
mod snapshot;
mod space;
mod standing;
mod step_loop;
mod step_record;
mod teaching;
mod trace;

pub use arm_motion::{ArmMotion, Reach};
pub use beside::{Beside, Variation, execute_beside};
pub use changed_scene::moved_otherwise;
pub use error::SimulationError;
pub use experiment::{DemonstrationSource, ExecutionPlan, Experiment, Help, MotionSpace, NamedPart, RobotSettings, TeachingPlan, Waypoint};
pub use lesson_record::{LOOKS_HZ, LessonLook, LessonRecord};
pub use motion_check::{JointExtreme, MotionOutcome, check_motion};
pub use motion_columns::check_columns;
pub use outcome::{AppliedForce, FinalObject, PhaseSummary, RunOutcome};
pub use progress::{Progress, Silent};
pub use run::{History, demonstrate, execute_again, perform, resume, run};
pub use setup::Setup;
pub use snapshot::{Snapshot, Snapshots};
pub use step_record::{StepRecord, skill_duration_s};
pub use trace::{TraceDetail, TraceSettings, WorldTrace};
