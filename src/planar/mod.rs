//! The paper's two simulated experiments: movements in a plane past an elliptic obstacle, learned by CPDMP and by its rivals.
//!
//! ```text
//! settings, seed ─hand→ demonstrations ─learning→ skills, TP-GMM ─→ movements for taught and new situations ─ellipse→ PlanarOutcome
//! ```
//!
//! [`obstacle_avoidance()`] is section 4.1 (goals beyond the taught ones, beside LWR-DMP), [`two_sided_obstacle()`] is section 4.2 (two
//! widths, two sides; beside TP-GMM). Both are functions from settings and a seed to data: nothing is written, drawn or printed here.
//!
//! Frame: x to the right, y along the movement (m), the obstacle's centre in the origin. Positive x is the right side. The paper's tasks
//! have no unit; here an obstacle is about 1 m in half width.

mod case;
mod ellipse;
mod forcing;
mod hand;
mod method;
mod obstacle_avoidance;
mod obstacles;
mod outcome;
mod reproduction;
mod rival;
mod two_sided_obstacle;
mod two_sided_settings;

pub use case::{Case, Ideal, Movement, Novelty};
pub use ellipse::Ellipse;
pub use forcing::{ForcingCurve, StateGaussian, demonstrated_forcing, forcing_curve};
pub use hand::{COLUMNS, HandPath, HandSettings};
pub use method::{Guidance, Method, Side, chain_color};
pub use obstacle_avoidance::{ObstacleAvoidanceSettings, obstacle_avoidance};
pub use obstacles::{Obstacle, obstacles, rank};
pub use outcome::{LearnedSkill, ModelReport, PlanarOutcome, Shown, Transitions};
pub use two_sided_obstacle::two_sided_obstacle;
pub use two_sided_settings::TwoSidedObstacleSettings;
