//! Why an experiment could not be carried out.

use super::RunOutcome;
use crate::control::{ArmModelError, UnmeasuredWrench};
use crate::demonstration::DemonstrationError;
use crate::learning::LearningError;
use crate::robot::UrdfError;
use crate::world::WorldError;

/// Why an experiment could not be carried out.
#[derive(Debug, thiserror::Error)]
pub enum SimulationError {
    /// The robot's description cannot be used.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// The robot lacks an arm or a link.
    #[error(transparent)]
    Arm(#[from] ArmModelError),
    /// A pose of the plan cannot be reached.
    #[error("{what} cannot be reached: the arm ends {position_mm:.1} mm and {angle_deg:.1} deg away, {joint}; {help}")]
    Unreachable {
        /// Which pose.
        what: String,
        /// How far it stays away (mm).
        position_mm: f64,
        /// By how much it is turned (deg).
        angle_deg: f64,
        /// The joint that stops it, in words.
        joint: String,
        /// What to do.
        help: &'static str,
    },
    /// On the way from one pose of the plan to the next, the arm would have to swing into another posture.
    #[error(
        "{what} cannot be reached without swinging the arm: joint `{joint}` would turn by {turn_deg:.0} deg within {within_s} s; {help}, or give another `robot.rest_posture_rad`"
    )]
    Swing {
        /// Which pose.
        what: String,
        /// The joint that turns furthest.
        joint: String,
        /// How far (deg).
        turn_deg: f64,
        /// In which time (s).
        within_s: f64,
        /// What to do.
        help: &'static str,
    },
    /// Postures are beyond the limits of joints, one sentence each.
    #[error("{}", .0.join("\n"))]
    JointLimits(Vec<String>),
    /// What is wrong comes from one part of the scenario.
    #[error("{error}")]
    At {
        /// The part, called as in `--set`: `object.toy`, `teaching.waypoint.2` (counted from 0).
        key: String,
        /// What is wrong.
        error: Box<SimulationError>,
    },
    /// Several things are wrong at once.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Several(Vec<SimulationError>),
    /// The skill takes a wrench that the arm does not measure.
    #[error(transparent)]
    Wrench(#[from] UnmeasuredWrench),
    /// An execution cannot be taken up from what was kept of it.
    #[error("the snapshot cannot be used: {0}; run again without it")]
    Snapshot(String),
    /// The world could not be built, or diverged.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The demonstrations cannot be used.
    #[error(transparent)]
    Demonstrations(#[from] DemonstrationError),
    /// Nothing could be learned.
    #[error(transparent)]
    Learning(#[from] LearningError),
    /// Whoever listens to the run did not let it go on.
    #[error("the time limit was reached {time_s:.3} s into the simulated time of the phase `{phase}`: allow more, or ask for less")]
    Stopped {
        /// `teach`, `replay` or `execute`.
        phase: &'static str,
        /// How far the world was (s).
        time_s: f64,
    },
    /// Whoever listens to the run did not let it go on before something was simulated.
    #[error("the time limit was reached before {next}: allow more, or ask for less")]
    StoppedBefore {
        /// What would have come next.
        next: String,
    },
    /// The execution ended before its time, and left something behind.
    #[error("{reason}")]
    CutShort {
        /// Why: the simulation diverged, or was stopped.
        reason: Box<SimulationError>,
        /// What there is up to the last good step: nothing in it is judged.
        left: Box<RunOutcome>,
    },
    /// The scene cannot be as described.
    #[error("{0}")]
    Scene(String),
    /// The recorded demonstrations do not fit the experiment.
    #[error("the demonstrations do not fit the scenario: {0}")]
    Mismatch(String),
    /// A movement that is to be judged does not fit the robot.
    #[error("the trajectory cannot be judged: {0}")]
    Trajectory(String),
}

impl SimulationError {
    /// The same, said of the part `key` of the scenario.
    pub(super) fn at(self, key: impl Into<String>) -> Self {
        Self::At { key: key.into(), error: Box::new(self) }
    }

    /// The same, said of the part `key` of the scenario, if it is known.
    pub(super) fn at_if(self, key: Option<String>) -> Self {
        match key {
            Some(key) => self.at(key),
            None => self,
        }
    }

    /// All of them as one.
    ///
    /// # Errors
    /// When there are any.
    pub(super) fn all(mut errors: Vec<Self>) -> Result<(), Self> {
        match errors.len() {
            0 => Ok(()),
            1 => Err(errors.remove(0)),
            _ => Err(Self::Several(errors)),
        }
    }

    /// The errors that it is made of.
    pub(super) fn split(self) -> Vec<Self> {
        match self {
            Self::Several(errors) => errors.into_iter().flat_map(Self::split).collect(),
            one => vec![one],
        }
    }

    /// The single faults that it tells of, each with the part of the scenario from which it comes, if that is known.
    #[must_use]
    pub fn parts(&self) -> Vec<(Option<&str>, &Self)> {
        match self {
            Self::Several(errors) => errors.iter().flat_map(Self::parts).collect(),
            Self::At { key, error } => error.parts().into_iter().map(|(inner, error)| (inner.or(Some(key)), error)).collect(),
            _ => vec![(None, self)],
        }
    }
}
