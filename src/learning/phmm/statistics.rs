//! What the maximisation step needs to know of the data: per state and sequence, how much, where, and how spread.

use nalgebra::{DMatrix, DVector};

use super::{Expectation, Phmm, Sequence};

/// The share of one sequence that belongs to one state.
#[derive(Debug, Clone)]
pub struct Group {
    /// Expected number of samples, `n_ki = sum_t gamma`.
    pub count: f64,
    /// Their mean (d).
    pub mean: DVector<f64>,
    /// Their scatter about that mean, `sum_t gamma (x - mean)(x - mean)^T` (d x d).
    pub scatter: DMatrix<f64>,
}

/// A responsibility below this adds nothing that a double could hold.
const NO_SHARE: f64 = 1e-40;

/// Groups of one sequence, one per state, from its responsibilities.
///
/// Sums are taken about the model's present means, so that the small spread inside a state does not drown in rounding.
#[must_use]
pub fn gather(model: &Phmm, sequence: &Sequence, expectation: &Expectation) -> Vec<Group> {
    let (n, d) = (model.states(), model.dimension());
    let centres: Vec<DVector<f64>> = (0..n).map(|i| model.mean_at(i, &sequence.theta)).collect();
    let (mut counts, mut sums, mut squares) = (vec![0.0; n], vec![0.0; n * d], vec![0.0; n * d * d]);
    let mut r = vec![0.0; d];
    for (x, gamma) in sequence.values.chunks_exact(d).zip(expectation.responsibilities.chunks_exact(n)) {
        for (i, g) in gamma.iter().enumerate().filter(|(_, g)| **g > NO_SHARE) {
            counts[i] += g;
            for (a, r_a) in r.iter_mut().enumerate() {
                *r_a = x[a] - centres[i][a];
            }
            for a in 0..d {
                let weighted = g * r[a];
                sums[i * d + a] += weighted;
                for (s, r_b) in squares[(i * d + a) * d..(i * d + a) * d + d].iter_mut().zip(&r).take(a + 1) {
                    *s += weighted * r_b;
                }
            }
        }
    }
    (0..n).map(|i| group(counts[i], &centres[i], &sums[i * d..(i + 1) * d], &squares[i * d * d..(i + 1) * d * d])).collect()
}

/// From sums about a centre; `squares` holds the lower triangle, row by row.
fn group(count: f64, centre: &DVector<f64>, sums: &[f64], squares: &[f64]) -> Group {
    let d = centre.len();
    if count <= 0.0 {
        return Group { count: 0.0, mean: centre.clone(), scatter: DMatrix::zeros(d, d) };
    }
    let offset = DVector::from_column_slice(sums) / count;
    let second = DMatrix::from_fn(d, d, |a, b| squares[a.max(b) * d + a.min(b)]);
    Group { count, mean: centre + &offset, scatter: second - count * &offset * offset.transpose() }
}
