//! States that explain nothing are given half of the one that explains most.

use nalgebra::{DMatrix, DVector};

use super::baum_welch::Problem;
use super::{Phmm, Topology};

/// A state with fewer expected samples than this is empty.
pub(super) const EMPTY: f64 = 1.0;

impl Problem<'_> {
    /// Expected samples of every state (N); `None` when the model is degenerate.
    pub(super) fn occupancy(&self, model: &Phmm) -> Option<Vec<f64>> {
        let expectations = self.expectations(model)?;
        let n = model.states();
        let mut counts = vec![0.0; n];
        for row in expectations.iter().flat_map(|e| e.responsibilities.chunks_exact(n)) {
            counts.iter_mut().zip(row).for_each(|(count, g)| *count += g);
        }
        Some(counts)
    }

    /// Every empty state moved to half of the fullest one; `None` when no state is empty.
    pub(super) fn without_empty_states(&self, model: &Phmm) -> Option<Phmm> {
        let mut counts = self.occupancy(model)?;
        let mut mended = model.clone();
        let mut changed = false;
        for _ in 0..model.states() {
            let Some(empty) = counts.iter().position(|count| *count < EMPTY) else { break };
            let fullest = (0..counts.len()).max_by(|a, b| counts[*a].total_cmp(&counts[*b]))?;
            if counts[fullest] < 2.0 * EMPTY {
                break;
            }
            let half = 0.5 * counts[fullest];
            counts[fullest] = half;
            match self.settings.topology {
                Topology::Ergodic => {
                    split_in_place(&mut mended, fullest, empty);
                    counts[empty] = half;
                }
                Topology::LeftToRight => {
                    split_in_order(&mut mended, fullest, empty);
                    counts.insert(fullest + 1, half);
                    counts.remove(if empty > fullest { empty + 1 } else { empty });
                }
            }
            changed = true;
        }
        if changed && self.settings.topology == Topology::LeftToRight {
            in_a_row(&mut mended, &counts, self.sequences.len());
        }
        changed.then_some(mended)
    }
}

/// The two halves of a state: half a standard deviation before and after its mean, along the direction of the movement.
fn halves(model: &Phmm, state: usize) -> [DVector<f64>; 2] {
    let forward = model.means[model.states() - 1][0] >= model.means[0][0];
    let spread = model.covariances[state].diagonal().map(|v| 0.5 * v.max(0.0).sqrt()) * if forward { 1.0 } else { -1.0 };
    [&model.means[state] - &spread, &model.means[state] + spread]
}

/// `empty` becomes the second half of `fullest` and shares its ways in and out.
fn split_in_place(model: &mut Phmm, fullest: usize, empty: usize) {
    let [first, second] = halves(model, fullest);
    (model.means[fullest], model.means[empty]) = (first, second);
    model.weights[empty] = model.weights[fullest].clone();
    model.covariances[empty] = model.covariances[fullest].clone();
    let shared = 0.5 * (model.initial[fullest] + model.initial[empty]);
    (model.initial[fullest], model.initial[empty]) = (shared, shared);
    let onward = model.transition.row(fullest).into_owned();
    model.transition.set_row(empty, &onward);
    for mut row in model.transition.row_iter_mut() {
        let shared = 0.5 * (row[fullest] + row[empty]);
        (row[fullest], row[empty]) = (shared, shared);
    }
}

/// The second half of `fullest` follows it, and `empty` is taken out; transitions come after.
fn split_in_order(model: &mut Phmm, fullest: usize, empty: usize) {
    let [first, second] = halves(model, fullest);
    model.means[fullest] = first;
    model.means.insert(fullest + 1, second);
    model.weights.insert(fullest + 1, model.weights[fullest].clone());
    model.covariances.insert(fullest + 1, model.covariances[fullest].clone());
    let out = if empty > fullest { empty + 1 } else { empty };
    model.means.remove(out);
    model.weights.remove(out);
    model.covariances.remove(out);
}

/// Transitions from left to right under which every state lasts as long as its samples.
fn in_a_row(model: &mut Phmm, counts: &[f64], sequences: usize) {
    let n = model.states();
    model.initial = DVector::from_fn(n, |i, _| if i == 0 { 1.0 } else { 0.0 });
    model.transition = DMatrix::zeros(n, n);
    for (i, count) in counts.iter().enumerate() {
        let leave = if i + 1 == n { 0.0 } else { (sequences as f64 / count.max(1.0)).min(0.5) };
        model.transition[(i, i)] = 1.0 - leave;
        if i + 1 < n {
            model.transition[(i, i + 1)] = leave;
        }
    }
}
