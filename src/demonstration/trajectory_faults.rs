//! Everything that can be wrong with a table of samples.

use super::{Fault, GRIPPER_COLUMN, QUATERNION_COLUMNS, Trajectory};

/// How far a quaternion's norm may be from 1 (-): rounding of a recorder that writes three digits.
const QUATERNION_NORM_TOLERANCE: f64 = 1e-2;

impl Trajectory {
    /// Everything wrong with the table, rows counted from `first_row`.
    pub(super) fn faults(&self, place: &str, first_row: usize) -> Vec<Fault> {
        let mut faults = self.shape_faults(place);
        if !faults.is_empty() {
            return faults;
        }
        faults.extend(self.time_faults(place, first_row));
        faults.extend(self.value_faults(place, first_row));
        faults
    }

    fn shape_faults(&self, place: &str) -> Vec<Fault> {
        let mut faults = Vec::new();
        let (rows, columns) = self.values().shape();
        if rows != self.times_s().len() || columns != self.columns().len() {
            let expected = format!("{} x {} (times x names)", self.times_s().len(), self.columns().len());
            faults.push(Fault::new(place, format!("a table of {rows} x {columns}"), expected));
        }
        if self.times_s().len() < 2 {
            let found = if self.times_s().len() == 1 { "1 sample".to_owned() } else { "no samples".to_owned() };
            faults.push(Fault::new(place, found, "at least 2: a demonstration lasts for some time"));
        }
        for (i, name) in self.columns().iter().enumerate() {
            if name.is_empty() {
                faults.push(Fault::new(place, format!("column {} without a name", i + 1), "a name such as x_m"));
            } else if name.trim() != name || name.contains(char::is_control) {
                faults.push(Fault::new(
                    place,
                    format!("the name {name:?}"),
                    "a name without blanks around it and without control characters",
                ));
            } else if self.columns()[..i].contains(name) {
                faults.push(Fault::new(place, "the same name twice", "every column name once").in_column(name));
            }
        }
        let quaternion = QUATERNION_COLUMNS.map(|name| self.column_index(name).is_some());
        if quaternion.contains(&true) && quaternion.contains(&false) {
            faults.push(Fault::new(place, "part of a quaternion", "all of qx, qy, qz, qw, or none"));
        }
        faults
    }

    fn time_faults(&self, place: &str, first_row: usize) -> Vec<Fault> {
        let mut faults = Vec::new();
        for (i, t) in self.times_s().iter().enumerate() {
            let fault = |found, expected: &str| Fault::new(place, found, expected).at_row(first_row + i).in_column("time_s");
            if !t.is_finite() {
                faults.push(fault(format!("{t}"), "a finite time (s)"));
            } else if i > 0 && *t <= self.times_s()[i - 1] {
                faults.push(fault(format!("{t} after {}", self.times_s()[i - 1]), "times that rise from row to row"));
            }
        }
        faults
    }

    fn value_faults(&self, place: &str, first_row: usize) -> Vec<Fault> {
        let mut faults = Vec::new();
        let gripper = self.column_index(GRIPPER_COLUMN);
        for t in 0..self.samples() {
            for (i, name) in self.columns().iter().enumerate() {
                let value = self.values()[(t, i)];
                let fault = |expected| Fault::new(place, format!("{value}"), expected).at_row(first_row + t).in_column(name);
                if !value.is_finite() {
                    faults.push(fault("a finite number"));
                } else if gripper == Some(i) && !(0.0..=1.0).contains(&value) {
                    faults.push(fault("an opening between 0 (closed) and 1 (open)"));
                }
            }
            if let Some(indices) = self.quaternion_indices() {
                let norm = indices.iter().map(|i| self.values()[(t, *i)].powi(2)).sum::<f64>().sqrt();
                if (norm - 1.0).abs() > QUATERNION_NORM_TOLERANCE {
                    faults.push(Fault::new(place, format!("a quaternion of norm {norm}"), "norm 1").at_row(first_row + t));
                }
            }
        }
        faults
    }
}
