//! The forward and backward recursions with scaling: fast, and exact as long as what underflows cannot matter.
//!
//! The largest density of each sample is taken out (`b~ = b / max b <= 1`), and `alpha` is normalised at every step by `c_t`. Values below a
//! threshold `e` become 0, and what is lost by that is bounded: a path through a state with normalised `alpha_t(i) < e` contributes at most
//! `e prod_{s<=t} c_s` to the likelihood `prod_s c_s`, because `b~ <= 1` makes `beta~ <= 1`. With `e = `[`LOST`]` L` for an `L` that the
//! product of all `c_s` does not fall below, each of the T N values loses at most [`LOST`] of the likelihood: all together 1e-26 for a million
//! samples of 100 states. The higher `e`, the fewer states have to be looked at: `L` is taken from the iteration before, with a margin. Where the product does fall below it, the sequence is done again with
//! [`LEAST_LOG_SCALE`], and where that fails too, in logarithms.
//!
//! A transition whose expected count is lost this way (below about 1e-34 of the others) gets probability 0 in the maximisation step, and EM
//! keeps a 0 from then on. With logarithms it would live on until about 1e-308; neither value is one that data could tell from 0.

use nalgebra::DMatrix;

use super::emission::LogDensities;
use super::forward_backward::{Expectation, Recursions, Span};

/// What one path through a value set to 0 may lose, as a fraction of the likelihood (-).
const LOST: f64 = 1e-34;

/// Smallest `ln L`: `LOST L` is then 1e-290. Arithmetic with smaller, almost-underflown numbers is many times slower.
pub(super) const LEAST_LOG_SCALE: f64 = -589.0;

/// Scales are multiplied up to here before a logarithm is taken; times one more, still allowed scale it is far from underflow.
const LEAST_PRODUCT: f64 = 1e-30;

/// The states from the first to the last that are not 0.
fn span(values: &[f64]) -> Span {
    let first = values.iter().position(|v| *v != 0.0).unwrap_or(0);
    first..values.iter().rposition(|v| *v != 0.0).map_or(first, |last| last + 1)
}

impl Recursions {
    /// The recursions with scaling; densities are overwritten by scaled ones. `false` when `sum_t ln c_t` falls below `least`.
    pub(super) fn scaled(&mut self, densities: &mut LogDensities, least: f64, out: &mut Expectation) -> bool {
        let log_nothing = LOST.ln() + least;
        let nothing = log_nothing.exp();
        let n = self.initial.len();
        out.responsibilities.clear();
        out.responsibilities.resize(densities.values.len(), 0.0);
        self.scales.clear();
        out.spans.clear();
        let (mut log_scale, mut product, mut shifts) = (0.0, 1.0, 0.0);
        let (mut arriving, mut states) = (self.initial.clone(), span(&self.initial));
        let rows = densities.values.chunks_exact_mut(n).zip(out.responsibilities.chunks_exact_mut(n));
        for ((b, alpha), shift) in rows.zip(&densities.largest) {
            shifts += shift;
            let mut total = 0.0;
            for ((b, alpha), arriving) in b[states.clone()].iter_mut().zip(&mut alpha[states.clone()]).zip(&arriving[states.clone()]) {
                *b = if *arriving == 0.0 { 0.0 } else { exponential(*b - shift, log_nothing) };
                *alpha = arriving * *b;
                total += *alpha;
            }
            let scale = total.recip();
            alpha[states.clone()].iter_mut().for_each(|a| *a = something(*a * scale, nothing));
            product *= total;
            if product.is_nan() || product < LEAST_PRODUCT {
                log_scale += product.ln();
                product = 1.0;
                if log_scale.is_nan() || log_scale < least {
                    return false;
                }
            }
            self.scales.push(total);
            out.spans.push(states.clone());
            states = self.arrive(alpha, states, &mut arriving);
        }
        log_scale += product.ln();
        if log_scale < least {
            return false;
        }
        out.log_likelihood = log_scale + shifts;
        out.log_scale = Some(log_scale);
        self.scaled_backward(&densities.values, nothing, out);
        true
    }

    /// `sum_i alpha_t(i) a_ij`, and the states at which it is not 0.
    fn arrive(&self, alpha: &[f64], states: Span, arriving: &mut [f64]) -> Span {
        arriving.fill(0.0);
        let (mut first, mut last) = (arriving.len(), 0);
        for state in states.filter(|state| alpha[*state] != 0.0) {
            for (to, probability) in &self.outward.others[self.outward.of(state)] {
                arriving[*to] += probability * alpha[state];
                (first, last) = (first.min(*to), last.max(*to + 1));
            }
        }
        first.min(last)..last
    }

    /// Turns normalised `alpha` into `gamma` (T x N) and sums `xi` (N x N).
    fn scaled_backward(&mut self, b: &[f64], nothing: f64, out: &mut Expectation) {
        let n = self.initial.len();
        self.counts.clear();
        self.counts.resize(self.edges.len(), 0.0);
        let (mut beta, mut ahead) = (vec![1.0; n], vec![0.0; n]);
        for t in (0..self.scales.len().saturating_sub(1)).rev() {
            let scale = self.scales[t + 1].recip();
            ahead.fill(0.0);
            let next = out.spans[t + 1].clone();
            for (ahead, (b, beta)) in ahead[next.clone()].iter_mut().zip(b[(t + 1) * n..][next.clone()].iter().zip(&beta[next])) {
                *ahead = b * beta * scale;
            }
            let row = &mut out.responsibilities[t * n..(t + 1) * n];
            for state in out.spans[t].clone() {
                let (own, alpha) = (self.outward.of(state), row[state]);
                let mut sum = 0.0;
                for ((to, probability), count) in self.outward.others[own.clone()].iter().zip(&mut self.counts[own]) {
                    let onward = probability * ahead[*to];
                    sum += onward;
                    *count += alpha * onward;
                }
                beta[state] = something(sum, nothing);
                row[state] = alpha * beta[state];
            }
        }
        out.transitions = DMatrix::zeros(n, n);
        for (edge, count) in self.edges.iter().zip(&self.counts) {
            out.transitions[(edge.from, edge.to)] = *count;
        }
    }
}

/// The value, or 0 when it is less than `nothing`.
fn something(value: f64, nothing: f64) -> f64 {
    if value < nothing { 0.0 } else { value }
}

/// `exp x`, or 0 when `x` is less than `log_nothing`. Scaled by the largest density of **all** states, or what is lost would have no bound;
/// taken for states that can be there at all (`arriving > 0`) only, since the others have `alpha = 0` whatever their density: most
/// exponentials of a chain that is passed in order are saved. A row of `-inf` gives not-a-number, which ends the scaled recursion.
fn exponential(x: f64, log_nothing: f64) -> f64 {
    if x < log_nothing {
        0.0
    } else if x == 0.0 {
        1.0
    } else {
        x.exp()
    }
}
