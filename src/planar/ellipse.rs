//! Exact distances to an ellipse: what decides whether a path collides.
//!
//! The signed distance to a convex body (negative inside: how deep) is a convex function. Along a straight segment its minimum is
//! therefore where its slope changes sign, and bisection finds it; no sample of the path has to come close. Between two points it changes
//! by no more than their distance, which rules out most segments.

/// An ellipse with axes along x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipse {
    /// Its centre (m).
    pub centre_m: [f64; 2],
    /// Its half axes along x and y (m, > 0).
    pub half_axes_m: [f64; 2],
}

impl Ellipse {
    /// Signed distance (m) of a point (m): positive outside, 0 on the rim, negative inside.
    ///
    /// D. Eberly, "Distance from a Point to an Ellipse" (2013): with half axes `a >= b`, the closest point is where `G(q) = 0`.
    #[must_use]
    pub fn signed_distance(&self, point_m: [f64; 2]) -> f64 {
        let closest = self.closest_point(point_m);
        let distance = (point_m[0] - closest[0]).hypot(point_m[1] - closest[1]);
        if self.contains(point_m) { -distance } else { distance }
    }

    /// Smallest signed distance (m) of any point of a polyline (points in m); infinite without a point.
    #[must_use]
    pub fn clearance(&self, polyline_m: &[[f64; 2]]) -> f64 {
        let distances: Vec<f64> = polyline_m.iter().map(|p| self.signed_distance(*p)).collect();
        let mut least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        for (segment, ends) in polyline_m.windows(2).zip(distances.windows(2)) {
            let length = (segment[1][0] - segment[0][0]).hypot(segment[1][1] - segment[0][1]);
            if 0.5 * (ends[0] + ends[1] - length) < least {
                least = least.min(self.least_on([segment[0], segment[1]]));
            }
        }
        least
    }

    fn contains(&self, point_m: [f64; 2]) -> bool {
        let z = [0, 1].map(|i| (point_m[i] - self.centre_m[i]) / self.half_axes_m[i]);
        z[0] * z[0] + z[1] * z[1] < 1.0
    }

    /// The point of the rim that is closest to a point (both m).
    #[must_use]
    pub fn closest_point(&self, point_m: [f64; 2]) -> [f64; 2] {
        let offset = [0, 1].map(|i| point_m[i] - self.centre_m[i]);
        let long = usize::from(self.half_axes_m[1] > self.half_axes_m[0]);
        let (a, b) = (self.half_axes_m[long], self.half_axes_m[1 - long]);
        let [x, y] = closest_in_quadrant(a, b, offset[long].abs(), offset[1 - long].abs());
        let mut closest = [0.0; 2];
        closest[long] = self.centre_m[long] + x.copysign(offset[long]);
        closest[1 - long] = self.centre_m[1 - long] + y.copysign(offset[1 - long]);
        closest
    }

    /// Smallest signed distance on a segment: bisection on the sign of the slope, down to neighbouring numbers.
    fn least_on(&self, [from, to]: [[f64; 2]; 2]) -> f64 {
        let along = [to[0] - from[0], to[1] - from[1]];
        let at = |t: f64| [from[0] + t * along[0], from[1] + t * along[1]];
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let normal = self.outward_normal(at(middle));
            if normal[0] * along[0] + normal[1] * along[1] > 0.0 { high = middle } else { low = middle }
        }
        self.signed_distance(at(0.5 * (low + high)))
    }

    /// Gradient of the signed distance: the rim's outward normal at the closest point, which has no singularity on the rim.
    fn outward_normal(&self, point_m: [f64; 2]) -> [f64; 2] {
        let closest = self.closest_point(point_m);
        [0, 1].map(|i| (closest[i] - self.centre_m[i]) / (self.half_axes_m[i] * self.half_axes_m[i]))
    }
}

/// The closest point of the rim for `x, y >= 0` and half axes `a >= b`, centred.
///
/// With `r = (a/b)^2`, `z = (x/a, y/b)` it is `(r x / (q + r - 1), y / q)` for the root `q > 0` of
/// `G(q) = (r z0 / (q + r - 1))^2 + (z1 / q)^2 - 1`, which falls and is convex: Newton's steps from the left cannot overshoot, and a
/// bracket catches what rounding does.
fn closest_in_quadrant(a: f64, b: f64, x: f64, y: f64) -> [f64; 2] {
    let (r, z0, z1) = ((a / b) * (a / b), x / a, y / b);
    if z1 == 0.0 {
        // On the long axis: between the centres of curvature the closest points leave the axis.
        let cosine = if r > 1.0 { r * z0 / (r - 1.0) } else { f64::INFINITY };
        return if cosine < 1.0 {
            [a * cosine, b * (1.0 - cosine * cosine).sqrt()]
        } else if r > 1.0 || x > 0.0 {
            [a, 0.0]
        } else {
            [0.0, b]
        };
    }
    let (mut low, mut high) = (z1, (r * z0).hypot(z1));
    let mut q = low;
    for _ in 0..200 {
        let (p0, p1) = (r * z0 / (q + r - 1.0), z1 / q);
        let g = p0 * p0 + p1 * p1 - 1.0;
        if g == 0.0 || low >= high {
            break;
        }
        if g > 0.0 {
            low = q
        } else {
            high = q
        }
        let slope = -2.0 * (p0 * p0 / (q + r - 1.0) + p1 * p1 / q);
        let newton = q - g / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - q).abs() <= f64::EPSILON * q {
            break;
        }
        q = next;
    }
    [r * x / (q + r - 1.0), y / q]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{stream, uniform};

    /// Smallest distance to 20,000 points of the rim, refined by parabola-free ternary search around the best.
    fn brute(e: &Ellipse, p: [f64; 2]) -> f64 {
        let distance = |t: f64| {
            let q = [e.centre_m[0] + e.half_axes_m[0] * t.cos(), e.centre_m[1] + e.half_axes_m[1] * t.sin()];
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let step = std::f64::consts::TAU / 20_000.0;
        let best = (0..20_000).min_by(|i, j| distance(*i as f64 * step).total_cmp(&distance(*j as f64 * step))).unwrap();
        let (mut low, mut high) = ((best as f64 - 1.0) * step, (best as f64 + 1.0) * step);
        for _ in 0..200 {
            let (m1, m2) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if distance(m1) < distance(m2) { high = m2 } else { low = m1 }
        }
        distance(0.5 * (low + high))
    }

    #[test]
    fn distances_equal_brute_force_for_round_and_needle_like_ellipses() {
        let mut random = stream(1, "ellipse", 0);
        for case in 0..200 {
            let axes = [0, 1].map(|_| 10f64.powf(uniform(&mut random, -1.5, 1.0)));
            let e = Ellipse { centre_m: [0.3, -0.2], half_axes_m: if case % 10 == 0 { [axes[0]; 2] } else { axes } };
            let mut p = [0, 1].map(|i| e.centre_m[i] + 2.0 * axes[i] * uniform(&mut random, -1.0, 1.0));
            if case % 7 == 0 {
                p[case % 2] = e.centre_m[case % 2];
            }
            let scale = axes[0].max(axes[1]);
            assert!((e.signed_distance(p).abs() - brute(&e, p)).abs() < 1e-10 * scale, "{e:?} {p:?}");
            let rim = e.closest_point(p);
            let on: f64 = [0, 1].map(|i| ((rim[i] - e.centre_m[i]) / e.half_axes_m[i]).powi(2)).iter().sum();
            assert!((on - 1.0).abs() < 1e-12, "{e:?} {p:?}: {on}");
        }
    }

    #[test]
    fn circles_axes_and_centres_are_closed_forms() {
        let circle = Ellipse { centre_m: [0.0; 2], half_axes_m: [2.0; 2] };
        assert!((circle.signed_distance([3.0, 4.0]) - 3.0).abs() < 1e-14);
        assert!((circle.signed_distance([0.0, 0.0]) + 2.0).abs() < 1e-14);
        let e = Ellipse { centre_m: [0.0; 2], half_axes_m: [1.0, 3.0] };
        for (p, distance) in [([0.0, 5.0], 2.0), ([4.0, 0.0], 3.0), ([0.0, 0.0], -1.0), ([1.0, 0.0], 0.0), ([0.0, 2.9], -0.1)] {
            assert!((e.signed_distance(p) - distance).abs() < 1e-12, "{p:?}: {}", e.signed_distance(p));
        }
    }

    #[test]
    fn a_polyline_collides_between_its_points() {
        let e = Ellipse { centre_m: [0.0; 2], half_axes_m: [1.0, 0.5] };
        assert!((e.clearance(&[[-5.0, 0.2], [7.0, 0.2]]) + 0.3).abs() < 1e-12);
        assert!((e.clearance(&[[-5.0, 0.8], [7.0, 0.8]]) - 0.3).abs() < 1e-12);
        assert!((e.clearance(&[[3.0, 0.0]]) - 2.0).abs() < 1e-14 && e.clearance(&[]) == f64::INFINITY);
        let mut random = stream(2, "polyline", 0);
        for _ in 0..100 {
            let ends = [0, 1].map(|_| [0, 1].map(|_| uniform(&mut random, -2.0, 2.0)));
            let dense = (0..=4000).map(|i| f64::from(i) / 4000.0).map(|t| [0, 1].map(|j| ends[0][j] + t * (ends[1][j] - ends[0][j])));
            let sampled = dense.map(|p| e.signed_distance(p)).fold(f64::INFINITY, f64::min);
            let exact = e.clearance(&ends);
            assert!(exact <= sampled + 1e-12 && exact > sampled - 1e-3, "{exact} {sampled}");
        }
    }
}
