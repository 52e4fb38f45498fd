//! The same movement at another rate: linear between samples, orientations along the shorter arc.

use nalgebra::DMatrix;

use super::{DemonstrationError, Fault, Trajectory};
use crate::math::{same_hemisphere, slerp};

/// The most samples one resampling makes: 100 days at 1 Hz, 2.4 h at 1 kHz.
pub(crate) const MOST_SAMPLES: f64 = 8.64e6;

impl Trajectory {
    /// This trajectory at equally spaced times, from its first to its last moment, at about `rate_hz` (Hz, > 0): the rate is adjusted
    /// so that the last sample is the last moment (at least two samples). Gaps of any length are bridged by straight lines; see
    /// [`Self::largest_gap_s`]. Signs of quaternions are made continuous.
    ///
    /// # Errors
    /// When the rate is not positive and finite, or asks for more than 8.64 million samples.
    pub fn resampled(&self, rate_hz: f64) -> Result<Self, DemonstrationError> {
        let intervals = (self.duration_s() * rate_hz).round().max(1.0);
        if !(rate_hz > 0.0 && rate_hz.is_finite()) || intervals >= MOST_SAMPLES {
            let expected = "a positive rate (Hz) with fewer than 8.64 million samples";
            return Err(DemonstrationError::Invalid(vec![Fault::new("", format!("a rate of {rate_hz} Hz"), expected)]));
        }
        let (n, start) = (intervals as usize + 1, self.times_s()[0]);
        let step = self.duration_s() / intervals;
        let times: Vec<f64> = (0..n).map(|i| start + step * i as f64).collect();
        Ok(self.at_times(times))
    }

    /// Interpolated at rising times; the first and last sample stand for everything before and after.
    pub(super) fn at_times(&self, times_s: Vec<f64>) -> Self {
        let mut values = DMatrix::zeros(times_s.len(), self.columns().len());
        let quaternion = self.quaternion_indices().zip(self.orientations());
        let mut previous = None;
        let mut segment = 0;
        for (row, t) in times_s.iter().enumerate() {
            while segment + 2 < self.samples() && self.times_s()[segment + 1] <= *t {
                segment += 1;
            }
            let (from, to) = (self.times_s()[segment], self.times_s()[segment + 1]);
            let fraction = ((t - from) / (to - from)).clamp(0.0, 1.0);
            let (a, b) = (self.values().row(segment), self.values().row(segment + 1));
            values.row_mut(row).copy_from(&(a * (1.0 - fraction) + b * fraction));
            if let Some((indices, orientations)) = &quaternion {
                let q = slerp(&orientations[segment], &orientations[segment + 1], fraction);
                let q = previous.map_or(q, |before| same_hemisphere(&q, &before));
                for (index, value) in indices.iter().zip(q.coords.iter()) {
                    values[(row, *index)] = *value;
                }
                previous = Some(q);
            }
        }
        Self::unchecked(times_s, self.columns().to_vec(), values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_stays_a_line_and_both_ends_are_kept() {
        let columns = vec!["x_m".to_owned()];
        let t = Trajectory::new(vec![1.0, 1.3, 2.0], columns, DMatrix::from_column_slice(3, 1, &[0.0, 0.3, 1.0])).unwrap();
        let r = t.resampled(10.0).unwrap();
        assert_eq!(r.samples(), 11);
        for (time, x) in r.times_s().iter().zip(r.values().iter()) {
            assert!((time - 1.0 - x).abs() < 1e-14);
        }
        assert!(t.resampled(f64::NAN).is_err() && t.resampled(1e12).is_err());
    }

    #[test]
    fn a_flipped_quaternion_turns_the_short_way() {
        let columns = super::super::QUATERNION_COLUMNS.map(str::to_owned).to_vec();
        let (s, c) = (0.1f64.sin(), 0.1f64.cos());
        let values = DMatrix::from_row_slice(2, 4, &[0.0, 0.0, 0.0, 1.0, -s, 0.0, 0.0, -c]);
        let r = Trajectory::new(vec![0.0, 1.0], columns, values).unwrap().resampled(2.0).unwrap();
        assert!((r.values()[(1, 0)] - 0.05f64.sin()).abs() < 1e-12 && r.values()[(2, 3)] > 0.99);
    }
}
