//! One trajectory as text, for programs that read CSV.

use super::{Trajectory, csv};

impl Trajectory {
    /// `time_s` and all columns as CSV: the shortest decimals that read back as the same bits.
    #[must_use]
    pub fn to_csv(&self) -> String {
        csv::text(self)
    }
}
