//! What can go wrong with a world.

/// Why a world cannot be built or has stopped.
#[derive(Clone, Debug, thiserror::Error)]
pub enum WorldError {
    /// The robot lacks something that the scene needs.
    #[error("the robot `{robot}` has no {what}; {help}")]
    Robot {
        /// The robot's name.
        robot: String,
        /// What is missing.
        what: String,
        /// What to do about it.
        help: String,
    },
    /// A shape could not be turned into a collider.
    #[error("the collision geometry of `{part}` cannot be used: {reason}")]
    Geometry {
        /// The link or object.
        part: String,
        /// Why.
        reason: String,
    },
    /// Things stand inside each other before the first step.
    #[error("at the start {}: move the objects or the arm apart", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    Overlap(Vec<Overlap>),
    /// A body's state left the finite numbers.
    #[error("the simulation diverged at step {step} ({time_s:.3} s): body {body} is no longer finite{}; try a smaller `step_s`", told(.fastest))]
    Diverged {
        /// Number of the step.
        step: u64,
        /// Its time (s).
        time_s: f64,
        /// The first body.
        body: String,
        /// The bodies that were fastest when they were last finite, the fastest first, with their speeds (m/s).
        fastest: Vec<(String, f64)>,
    },
}

/// Two parts one of which is inside the other.
#[derive(Clone, Debug, thiserror::Error)]
#[error("`{a}` is {:.1} mm inside `{b}`", .depth_m * 1e3)]
pub struct Overlap {
    /// A link, an object, or an object's part: `block.left_post`.
    pub a: String,
    /// The other.
    pub b: String,
    /// How deep (m).
    pub depth_m: f64,
}

fn told(fastest: &[(String, f64)]) -> String {
    let each: Vec<String> = fastest.iter().map(|(body, speed)| format!("{body} {speed:.3e} m/s")).collect();
    if each.is_empty() { " (everything was at rest before)".to_owned() } else { format!(" (fastest before: {})", each.join(", ")) }
}
