//! Dynamic movement primitives: a spring to the goal, bent by a learned forcing term that runs on a phase.
//!
//! ```text
//! tau vdot = K (g - x) - D v - K (g - x0) s + K f(s) + zeta                                                   (1), (11), (16)
//! tau xdot = v                                                                                                (2)
//! tau sdot = -alpha s                                                                                         (3)
//! ```
//!
//! with `D = 2 sqrt(K)` (critical damping). Written with the point the spring pulls to,
//! `x_eq(s) = g + f(s) - (g - x0) s`, the first is `tau vdot = K (x_eq - x) - D v + zeta`. `K` has no unit (it multiplies m in an
//! equation in m); the spring's angular frequency is `omega = sqrt(K) / tau` (rad/s).

mod canonical_system;
mod forcing_target;
mod lwr;
mod transformation_system;

pub use canonical_system::{CanonicalSystem, DEFAULT_ALPHA, PhaseInput};
pub use forcing_target::forcing_target;
pub use lwr::Lwr;
pub use transformation_system::{Integrator, Motion, TransformationSystem};
