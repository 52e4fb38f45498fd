//! Demonstrations without a robot: the pick-and-place task of the paper's section 4.4 with known truth, for tests and examples.
//!
//! Frame: x lateral, y along the travel, z up (m). The hand rises over a first block, hovers over a toy, takes it, rises over a second
//! block and lets go above a basket, in minimum-jerk pieces. Only the blocks' height is a parameter; where the toy lies is not told.

use nalgebra::{DMatrix, Vector3};

use super::{Dataset, Demonstration, ParameterSource, Trajectory};
use crate::math::{exp_map, minimum_jerk, smooth_step, standard_normal, stream};

/// How the synthetic pick-and-place task is demonstrated.
#[derive(Debug, Clone, PartialEq)]
pub struct PickAndPlace {
    /// Block heights that are shown (m).
    pub block_heights_m: Vec<f64>,
    /// Lateral toy positions that are shown at every height (m).
    pub toy_offsets_m: Vec<f64>,
    /// Duration of a demonstration (s).
    pub duration_s: f64,
    /// Sampling rate (Hz).
    pub rate_hz: f64,
    /// Standard deviation of each way-point's time (s): nobody is a clock.
    pub timing_s: f64,
    /// Standard deviation of each way-point per axis (m).
    pub waypoint_m: f64,
    /// Standard deviation of the position sensor (m).
    pub noise_m: f64,
    /// Standard deviation of the force sensor (N).
    pub force_noise_n: f64,
}

impl Default for PickAndPlace {
    /// The nine demonstrations of the paper: three heights, three toy positions, 28 s at 100 Hz.
    fn default() -> Self {
        Self {
            block_heights_m: vec![0.17, 0.20, 0.26],
            toy_offsets_m: vec![-0.06, 0.0, 0.06],
            duration_s: 28.0,
            rate_hz: 100.0,
            timing_s: 0.12,
            waypoint_m: 0.002,
            noise_m: 1e-4,
            force_noise_n: 0.2,
        }
    }
}

/// A point the hand comes to rest at: when, as a fraction of the duration, and where (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waypoint {
    /// Fraction of the duration, 0 to 1.
    pub fraction: f64,
    /// Position (m).
    pub position: Vector3<f64>,
}

/// When the gripper has begun to close and to open (fractions of the duration), and how long either takes.
const CLOSING: f64 = 13.0 / 28.0;
const OPENING: f64 = 27.0 / 28.0;
const GRIPPER_MOVE: f64 = 0.6 / 28.0;
/// Opening of the gripper around the toy (-).
const HOLDING: f64 = 0.3;
/// Weight of the toy (N), felt between closing and opening.
const TOY_WEIGHT_N: f64 = 1.5;

impl PickAndPlace {
    /// The way-points for a block height and a lateral toy position (m): start, block 1, hover, toy, lift, block 2, basket.
    #[must_use]
    pub fn waypoints(block_height_m: f64, toy_offset_m: f64) -> [Waypoint; 7] {
        let over = block_height_m + 0.10;
        [
            (0.0, [0.0, 0.0, 0.25]),
            (6.0, [0.0, 0.20, over]),
            (10.5, [toy_offset_m, 0.40, 0.20]),
            (13.0, [toy_offset_m, 0.40, 0.05]),
            (16.5, [toy_offset_m, 0.40, 0.20]),
            (21.0, [0.0, 0.60, over]),
            (26.5, [0.0, 0.85, 0.25]),
        ]
        .map(|(time, p)| Waypoint { fraction: time / 28.0, position: Vector3::from(p) })
    }

    /// The ideal path (m) for a block height with the toy in the middle, at a fraction of the duration.
    #[must_use]
    pub fn ideal_position(block_height_m: f64, fraction: f64) -> Vector3<f64> {
        position_on(&Self::waypoints(block_height_m, 0.0), fraction)
    }

    /// All demonstrations, every height with every toy position; the same for the same seed.
    #[must_use]
    pub fn dataset(&self, seed: u64) -> Dataset {
        let mut demonstrations = Vec::new();
        for height in &self.block_heights_m {
            for offset in &self.toy_offsets_m {
                demonstrations.push(self.demonstration(*height, *offset, seed, demonstrations.len()));
            }
        }
        let names = |list: [&str; 3]| list.map(str::to_owned).to_vec();
        Dataset {
            motion: names(["x_m", "y_m", "z_m"]),
            wrench: names(["fx_n", "fy_n", "fz_n"]),
            parameter_source: ParameterSource::Given,
            demonstrations,
        }
    }

    fn demonstration(&self, height: f64, offset: f64, seed: u64, index: usize) -> Demonstration {
        let mut human = stream(seed, "synthetic human", index as u64);
        let mut sensor = stream(seed, "synthetic sensor", index as u64);
        let mut waypoints = Self::waypoints(height, offset);
        for waypoint in waypoints.iter_mut().skip(1) {
            waypoint.fraction += self.timing_s / self.duration_s * standard_normal(&mut human);
            waypoint.position += Vector3::from_fn(|_, _| self.waypoint_m * standard_normal(&mut human));
        }
        let lag = waypoints[3].fraction - CLOSING;
        let samples = (self.duration_s * self.rate_hz).round() as usize + 1;
        let mut values = DMatrix::zeros(samples, 11);
        for t in 0..samples {
            let u = t as f64 / (samples - 1) as f64;
            let opening = gripper_at(u, lag);
            let weight = TOY_WEIGHT_N * (1.0 - opening) / (1.0 - HOLDING);
            let turn = exp_map(&Vector3::new(0.0, 0.0, 0.3 * smooth_step(u, 0.1, 0.5)));
            let down = exp_map(&Vector3::new(std::f64::consts::PI, 0.0, 0.0));
            let q = turn * down;
            let p = position_on(&waypoints, u).map(|x| x + self.noise_m * standard_normal(&mut sensor));
            let f = Vector3::new(0.0, 0.0, -weight).map(|x| x + self.force_noise_n * standard_normal(&mut sensor));
            let row = [p.x, p.y, p.z, q.i, q.j, q.k, q.w, f.x, f.y, f.z, opening];
            values.row_mut(t).copy_from_slice(&row);
        }
        let columns = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw", "fx_n", "fy_n", "fz_n", "gripper"];
        let times = (0..samples).map(|t| t as f64 / self.rate_hz).collect();
        let trajectory = Trajectory::unchecked(times, columns.map(str::to_owned).to_vec(), values);
        let name = format!("height_{:02.0}_toy_{index}", height * 100.0);
        Demonstration { name, trajectory, theta_m: vec![("block_height_m".to_owned(), height)], theta_f: Vec::new() }
    }
}

fn position_on(waypoints: &[Waypoint], fraction: f64) -> Vector3<f64> {
    let Some(next) = waypoints.iter().position(|w| w.fraction > fraction) else {
        return waypoints[waypoints.len() - 1].position;
    };
    if next == 0 {
        return waypoints[0].position;
    }
    let (from, to) = (waypoints[next - 1], waypoints[next]);
    let r = (fraction - from.fraction) / (to.fraction - from.fraction);
    from.position.lerp(&to.position, minimum_jerk(r).position)
}

fn gripper_at(fraction: f64, lag: f64) -> f64 {
    let closed = smooth_step(fraction, CLOSING + lag, CLOSING + lag + GRIPPER_MOVE);
    let opened = smooth_step(fraction, OPENING, OPENING + GRIPPER_MOVE);
    1.0 - (1.0 - HOLDING) * (closed - opened)
}
