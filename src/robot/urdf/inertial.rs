//! The structural check of masses and inertias: what no rigid body can have is an error, what few have is a warning.

use nalgebra::Matrix3;
use roxmltree::Node;

use super::elements::Check;
use super::outline::child;

/// Radius of gyration (m) above which an inertia was probably given in other units than its mass.
const LARGEST_GYRATION: f64 = 2.0;
/// Distance (m) of a centre of mass from its link's origin above which it was probably given in millimetres.
const FARTHEST_CENTER: f64 = 2.0;
/// Density (kg/m^3) of osmium, the densest matter there is on Earth.
const OSMIUM: f64 = 22_590.0;
/// Relative shortfall of the triangle inequality put down to rounding in the file.
const TRIANGLE_ROUNDING: f64 = 1e-3;

impl Check<'_> {
    pub(super) fn inertial(&mut self, inertial: Node<'_, '_>) {
        self.at_most_one(inertial, &["origin", "mass", "inertia"]);
        let distance = self.origin(inertial).map_or(0.0, |center| center.iter().map(|x| x * x).sum::<f64>().sqrt());
        if distance > FARTHEST_CENTER {
            self.warning(inertial, format!("the centre of mass is {distance:.3} m from the link's origin"), "metres are expected");
        }
        let mass = match child(inertial, "mass") {
            Some(mass) => self.required_number(mass, "value"),
            None => {
                self.error(inertial, "has no <mass>", "");
                None
            }
        };
        let inertia = match child(inertial, "inertia") {
            Some(inertia) => self.inertia(inertia),
            None => {
                self.error(inertial, "has no <inertia>", "");
                None
            }
        };
        if let (Some(mass), Some(inertia)) = (mass, inertia) {
            self.mass_and_inertia(inertial, mass, &inertia);
        }
    }

    fn inertia(&mut self, node: Node<'_, '_>) -> Option<Matrix3<f64>> {
        let [xx, xy, xz, yy, yz, zz] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(|name| self.required_number(node, name));
        Some(Matrix3::new(xx?, xy?, xz?, xy?, yy?, yz?, xz?, yz?, zz?))
    }

    fn mass_and_inertia(&mut self, node: Node<'_, '_>, mass: f64, inertia: &Matrix3<f64>) {
        if mass < 0.0 {
            return self.error(node, format!("mass is negative: {mass} kg"), "");
        }
        if mass == 0.0 && inertia.norm() == 0.0 {
            return self.warning(node, "no mass and no inertia: taken for a mere frame", "leave <inertial> out");
        }
        if mass == 0.0 {
            return self.error(node, "no mass, yet an inertia", "give the mass (kg)");
        }
        let mut principal = inertia.symmetric_eigenvalues();
        principal.as_mut_slice().sort_by(f64::total_cmp);
        let [small, middle, large] = principal.into();
        let moments = format!("principal moments {small:.4e}, {middle:.4e}, {large:.4e} kg m^2");
        if small <= 0.0 {
            self.error(node, format!("inertia is not positive definite: {moments}"), "check signs and units");
        } else if small + middle < large * (1.0 - TRIANGLE_ROUNDING) {
            let message = format!("inertia belongs to no rigid body, the largest moment exceeds the sum of the others: {moments}");
            self.error(node, message, "the inertia must be about the centre of mass");
        } else if (large / mass).sqrt() > LARGEST_GYRATION {
            let gyration = (large / mass).sqrt();
            let power = 2.0 * (gyration / 0.1).log10().round();
            let message = format!("a mass of {mass} kg with {moments} is spread over {gyration:.3} m");
            self.warning(node, message, &format!("kg m^2 are expected; a factor of 1e-{power} would be plausible"));
        } else if least_density(mass, principal.sum() / 2.0) > OSMIUM {
            let message = format!("a mass of {mass} kg with {moments} is denser than any matter");
            self.warning(node, message, "kg and kg m^2 are expected: the mass is too large, or the inertia too small");
        }
    }
}

/// What a body of that mass (kg) has somewhere at least as its density (kg/m^3), when the integral of the squared distance from its centre of
/// mass is `moment` (kg m^2): that of a ball, since no body of one density keeps its mass nearer to its centre.
fn least_density(mass: f64, moment: f64) -> f64 {
    let radius = (5.0 / 3.0 * moment / mass).sqrt();
    mass / (4.0 / 3.0 * std::f64::consts::PI * radius.powi(3))
}

#[cfg(test)]
mod tests {
    use super::least_density;

    /// A ball of 0.3 m and 1000 kg/m^3 by closed forms; of the same mass, a rod is looser.
    #[test]
    fn a_ball_has_the_least_density_itself() {
        let mass = 1000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.027;
        let about_diameter = 0.4 * mass * 0.09;
        assert!((least_density(mass, 1.5 * about_diameter) / 1000.0 - 1.0).abs() < 1e-12);
        let about_the_middle_of_a_rod = mass * 1.0 / 12.0;
        assert!(least_density(mass, about_the_middle_of_a_rod) < 1000.0);
    }
}
