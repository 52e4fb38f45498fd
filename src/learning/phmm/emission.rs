//! Log densities of samples under every state (12).

use nalgebra::{Cholesky, DMatrix, DVector};

use super::{Phmm, Sequence};

/// Samples that are whitened together: their differences stay in the fastest cache, and the loops over them run on vector units.
const BLOCK: usize = 64;

/// `ln N(x_t; mu_i(theta), Sigma_i)` of every sample and state, row by row (T x N).
///
/// `None` when a covariance is not positive definite.
pub(super) fn log_densities(model: &Phmm, sequence: &Sequence) -> Option<Vec<f64>> {
    let (n, d) = (model.states(), model.dimension());
    let states: Vec<Whitened> = (0..n).map(|i| Whitened::new(model, i, &sequence.theta)).collect::<Option<_>>()?;
    let mut log_densities = vec![0.0; sequence.samples() * n];
    let (mut columns, mut centred) = (vec![[0.0; BLOCK]; d], vec![[0.0; BLOCK]; d]);
    for (rows, out) in sequence.values.chunks(BLOCK * d).zip(log_densities.chunks_mut(BLOCK * n)) {
        for (t, row) in rows.chunks_exact(d).enumerate() {
            for (column, x) in columns.iter_mut().zip(row) {
                column[t] = *x;
            }
        }
        for (i, state) in states.iter().enumerate() {
            let squares = state.squared_distances(&columns, &mut centred);
            for (row, square) in out.chunks_exact_mut(n).zip(squares) {
                row[i] = state.log_normaliser - 0.5 * square;
            }
        }
    }
    Some(log_densities)
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

    /// `|L^-1 (x_t - mu)|^2` of a block of samples, given by columns (d of BLOCK).
    fn squared_distances(&self, columns: &[[f64; BLOCK]], centred: &mut [[f64; BLOCK]]) -> [f64; BLOCK] {
        for ((centred, column), m) in centred.iter_mut().zip(columns).zip(self.mean.iter()) {
            for (c, x) in centred.iter_mut().zip(column) {
                *c = x - m;
            }
        }
        let (mut squares, mut factors) = ([0.0; BLOCK], self.inverse_factor.iter());
        for r in 0..columns.len() {
            let mut z = [0.0; BLOCK];
            for (centred, l) in centred[..=r].iter().zip(factors.by_ref()) {
                for (z, c) in z.iter_mut().zip(centred) {
                    *z += l * c;
                }
            }
            for (square, z) in squares.iter_mut().zip(&z) {
                *square += z * z;
            }
        }
        squares
    }
}
