//! Inverse dynamics and mass matrix of a serial chain: M(q) a + h(q, v) = tau.
//!
//! Joint damping and friction are not part of these equations; they are in [`Joint`](super::Joint) for whoever simulates them.

use nalgebra::{DMatrix, IsometryMatrix3, Matrix3, Vector3};

use super::chain::{ChainState, LocalStep, SerialChain};
use super::chain_link::ChainLink;

impl SerialChain {
    /// Joint efforts `tau` (N m or N, n) that move the chain with accelerations `a` at positions `q` and velocities `v` (n each) under
    /// `gravity` (m/s², base axes, e.g. [0, 0, -9.81]): recursive Newton-Euler (Luh, Walker, Paul 1980), each body in its own frame.
    ///
    /// Going out, with w, dw, dv the angular velocity, its rate and the acceleration of the frame's origin (dv = -gravity at the base):
    /// F = m (dv + dw x c + w x (w x c)), N = I dw + w x I w. Back: f_i = F_i + f_(i+1), n_i = N_i + c x F_i + n_(i+1) + p x f_(i+1).
    ///
    /// # Panics
    /// If a slice has not n entries or `state` belongs to a chain of another length.
    pub fn inverse_dynamics(&self, q: &[f64], v: &[f64], a: &[f64], gravity: &Vector3<f64>, state: &mut ChainState, tau: &mut [f64]) {
        let n = self.joint_count();
        assert!([q.len(), v.len(), a.len(), tau.len()] == [n; 4], "one entry per joint");
        newton_euler(&self.links, q, v, a, gravity, &mut state.local, tau);
    }

    /// Joint efforts `tau` (N m or N, n) that hold the chain still at `q` against `gravity` (m/s², base axes).
    ///
    /// # Panics
    /// As [`SerialChain::inverse_dynamics`].
    pub fn gravity_torques(&self, q: &[f64], gravity: &Vector3<f64>, state: &mut ChainState, tau: &mut [f64]) {
        let n = self.joint_count();
        assert!([q.len(), tau.len()] == [n; 2], "one entry per joint");
        let ChainState { zeros, local, .. } = state;
        newton_euler(&self.links, q, zeros, zeros, gravity, local, tau);
    }

    /// Mass matrix M(q), n x n, symmetric and positive definite: composite rigid bodies (Walker and Orin 1982), all about the base origin.
    ///
    /// Also leaves the joint poses at `q` in `state`, but not the Jacobian.
    ///
    /// # Panics
    /// If `q` has not n entries or `state` belongs to a chain of another length.
    pub fn mass_matrix<'a>(&self, q: &[f64], state: &'a mut ChainState) -> &'a DMatrix<f64> {
        self.joint_poses(q, state);
        let mut composite = Composite::default();
        for i in (0..self.joint_count()).rev() {
            composite.add(&self.links[i], &state.joints[i]);
            let (linear, angular) = composite.momentum(&unit_twist(&self.links[i], &state.joints[i]));
            for j in 0..=i {
                let (velocity, rate) = unit_twist(&self.links[j], &state.joints[j]);
                let entry = velocity.dot(&linear) + rate.dot(&angular);
                state.mass_matrix[(i, j)] = entry;
                state.mass_matrix[(j, i)] = entry;
            }
        }
        &state.mass_matrix
    }
}

fn newton_euler(links: &[ChainLink], q: &[f64], v: &[f64], a: &[f64], gravity: &Vector3<f64>, steps: &mut [LocalStep], tau: &mut [f64]) {
    assert_eq!(steps.len(), links.len(), "state of another chain");
    let (mut w, mut dw, mut dv) = (Vector3::zeros(), Vector3::zeros(), -gravity);
    for (i, (link, step)) in links.iter().zip(steps.iter_mut()).enumerate() {
        let axis = link.axis().into_inner();
        let (rotation, p) = link.local_pose(q[i]);
        let back = rotation.transpose();
        dv = back * (dv + dw.cross(&p) + w.cross(&w.cross(&p)));
        w = back * w;
        dw = back * dw;
        if link.is_prismatic() {
            dv += axis * a[i] + w.cross(&axis) * (2.0 * v[i]);
        } else {
            dw += axis * a[i] + w.cross(&axis) * v[i];
            w += axis * v[i];
        }
        let inertia = &link.inertia;
        let (c, about_center) = (&inertia.center, &inertia.about_center);
        let force = (dv + dw.cross(c) + w.cross(&w.cross(c))) * inertia.mass;
        let moment = about_center * dw + w.cross(&(about_center * w)) + c.cross(&force);
        *step = LocalStep { rotation, offset: p, force, moment };
    }
    let (mut f, mut n) = (Vector3::zeros(), Vector3::zeros());
    for (i, (link, step)) in links.iter().zip(steps.iter()).enumerate().rev() {
        f += step.force;
        n += step.moment;
        let along = if link.is_prismatic() { &f } else { &n };
        tau[i] = link.axis().dot(along);
        f = step.rotation * f;
        n = step.rotation * n + step.offset.cross(&f);
    }
}

/// Velocity of the body point at the base origin and angular velocity, base axes, when the joint at `pose` moves at unit rate.
fn unit_twist(link: &ChainLink, pose: &IsometryMatrix3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let z = pose.rotation * link.axis().into_inner();
    if link.is_prismatic() { (z, Vector3::zeros()) } else { (pose.translation.vector.cross(&z), z) }
}

/// Bodies from some joint to the tip as one rigid body: mass, first moment m c and inertia about the base origin, base axes.
#[derive(Default)]
struct Composite {
    mass: f64,
    first_moment: Vector3<f64>,
    inertia: Matrix3<f64>,
}

impl Composite {
    fn add(&mut self, link: &ChainLink, pose: &IsometryMatrix3<f64>) {
        let part = &link.inertia;
        let c = pose.rotation * part.center + pose.translation.vector;
        let rotation = pose.rotation.matrix();
        self.mass += part.mass;
        self.first_moment += c * part.mass;
        self.inertia +=
            rotation * part.about_center * rotation.transpose() + (Matrix3::identity() * c.norm_squared() - c * c.transpose()) * part.mass;
    }

    /// Momentum and angular momentum about the base origin at a twist there.
    fn momentum(&self, (velocity, rate): &(Vector3<f64>, Vector3<f64>)) -> (Vector3<f64>, Vector3<f64>) {
        let linear = velocity * self.mass + rate.cross(&self.first_moment);
        let angular = self.first_moment.cross(velocity) + self.inertia * rate;
        (linear, angular)
    }
}
