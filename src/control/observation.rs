//! What the arm measures in one step.

/// The arm's own senses: joint encoders, effort sensors, the gripper's encoder. Nothing about the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Time since the start (s).
    pub time_s: f64,
    /// Joint angles (rad).
    pub position: Vec<f64>,
    /// Joint velocities (rad/s).
    pub velocity: Vec<f64>,
    /// Measured efforts of the drives during the last step (N m), with whatever is wrong with the sensors.
    pub effort: Vec<f64>,
    /// Opening of the gripper (0 closed … 1 open).
    pub gripper_opening: f64,
}

impl Observation {
    /// An observation of `joints` joints, all zero.
    pub fn zero(joints: usize) -> Self {
        Self { time_s: 0.0, position: vec![0.0; joints], velocity: vec![0.0; joints], effort: vec![0.0; joints], gripper_opening: 1.0 }
    }
}
