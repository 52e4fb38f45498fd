//! Forces as arrows in a scene: how long, how thick, and where they start.

use nalgebra::{Point3, Vector3};
use rerun::{Arrows3D, Color};

use super::camera::Camera;

/// Length of an arrow per newton (m/N) up to the force that a helping person pushes with at most (N): 30 cm.
const LENGTH_M_PER_N: f64 = 0.02;
pub(super) const LINEAR_N: f64 = 15.0;

/// No arrow is longer than this (m): a blow of a hundred newtons would leave the picture.
const LONGEST_M: f64 = 0.35;

/// Half the thickness of an arrow (m).
pub(super) const RADIUS_M: f64 = 0.006;

/// From the tool to the start of the first arrow that is felt there, and from one to the next (m): on the way of the tool they would hide it,
/// and each other.
const BESIDE_M: f64 = 0.036;

/// From there towards the eye (m): before the fingers, which would hide it. Where it is seen does not change.
const BEFORE_M: f64 = 0.09;

/// Forces below this are not drawn (N).
pub(super) const SMALLEST_N: f64 = 0.25;

/// Arrows in a scene that is seen by a camera: seen from nearer they are smaller, and look the same.
#[derive(Clone, Copy)]
pub(super) struct Arrow {
    share: f64,
    /// To the upper right of the picture: whether a way leads to the side or upwards, what starts there is beside it.
    aside: Vector3<f64>,
    /// Where the camera is (m, world).
    eye: Vector3<f64>,
}

impl Arrow {
    pub(super) fn seen_by(camera: &Camera) -> Self {
        let (right, sight) = (camera.right(), (camera.target - camera.eye).normalize());
        Self { share: camera.share, aside: (right + right.cross(&sight)).normalize(), eye: camera.eye }
    }

    /// The arrow of a force (m): as long as the force is large, up to the most that a person helps with; of larger ones no longer than can be
    /// seen, and the larger the longer.
    pub(super) fn of(self, force: &Vector3<f64>) -> Vector3<f64> {
        let (size_n, linear_m) = (force.norm(), LENGTH_M_PER_N * LINEAR_N);
        let room_m = LONGEST_M - linear_m;
        let beyond_m = LENGTH_M_PER_N * (size_n - LINEAR_N).max(0.0);
        let length_m = LENGTH_M_PER_N * size_n.min(LINEAR_N) + room_m * (1.0 - (-beyond_m / room_m).exp());
        force.try_normalize(0.0).unwrap_or_default() * length_m * self.share
    }

    /// Where arrow number `number` of those that are felt at a tool starts, from 1 (m, world). Those along a force start beside each other.
    pub(super) fn beside(self, tool: &Point3<f64>, number: u8, force: &Vector3<f64>) -> Point3<f64> {
        let sight = (tool.coords - self.eye).normalize();
        let along = if force.norm() < SMALLEST_N { Vector3::zeros() } else { (force - sight * sight.dot(force)).normalize() };
        let aside = (self.aside - along * along.dot(&self.aside)).try_normalize(1e-3).unwrap_or(self.aside);
        let start = tool + aside * (BESIDE_M * self.share * f64::from(number));
        let to_eye = self.eye - start.coords;
        start + to_eye.normalize() * BEFORE_M.min(to_eye.norm() / 2.0)
    }

    /// What all arrows of one kind have in common.
    pub(super) fn look(self, color: Color) -> Arrows3D {
        Arrows3D::update_fields().with_colors([color]).with_radii([(RADIUS_M * self.share) as f32])
    }
}

#[cfg(test)]
mod tests {
    use super::super::paths::EXECUTED_M;
    use super::*;

    fn arrow(share: f64) -> (Camera, Arrow) {
        let camera = Camera { eye: Vector3::new(1.1, 0.7, 0.3) * share, target: Vector3::new(0.1, 0.0, 0.1), share, words: 1.0 };
        (camera, Arrow::seen_by(&camera))
    }

    /// Contract: 0.02 m per newton up to 15 N; no force whatever is drawn longer than 0.35 m, and a larger one is never drawn shorter.
    #[test]
    fn an_arrow_is_as_long_as_its_force_is_large_and_stays_in_the_picture() {
        let along = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        for share in [1.0, 0.3] {
            let length = |newtons: f64| arrow(share).1.of(&(along * newtons)).norm() / share;
            for newtons in [0.0, 0.3, 7.7, 15.0] {
                assert!((length(newtons) - 0.02 * newtons).abs() < 1e-12, "{newtons} N");
            }
            let lengths: Vec<f64> = (0..100_000).map(|tenths| length(0.1 * f64::from(tenths))).collect();
            assert!(
                lengths.windows(2).all(|pair| pair[1] > pair[0] - 1e-12) && lengths[200] > lengths[150] + 0.03,
                "{:?}",
                &lengths[150..200]
            );
            assert!(lengths.iter().all(|length| *length <= 0.35 + 1e-12));
            // Without a kink.
            assert!(((length(15.001) - length(15.0)) / 0.001 - 0.02).abs() < 1e-3);
        }
        let of = arrow(1.0).1.of(&(along * 70.0));
        assert!((of.normalize() - along).norm() < 1e-12, "it points where the force does");
    }

    /// Contract: seen by the camera, no arrow to the side or upwards lies on a way that leads to the side or upwards, nor on the other arrow.
    #[test]
    fn arrows_lie_on_no_way_and_on_no_other() {
        for share in [1.0, 0.3] {
            let (camera, arrow) = arrow(share);
            let (right, sight) = (camera.right(), (camera.target - camera.eye).normalize());
            // What is seen of where it starts, in the plane of the tool.
            let seen = |number: u8, force: &Vector3<f64>| {
                let to_tool = camera.target - camera.eye;
                let to_start = arrow.beside(&camera.target.into(), number, force) - Point3::from(camera.eye);
                assert!(to_start.norm() < to_tool.norm() - 0.08, "it starts before the tool");
                to_start * (to_tool.norm() / to_start.dot(&sight)) - to_tool
            };
            for angle in [0.0_f64, 0.3, 0.8, 1.5, 2.0, 3.0] {
                let along = right * angle.cos() + right.cross(&sight) * angle.sin();
                let [one, two] = [1, 2].map(|number| seen(number, &(5.0 * along + sight)).cross(&along).norm());
                assert!(two - one > 4.0 * share * RADIUS_M, "{angle}: {one} {two}");
            }
            for along in [right, right.cross(&sight)] {
                let aside = |number: u8| seen(number, &Vector3::zeros()).cross(&along).norm();
                let [thick_m, way_m] = [RADIUS_M, f64::from(EXECUTED_M)].map(|radius_m| share * radius_m);
                assert!(aside(1) > 2.0 * thick_m + way_m, "{} m", aside(1));
                assert!(aside(2) - aside(1) > 4.0 * thick_m, "{} m", aside(2) - aside(1));
            }
        }
    }
}
