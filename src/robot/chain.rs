//! A serial chain: the moving joints between two links of a robot, with everything else that hangs on them lumped in.

use nalgebra::{DMatrix, IsometryMatrix3, Matrix3, Matrix6xX, Vector3};

use super::chain_link::{ChainLink, to_matrix};
use super::lump::lumped_inertias;
use super::model::{Joint, RobotModel};

/// The joints from a base link to a tip link, in order, as the kinematics and dynamics use them (constant; buffers live in [`ChainState`]).
///
/// Poses and vectors are in the frame of the base link (`base`) unless said otherwise. For Baxter's arms `base` is the robot's root.
#[derive(Debug, Clone)]
pub struct SerialChain {
    /// Name of the tip link, whose frame origin is the tip point.
    pub tip_link: String,
    pub(super) links: Vec<ChainLink>,
    pub(super) last_from_tip: IsometryMatrix3<f64>,
}

/// Why no chain could be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ChainError {
    /// No link of this name.
    #[error("the robot has no link called `{0}`")]
    UnknownLink(String),
    /// No joint of this name hangs on the chain.
    #[error("no joint called `{0}` hangs on the chain from `{1}` to `{2}`")]
    UnknownJoint(String, String, String),
    /// The tip does not hang on the base.
    #[error("link `{tip}` does not hang on link `{base}`")]
    NotConnected {
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
    },
    /// Base and tip move as one.
    #[error("no moving joint lies between `{base}` and `{tip}`")]
    NoJoint {
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
    },
}

/// Buffers for one chain: results of the last forward kinematics and room to work in. Made once by [`SerialChain::state`].
#[derive(Debug, Clone)]
pub struct ChainState {
    /// Pose of each joint frame (moved by q) in the base frame, n.
    pub(super) joints: Vec<IsometryMatrix3<f64>>,
    pub(super) tip: IsometryMatrix3<f64>,
    pub(super) jacobian: Matrix6xX<f64>,
    pub(super) mass_matrix: DMatrix<f64>,
    /// Per joint: rotation and offset to the frame before, force and moment of the recursive dynamics.
    pub(super) local: Vec<LocalStep>,
    pub(super) zeros: Vec<f64>,
}

/// What one joint's step of the recursive dynamics leaves for the way back.
#[derive(Debug, Clone)]
pub(super) struct LocalStep {
    pub rotation: Matrix3<f64>,
    pub offset: Vector3<f64>,
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
}

impl SerialChain {
    /// The chain from `base_link` to `tip_link`. Joints that hang on it (gripper fingers) are frozen in the middle of their range and
    /// their bodies lumped into the chain's.
    ///
    /// # Errors
    /// If a link is unknown, the tip does not hang on the base, or no moving joint lies between them.
    pub fn new(model: &RobotModel, base_link: &str, tip_link: &str) -> Result<Self, ChainError> {
        Self::with_frozen(model, base_link, tip_link, &[])
    }

    /// As [`SerialChain::new`], with positions (rad or m) of hanging joints given by name; those that mimic another follow it.
    ///
    /// # Errors
    /// As [`SerialChain::new`], or if a joint named in `frozen` does not hang on the chain.
    pub fn with_frozen(model: &RobotModel, base_link: &str, tip_link: &str, frozen: &[(&str, f64)]) -> Result<Self, ChainError> {
        let unknown = |name: &str| ChainError::UnknownLink(name.to_owned());
        let base = model.frame(base_link).ok_or_else(|| unknown(base_link))?;
        let tip = model.frame(tip_link).ok_or_else(|| unknown(tip_link))?;
        let names = || (base_link.to_owned(), tip_link.to_owned());

        let path = path_to(model, base.body, tip.body).ok_or_else(|| {
            let (base, tip) = names();
            ChainError::NotConnected { base, tip }
        })?;
        if path.is_empty() {
            let (base, tip) = names();
            return Err(ChainError::NoJoint { base, tip });
        }
        let mut q: Vec<f64> = model.joints.iter().map(Joint::middle).collect();
        for &(name, position) in frozen {
            let index = model.joint_index(name).filter(|i| !path.contains(i));
            let (base, tip) = names();
            q[index.ok_or_else(|| ChainError::UnknownJoint(name.to_owned(), base, tip))?] = position;
        }
        let inertias = lumped_inertias(model, &path, &q);
        let mut links: Vec<ChainLink> =
            path.iter().zip(inertias).map(|(&joint, inertia)| ChainLink::new(&model.joints[joint], inertia)).collect();
        links[0].place_in(&base.body_from_frame.inverse());
        Ok(Self { tip_link: tip_link.to_owned(), links, last_from_tip: to_matrix(&tip.body_from_frame) })
    }

    /// Number n of joints.
    pub fn joint_count(&self) -> usize {
        self.links.len()
    }

    /// The joints from base to tip. Body indices are those of the model; the first joint's pose is that in its parent body.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = &Joint> {
        self.links.iter().map(|link| &link.joint)
    }

    /// Mass of all bodies that the chain moves (kg).
    pub fn moving_mass(&self) -> f64 {
        self.links.iter().map(|link| link.inertia.mass).sum()
    }

    /// Buffers for this chain. The only allocation: every computation afterwards runs in them.
    pub fn state(&self) -> ChainState {
        let n = self.joint_count();
        let step = LocalStep { rotation: Matrix3::identity(), offset: Vector3::zeros(), force: Vector3::zeros(), moment: Vector3::zeros() };
        ChainState {
            joints: vec![IsometryMatrix3::identity(); n],
            tip: IsometryMatrix3::identity(),
            jacobian: Matrix6xX::zeros(n),
            mass_matrix: DMatrix::zeros(n, n),
            local: vec![step; n],
            zeros: vec![0.0; n],
        }
    }
}

/// Indices of the joints from body `base` to body `tip`, or nothing if the tip does not hang on the base.
fn path_to(model: &RobotModel, base: usize, tip: usize) -> Option<Vec<usize>> {
    let mut path = Vec::new();
    let mut body = tip;
    while body != base {
        let joint = body.checked_sub(1)?;
        path.push(joint);
        body = model.joints[joint].parent_body;
    }
    path.reverse();
    Some(path)
}
