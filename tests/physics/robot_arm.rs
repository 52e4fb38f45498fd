//! What the tests of the robot room share: the left arm, postures spread over its range, and the official description where it is at hand.

use std::path::PathBuf;
use std::sync::LazyLock;

use cpdmp::robot::{LoadOptions, RobotModel, SerialChain, baxter, load};
use nalgebra::Vector3;

/// Baxter with the gripper, read once.
pub static BAXTER: LazyLock<RobotModel> = LazyLock::new(|| baxter().model);

pub const GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

/// The left arm with the electric gripper, tip between its pads.
pub fn left_arm() -> SerialChain {
    SerialChain::new(&BAXTER, baxter::BASE_LINK, baxter::LEFT_TOOL).unwrap()
}

/// Numbers from -1 to 1 that look random and are the same everywhere (splitmix64).
pub struct Spread(u64);

impl Spread {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// `n` numbers up to `size`.
    pub fn vector(&mut self, n: usize, size: f64) -> Vec<f64> {
        (0..n).map(|_| size * self.next()).collect()
    }

    /// A posture within the limits of `arm`.
    pub fn posture(&mut self, arm: &SerialChain) -> Vec<f64> {
        arm.joints().map(|joint| joint.middle() + 0.5 * (joint.upper - joint.lower) * self.next()).collect()
    }
}

/// The official Baxter description, which a stranger does not have.
pub fn official_path() -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/baxter_description/urdf/baxter.urdf");
    let found = path.is_file().then_some(path);
    if found.is_none() {
        eprintln!("skipped: no official Baxter description beside the checkout");
    }
    found
}

pub fn official() -> Option<RobotModel> {
    Some(load(&official_path()?, &LoadOptions::default()).unwrap().model)
}

/// Largest difference between two lists of numbers.
pub fn distance<'a>(a: impl IntoIterator<Item = &'a f64>, b: impl IntoIterator<Item = &'a f64>) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
