//! The controller's knowledge of its arm: kinematics and dynamics with their buffers.

use nalgebra::{Isometry3, Matrix6xX, Vector3, Vector6};

use crate::robot::{ChainError, ChainState, FollowSettings, IkOutcome, IkSettings, InverseKinematics, Joint, RobotModel, SerialChain};

/// Why a robot has no such arm.
pub type ArmModelError = ChainError;

/// An arm from the robot's root to its tool. Nothing here allocates after construction.
#[derive(Clone, Debug)]
pub struct ArmModel {
    pub(super) chain: SerialChain,
    pub(super) state: ChainState,
    inverse: InverseKinematics,
    /// Gravity in the base frame (m/s²).
    pub(super) gravity: Vector3<f64>,
    /// The posture that the null space is drawn to (rad).
    rest_rad: Vec<f64>,
}

impl ArmModel {
    /// The arm of `robot` whose tip is the link `tool`, drawn to `rest_rad`, under `gravity` (m/s², base frame).
    ///
    /// # Errors
    /// When the robot has no such link, or no joint moves it.
    pub fn new(robot: &RobotModel, tool: &str, rest_rad: &[f64], gravity: [f64; 3]) -> Result<Self, ArmModelError> {
        let root = robot.frames.iter().find(|frame| frame.body == 0).map_or("", |frame| frame.name.as_str());
        let chain = SerialChain::new(robot, root, tool)?;
        let state = chain.state();
        let inverse = InverseKinematics::new(&chain, IkSettings::default());
        Ok(Self { chain, state, inverse, gravity: Vector3::from(gravity), rest_rad: rest_rad.to_vec() })
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.chain.joint_count()
    }

    /// Name of joint `index`.
    pub fn joint_name(&self, index: usize) -> &str {
        self.chain.joints().nth(index).map_or("", |joint| joint.name.as_str())
    }

    /// Torques (N m) that hold the arm against gravity at `q` (rad).
    pub fn gravity_torques(&mut self, q: &[f64], torque: &mut [f64]) {
        self.chain.gravity_torques(q, &self.gravity, &mut self.state, torque);
    }

    /// `base_from_tool` at `q` (rad).
    pub fn tool_pose(&mut self, q: &[f64]) -> Isometry3<f64> {
        self.chain.forward_kinematics(q, &mut self.state);
        self.state.tip_pose()
    }

    /// The joints, from the shoulder.
    pub fn chain_joints(&self) -> impl Iterator<Item = &Joint> {
        self.chain.joints()
    }

    /// Finds joint angles for `base_from_tool`, starting at those in `q`, which holds the best posture met afterwards.
    pub fn reach_from(&mut self, base_from_tool: &Isometry3<f64>, q: &mut [f64]) -> IkOutcome {
        self.inverse.solve(&self.chain, base_from_tool, &self.rest_rad, q, &mut self.state)
    }

    /// The Jacobian at the tool point (6 x n, base axes) at the angles of the last [`Self::tool_pose`].
    pub fn jacobian(&self) -> &Matrix6xX<f64> {
        self.state.jacobian()
    }

    /// Twist of the tool (m/s, rad/s, base axes) at `v` (rad/s), at the angles of the last [`Self::tool_pose`].
    pub fn tool_twist(&self, v: &[f64]) -> Vector6<f64> {
        self.chain.tip_twist(v, &self.state)
    }

    /// Finds joint angles for `base_from_tool`, starting at the rest posture; `q` holds the best posture met.
    pub fn reach(&mut self, base_from_tool: &Isometry3<f64>, q: &mut [f64]) -> IkOutcome {
        q.copy_from_slice(&self.rest_rad);
        self.inverse.solve(&self.chain, base_from_tool, &self.rest_rad, q, &mut self.state)
    }

    /// As [`Self::reach`], starting at the posture in `q`: the nearest posture, in which the arm need not change its branch.
    pub fn reach_on(&mut self, base_from_tool: &Isometry3<f64>, q: &mut [f64]) -> IkOutcome {
        self.inverse.solve(&self.chain, base_from_tool, &self.rest_rad, q, &mut self.state)
    }

    /// Name of the joint that is nearest to one of its limits at `q` (rad).
    pub fn nearest_to_limit(&self, q: &[f64]) -> &str {
        let room = |(joint, q): &(&Joint, &f64)| (joint.upper - **q).min(**q - joint.lower);
        let nearest = self.chain.joints().zip(q).min_by(|a, b| room(a).total_cmp(&room(b)));
        nearest.map_or("", |(joint, _)| joint.name.as_str())
    }

    /// Joint velocities (rad/s) that make the tool follow `target`, which moves with `twist` (m/s, rad/s, base axes): one control tick.
    pub fn follow(&mut self, target: &Isometry3<f64>, twist: &Vector6<f64>, step_s: f64, q: &[f64], v: &mut [f64]) {
        let settings = FollowSettings::default();
        self.inverse.follow(&self.chain, (target, twist), &self.rest_rad, &settings, step_s, q, &mut self.state, v);
    }
}
