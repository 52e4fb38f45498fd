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
    let sums = match model.dimension() {
        2 => Sums::of(2, model, sequence, expectation),
        3 => Sums::of(3, model, sequence, expectation),
        4 => Sums::of(4, model, sequence, expectation),
        7 => Sums::of(7, model, sequence, expectation),
        d => Sums::of(d, model, sequence, expectation),
    };
    (0..model.states()).map(|state| sums.group(state)).collect()
}

/// Sums over a sequence about a centre of each state.
struct Sums {
    centres: Vec<DVector<f64>>,
    /// `sum_t gamma` (N).
    counts: Vec<f64>,
    /// `sum_t gamma r` with `r = x - centre` (N of d).
    first: Vec<f64>,
    /// `sum_t gamma r r^T`: the lower triangle, row by row (N of d x d).
    second: Vec<f64>,
}

impl Sums {
    /// Inlined once per literal `d`: the compiler then unrolls the loops over few variables.
    #[inline(always)]
    fn of(d: usize, model: &Phmm, sequence: &Sequence, expectation: &Expectation) -> Self {
        let n = model.states();
        let centres: Vec<DVector<f64>> = (0..n).map(|i| model.mean_at(i, &sequence.theta)).collect();
        let (mut counts, mut first, mut second) = (vec![0.0; n], vec![0.0; n * d], vec![0.0; n * d * d]);
        let mut r = vec![0.0; d];
        let rows = sequence.values.chunks_exact(d).zip(expectation.responsibilities.chunks_exact(n));
        for ((x, gamma), states) in rows.zip(&expectation.spans) {
            for i in states.clone().filter(|i| gamma[*i] > NO_SHARE) {
                let (g, centre) = (gamma[i], &centres[i].as_slice()[..d]);
                let (first, second) = (&mut first[i * d..][..d], &mut second[i * d * d..][..d * d]);
                counts[i] += g;
                for a in 0..d {
                    r[a] = x[a] - centre[a];
                }
                for a in 0..d {
                    let weighted = g * r[a];
                    first[a] += weighted;
                    for b in 0..=a {
                        second[a * d + b] += weighted * r[b];
                    }
                }
            }
        }
        Self { centres, counts, first, second }
    }

    fn group(&self, state: usize) -> Group {
        let (count, centre) = (self.counts[state], &self.centres[state]);
        let d = centre.len();
        if count <= 0.0 {
            return Group { count: 0.0, mean: centre.clone(), scatter: DMatrix::zeros(d, d) };
        }
        let offset = DVector::from_column_slice(&self.first[state * d..][..d]) / count;
        let squares = &self.second[state * d * d..][..d * d];
        let second = DMatrix::from_fn(d, d, |a, b| squares[a.max(b) * d + a.min(b)]);
        Group { count, mean: centre + &offset, scatter: second - count * &offset * offset.transpose() }
    }
}
