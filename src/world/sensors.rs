//! What the arm measures of itself, with a real Baxter's faults: effort noise, effort bias and joints that stick.

use rand_chacha::ChaCha8Rng;

use crate::math;
use crate::robot::EffortModel;

/// Faults of the joints' effort sensors and of the joints themselves. Zero switches one off.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorSettings {
    /// Standard deviation of the white noise on each joint's effort, at every step (N m), 0 … 5. Default 0.05.
    pub effort_noise_nm: f64,
    /// Standard deviation of the constant offset of each joint's effort, drawn once per robot (N m), 0 … 5. Default 0.1.
    pub effort_bias_nm: f64,
    /// Dry (Coulomb) friction of each joint (N m), 0 … 5: the sensor sits before it and does not see it. Default 0.1.
    pub dry_friction_nm: f64,
    /// What the wrench estimate subtracts from the measured efforts.
    pub model: EffortModel,
    /// Cut-off of the first-order low-pass on the wrench estimate (Hz), 0.1 … 500; infinite for none. Default 5.
    pub filter_cutoff_hz: f64,
}

impl Default for SensorSettings {
    fn default() -> Self {
        Self { effort_noise_nm: 0.05, effort_bias_nm: 0.1, dry_friction_nm: 0.1, model: EffortModel::GravityOnly, filter_cutoff_hz: 5.0 }
    }
}

/// The effort sensors of one arm.
pub struct EffortSensors {
    noise_nm: f64,
    bias_nm: Vec<f64>,
    noise: ChaCha8Rng,
}

impl EffortSensors {
    /// Sensors of `joints` joints. The bias belongs to the robot, so it depends on `seed` alone; the noise also on the `run`'s number.
    pub fn new(settings: &SensorSettings, joints: usize, seed: u64, run: u64) -> Self {
        let mut bias = math::stream(seed, "effort_bias", 0);
        Self {
            noise_nm: settings.effort_noise_nm,
            bias_nm: (0..joints).map(|_| settings.effort_bias_nm * math::standard_normal(&mut bias)).collect(),
            noise: math::stream(seed, "effort_noise", run),
        }
    }

    /// How far the stream of the noise has been used (words of 32 bits).
    pub fn words_used(&self) -> u128 {
        self.noise.get_word_pos()
    }

    /// Goes on with the noise from there.
    pub fn go_on_from(&mut self, words_used: u128) {
        self.noise.set_word_pos(words_used);
    }

    /// The measured efforts (N m) of joints whose drives deliver `effort_nm`, in place.
    pub fn measure(&mut self, effort_nm: &mut [f64]) {
        for (effort, bias) in effort_nm.iter_mut().zip(&self.bias_nm) {
            *effort += bias + self.noise_nm * math::standard_normal(&mut self.noise);
        }
    }
}
