//! Compliant parametric dynamic movement primitives: the primitive whose forcing term is a parametric hidden Markov model and whose
//! states say where to yield.
//!
//! ```text
//! tau vdot = K (g - x) - D v - K (g - x0) s + K f(theta_m, s) + zeta(theta_f, s)                             (16)
//! zeta = beta K C (F - F_des(theta_f, s))                                                                    (17)
//! beta_i = -1 if any |B_i^jk| > sigma for two axes j, k, else 0                                              (20)
//! ```

mod compliance;
mod force_coupling;
mod force_model;
mod motion_model;
mod predictive;
mod segments;
mod shaping_function;

pub(super) use compliance::state_spreads;
pub use compliance::{Compliance, ComplianceSettings, Statistic, Threshold};
pub(crate) use force_coupling::JACOBIAN_ROWS;
pub use force_coupling::{CouplingMode, CouplingSettings, CouplingSpace, ForceConvention, ForceCoupling, Switching, wrench_at_tool};
pub use force_model::ForceModel;
pub(super) use motion_model::spatial_columns;
pub use motion_model::{MotionModel, Shaping, spread_unit, squared_unit};
pub use predictive::Predictive;
pub use segments::{ComplianceWindow, Segment, compliance_windows, segments};
pub use shaping_function::ShapingFunction;
