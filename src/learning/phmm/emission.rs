//! Log densities of samples under every state (12).

use nalgebra::{Cholesky, DMatrix, DVector};

use super::{Phmm, Sequence};

/// Samples that are whitened together: their differences stay in the fastest cache, and the loops over them run on vector units.
const BLOCK: usize = 8;

/// Log densities of one sequence; the memory is used again for the next.
#[derive(Default)]
pub(super) struct LogDensities {
    /// `ln N(x_t; mu_i(theta), Sigma_i)` of every sample and state, row by row (T x N).
    pub(super) values: Vec<f64>,
    /// The largest of each sample (T).
    pub(super) largest: Vec<f64>,
}

impl LogDensities {
    /// Takes the densities of a sequence; `false` when a covariance is not positive definite.
    pub(super) fn set(&mut self, model: &Phmm, sequence: &Sequence) -> bool {
        let (n, d) = (model.states(), model.dimension());
        let states = (0..n).map(|i| Whitened::new(model, i, &sequence.theta)).collect::<Option<Vec<_>>>();
        let Some(states) = states else { return false };
        self.values.resize(sequence.samples() * n, 0.0);
        self.largest.clear();
        match d {
            2 => self.fill(2, &states, &sequence.values),
            3 => self.fill(3, &states, &sequence.values),
            4 => self.fill(4, &states, &sequence.values),
            7 => self.fill(7, &states, &sequence.values),
            d => self.fill(d, &states, &sequence.values),
        }
        true
    }

    /// Inlined once per literal `d`: the compiler then unrolls the loops over few variables.
    #[inline(always)]
    fn fill(&mut self, d: usize, states: &[Whitened], samples: &[f64]) {
        let n = states.len();
        let (mut columns, mut centred) = (vec![[0.0; BLOCK]; d], vec![[0.0; BLOCK]; d]);
        for (rows, out) in samples.chunks(BLOCK * d).zip(self.values.chunks_mut(BLOCK * n)) {
            for (t, row) in rows.chunks_exact(d).enumerate() {
                for (column, x) in columns[..d].iter_mut().zip(row) {
                    column[t] = *x;
                }
            }
            let mut largest = [f64::NEG_INFINITY; BLOCK];
            for (i, state) in states.iter().enumerate() {
                let densities = state.log_densities(d, &columns, &mut centred);
                for (largest, density) in largest.iter_mut().zip(&densities) {
                    *largest = if *density > *largest { *density } else { *largest };
                }
                for (row, density) in out.chunks_exact_mut(n).zip(densities) {
                    row[i] = density;
                }
            }
            self.largest.extend(&largest[..out.len() / n]);
        }
    }
}

/// One state's Gaussian at one `theta`, with the inverse of its Cholesky factor: `|L^-1 (x - mu)|^2` costs no division.
struct Whitened {
    mean: DVector<f64>,
    /// Lower triangle of `L^-1`, row by row without the zeros.
    inverse_factor: Vec<f64>,
    log_normaliser: f64,
}

impl Whitened {
    fn new(model: &Phmm, state: usize, theta: &DVector<f64>) -> Option<Self> {
        let d = model.dimension();
        let factor = Cholesky::new(model.covariances[state].clone())?.l();
        let inverse = factor.solve_lower_triangular(&DMatrix::identity(d, d))?;
        let half_log_determinant: f64 = factor.diagonal().iter().map(|l| l.ln()).sum();
        Some(Self {
            mean: model.mean_at(state, theta),
            inverse_factor: (0..d).flat_map(|r| (0..=r).map(move |c| (r, c))).map(|rc| inverse[rc]).collect(),
            log_normaliser: -0.5 * d as f64 * std::f64::consts::TAU.ln() - half_log_determinant,
        })
    }

    /// `c - |L^-1 (x_t - mu)|^2 / 2` of a block of samples, given by columns (d of BLOCK).
    #[inline(always)]
    fn log_densities(&self, d: usize, columns: &[[f64; BLOCK]], centred: &mut [[f64; BLOCK]]) -> [f64; BLOCK] {
        let (mean, factor) = (&self.mean.as_slice()[..d], &self.inverse_factor[..d * (d + 1) / 2]);
        let (columns, centred) = (&columns[..d], &mut centred[..d]);
        for r in 0..d {
            for t in 0..BLOCK {
                centred[r][t] = columns[r][t] - mean[r];
            }
        }
        let mut squares = [0.0; BLOCK];
        for r in 0..d {
            let row = &factor[r * (r + 1) / 2..][..=r];
            let mut z = [0.0; BLOCK];
            for c in 0..=r {
                for t in 0..BLOCK {
                    z[t] += row[c] * centred[c][t];
                }
            }
            for t in 0..BLOCK {
                squares[t] += z[t] * z[t];
            }
        }
        squares.map(|square| self.log_normaliser - 0.5 * square)
    }
}
