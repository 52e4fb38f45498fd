//! Forward kinematics and the geometric Jacobian of a serial chain.
//!
//! Twist and wrench conventions of the whole room: six numbers, linear before angular, along the axes of the base frame, at the tip point.

use nalgebra::{Isometry3, IsometryMatrix3, Matrix6, Matrix6xX, Rotation3, UnitQuaternion, Vector6};

use super::chain::{ChainState, SerialChain};

impl SerialChain {
    /// Poses of all joint frames and of the tip in the base frame at positions `q` (rad or m, n), and the Jacobian at the tip.
    ///
    /// Column i of the Jacobian is [z x (p_tip - p_i); z] for a turning and [z; 0] for a sliding joint with axis z through p_i.
    ///
    /// # Panics
    /// If `q` has not n entries or `state` belongs to a chain of another length.
    pub fn forward_kinematics(&self, q: &[f64], state: &mut ChainState) {
        self.joint_poses(q, state);
        let p_tip = state.tip.translation.vector;
        for (i, link) in self.links.iter().enumerate() {
            let z = state.joints[i].rotation * link.axis().into_inner();
            let (linear, angular) =
                if link.is_prismatic() { (z, z * 0.0) } else { (z.cross(&(p_tip - state.joints[i].translation.vector)), z) };
            state.jacobian.fixed_view_mut::<3, 1>(0, i).copy_from(&linear);
            state.jacobian.fixed_view_mut::<3, 1>(3, i).copy_from(&angular);
        }
    }

    /// Twist of the tip (m/s, rad/s) for joint velocities `v` (n), by the Jacobian of the last forward kinematics.
    ///
    /// # Panics
    /// If `v` has not n entries.
    pub fn tip_twist(&self, v: &[f64], state: &ChainState) -> Vector6<f64> {
        assert_eq!(v.len(), self.joint_count(), "one velocity per joint");
        let columns = state.jacobian.column_iter();
        columns.zip(v).fold(Vector6::zeros(), |sum, (column, &rate)| sum + column * rate)
    }

    pub(super) fn joint_poses(&self, q: &[f64], state: &mut ChainState) {
        assert_eq!(q.len(), self.joint_count(), "one position per joint");
        assert_eq!(state.joints.len(), self.joint_count(), "state of another chain");
        let mut pose = IsometryMatrix3::identity();
        for ((link, &q), joint) in self.links.iter().zip(q).zip(&mut state.joints) {
            let (rotation, origin) = link.local_pose(q);
            pose *= IsometryMatrix3::from_parts(origin.into(), Rotation3::from_matrix_unchecked(rotation));
            *joint = pose;
        }
        state.tip = pose * self.last_from_tip;
    }
}

impl ChainState {
    /// Pose of the tip frame in the base frame.
    pub fn tip_pose(&self) -> Isometry3<f64> {
        to_quaternion(&self.tip)
    }

    /// Pose of the frame of joint `i`, moved by its position, in the base frame.
    ///
    /// # Panics
    /// If there is no joint `i`.
    pub fn joint_pose(&self, i: usize) -> Isometry3<f64> {
        to_quaternion(&self.joints[i])
    }

    /// Geometric Jacobian at the tip point, 6 x n: linear (m per rad or m) above angular (rad per rad or m), base axes.
    pub fn jacobian(&self) -> &Matrix6xX<f64> {
        &self.jacobian
    }

    /// J Jᵀ.
    pub fn jacobian_gram(&self) -> Matrix6<f64> {
        let columns = self.jacobian.column_iter();
        columns.fold(Matrix6::zeros(), |sum, column| sum + column * column.transpose())
    }

    /// Manipulability sqrt(det(J Jᵀ)) (Yoshikawa 1985): zero in a singular posture; about 0.1 in the middle of Baxter's workspace.
    pub fn manipulability(&self) -> f64 {
        self.jacobian_gram().determinant().max(0.0).sqrt()
    }
}

fn to_quaternion(pose: &IsometryMatrix3<f64>) -> Isometry3<f64> {
    Isometry3::from_parts(pose.translation, UnitQuaternion::from_rotation_matrix(&pose.rotation))
}
