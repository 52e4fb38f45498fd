//! A table of samples over time: the one form in which movement, force and gripper are kept.

use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion};

use super::{DemonstrationError, Fault};

/// The columns of an orientation: a unit quaternion, scalar last.
pub const QUATERNION_COLUMNS: [&str; 4] = ["qx", "qy", "qz", "qw"];

/// The column of the gripper's opening: 0 closed, 1 open.
pub const GRIPPER_COLUMN: &str = "gripper";

/// Rising times (s) and named columns: `values` is samples x columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    times_s: Vec<f64>,
    columns: Vec<String>,
    values: DMatrix<f64>,
}

impl Trajectory {
    /// From times (s), column names, and values (samples x columns).
    ///
    /// # Errors
    /// All at once: fewer than two samples, times that do not rise, values that are not finite, lengths that disagree, column names
    /// that are empty or repeated, an incomplete quaternion or one without unit norm, a gripper opening outside [0, 1].
    pub fn new(times_s: Vec<f64>, columns: Vec<String>, values: DMatrix<f64>) -> Result<Self, DemonstrationError> {
        let trajectory = Self { times_s, columns, values };
        let faults = trajectory.faults("", 0);
        if faults.is_empty() { Ok(trajectory) } else { Err(DemonstrationError::Invalid(faults)) }
    }

    /// Times (s), rising.
    #[must_use]
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// Column names, in order.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// Values (samples x columns).
    #[must_use]
    pub fn values(&self) -> &DMatrix<f64> {
        &self.values
    }

    /// Number of samples, at least 2.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.times_s.len()
    }

    /// Time from the first to the last sample (s).
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.times_s[self.samples() - 1] - self.times_s[0]
    }

    /// The longest time between two samples (s).
    #[must_use]
    pub fn largest_gap_s(&self) -> f64 {
        self.times_s.windows(2).map(|t| t[1] - t[0]).fold(0.0, f64::max)
    }

    /// The values of one column (samples), if there is such a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<DVector<f64>> {
        self.column_index(name).map(|i| self.values.column(i).into_owned())
    }

    /// Where a column stands.
    #[must_use]
    pub fn column_index(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|c| c == name)
    }

    /// The values of several columns, in the order asked for (samples x names).
    ///
    /// # Errors
    /// All names that do not exist.
    pub fn select<S: AsRef<str>>(&self, names: &[S]) -> Result<DMatrix<f64>, DemonstrationError> {
        let found: Vec<Option<usize>> = names.iter().map(|name| self.column_index(name.as_ref())).collect();
        let missing = names.iter().zip(&found).filter(|(_, index)| index.is_none());
        let faults: Vec<Fault> =
            missing.map(|(name, _)| Fault::new("", "no such column", self.columns_in_words()).in_column(name.as_ref())).collect();
        if faults.is_empty() {
            let indices: Vec<usize> = found.into_iter().flatten().collect();
            Ok(self.values.select_columns(&indices))
        } else {
            Err(DemonstrationError::Invalid(faults))
        }
    }

    /// The orientation of every sample, if the trajectory has one; signs as recorded.
    #[must_use]
    pub fn orientations(&self) -> Option<Vec<UnitQuaternion<f64>>> {
        let [x, y, z, w] = self.quaternion_indices()?;
        let read = |t| Quaternion::new(self.values[(t, w)], self.values[(t, x)], self.values[(t, y)], self.values[(t, z)]);
        Some((0..self.samples()).map(|t| UnitQuaternion::new_normalize(read(t))).collect())
    }

    /// The gripper's opening of every sample (0 closed, 1 open), if the trajectory has one.
    #[must_use]
    pub fn gripper(&self) -> Option<DVector<f64>> {
        self.column(GRIPPER_COLUMN)
    }

    pub(super) fn quaternion_indices(&self) -> Option<[usize; 4]> {
        let found = QUATERNION_COLUMNS.map(|name| self.column_index(name));
        Some([found[0]?, found[1]?, found[2]?, found[3]?])
    }

    /// Without checks: for values that are known to be good.
    pub(super) fn unchecked(times_s: Vec<f64>, columns: Vec<String>, values: DMatrix<f64>) -> Self {
        Self { times_s, columns, values }
    }

    fn columns_in_words(&self) -> String {
        format!("one of {}", self.columns.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_faults_are_told_at_once() {
        let columns = ["x_m", "gripper"].map(str::to_owned).to_vec();
        let values = DMatrix::from_row_slice(3, 2, &[0.0, 1.0, f64::NAN, 0.5, 2.0, 1.5]);
        let error = Trajectory::new(vec![0.0, 0.1, 0.1], columns, values).unwrap_err();
        let places: Vec<_> = error.faults().iter().map(|f| (f.row, f.column.clone().unwrap())).collect();
        let expected = [(2, "time_s"), (1, "x_m"), (2, "gripper")].map(|(row, column)| (Some(row), column.to_owned()));
        assert_eq!(places, expected);
    }

    #[test]
    fn one_sample_half_a_quaternion_and_repeated_names_are_refused() {
        let names = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
        assert!(Trajectory::new(vec![0.0], names(&["x_m"]), DMatrix::zeros(1, 1)).is_err());
        assert!(Trajectory::new(vec![0.0, 1.0], names(&["qx", "qw"]), DMatrix::zeros(2, 2)).is_err());
        assert!(Trajectory::new(vec![0.0, 1.0], names(&["x_m", "x_m"]), DMatrix::zeros(2, 2)).is_err());
        assert!(Trajectory::new(vec![0.0, 1.0], names(&["x_m"]), DMatrix::zeros(3, 1)).is_err());
    }

    #[test]
    fn columns_come_in_the_order_asked_for() {
        let columns = ["x_m", "y_m"].map(str::to_owned).to_vec();
        let t = Trajectory::new(vec![1.0, 3.0], columns, DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 3.0, 4.0])).unwrap();
        assert_eq!(t.select(&["y_m", "x_m"]).unwrap(), DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 4.0, 3.0]));
        assert_eq!((t.duration_s(), t.select(&["z_m"]).unwrap_err().faults().len()), (2.0, 1));
    }
}
