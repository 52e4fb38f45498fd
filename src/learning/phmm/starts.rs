//! First models, from labelled samples.

use nalgebra::{DMatrix, DVector};

use super::kmeans::k_means;
use super::maximisation::{Penalty, maximise_state};
use super::statistics::gather;
use super::{Expectation, Phmm, PhmmSettings, Sequence, Start, Topology};
use crate::math::stream;

/// The model from which a start's first stage begins, for standardised sequences; `seed` feeds the k-means starts.
pub(super) fn first_model(sequences: &[Sequence], settings: &PhmmSettings, start: Start, penalty: &Penalty, seed: u64) -> Phmm {
    let labels = match start {
        Start::KMeans(index) => cluster_labels(sequences, settings.states, seed, index),
        _ => slice_labels(sequences, settings.states),
    };
    from_labels(sequences, &labels, settings, penalty)
}

/// Equal time slices: sample `t` of `T` belongs to state `floor(N t / T)`.
fn slice_labels(sequences: &[Sequence], states: usize) -> Vec<Vec<usize>> {
    let labels = |s: &Sequence| (0..s.samples()).map(|t| t * states / s.samples()).collect();
    sequences.iter().map(labels).collect()
}

/// k-means over all samples; clusters numbered by their mean phase.
fn cluster_labels(sequences: &[Sequence], states: usize, seed: u64, index: u64) -> Vec<Vec<usize>> {
    let d = sequences[0].dimension;
    let all: Vec<f64> = sequences.iter().flat_map(|s| s.values.iter().copied()).collect();
    let labels = k_means(&all, d, states, &mut stream(seed, "k-means", index));
    let (mut sums, mut counts) = (vec![0.0; states], vec![0.0; states]);
    for (label, row) in labels.iter().zip(all.chunks_exact(d)) {
        sums[*label] += row[0];
        counts[*label] += 1.0;
    }
    let phase = |i: usize| if counts[i] > 0.0 { sums[i] / counts[i] } else { f64::INFINITY };
    let mut order: Vec<usize> = (0..states).collect();
    order.sort_by(|a, b| phase(*a).total_cmp(&phase(*b)));
    let rank: Vec<usize> = (0..states).map(|i| order.iter().position(|o| *o == i).unwrap_or(i)).collect();
    let mut rest = labels.into_iter().map(|label| rank[label]);
    sequences.iter().map(|s| rest.by_ref().take(s.samples()).collect()).collect()
}

fn from_labels(sequences: &[Sequence], labels: &[Vec<usize>], settings: &PhmmSettings, penalty: &Penalty) -> Phmm {
    let (n, d, p) = (settings.states, sequences[0].dimension, sequences[0].theta.len());
    let mut model = Phmm {
        initial: DVector::zeros(n),
        transition: DMatrix::zeros(n, n),
        weights: vec![DMatrix::zeros(d, p); n],
        means: vec![DVector::zeros(d); n],
        covariances: vec![DMatrix::identity(d, d); n],
    };
    let groups: Vec<_> = sequences.iter().zip(labels).map(|(s, l)| gather(&model, s, &certain(l, n))).collect();
    let thetas: Vec<&DVector<f64>> = sequences.iter().map(|s| &s.theta).collect();
    for i in 0..n {
        let of_state: Vec<_> = groups.iter().map(|g| &g[i]).collect();
        if let Some((w, mean, c)) = maximise_state(&of_state, &thetas, (&model.weights[i], &model.covariances[i]), penalty) {
            (model.weights[i], model.means[i], model.covariances[i]) = (w, mean, c);
        }
    }
    match settings.topology {
        Topology::LeftToRight => left_to_right(&mut model, labels),
        Topology::Ergodic => ergodic(&mut model, labels),
    }
    model
}

/// Labels as responsibilities of 0 and 1.
fn certain(labels: &[usize], states: usize) -> Expectation {
    let mut responsibilities = vec![0.0; labels.len() * states];
    for (t, label) in labels.iter().enumerate() {
        responsibilities[t * states + label] = 1.0;
    }
    let spans = labels.iter().map(|label| *label..label + 1).collect();
    Expectation { responsibilities, transitions: DMatrix::zeros(states, states), spans, ..Expectation::default() }
}

/// Each state lasts as long as its labels do in the average sequence.
fn left_to_right(model: &mut Phmm, labels: &[Vec<usize>]) {
    let n = model.states();
    model.initial[0] = 1.0;
    for i in 0..n {
        let samples = labels.iter().flatten().filter(|label| **label == i).count() as f64;
        let leave = if i + 1 == n { 0.0 } else { (labels.len() as f64 / samples.max(1.0)).min(0.5) };
        model.transition[(i, i)] = 1.0 - leave;
        if i + 1 < n {
            model.transition[(i, i + 1)] = leave;
        }
    }
}

/// Counted transitions, one more for each so that none is impossible.
fn ergodic(model: &mut Phmm, labels: &[Vec<usize>]) {
    model.initial.fill(1.0);
    model.transition.fill(1.0);
    for sequence in labels {
        if let Some(first) = sequence.first() {
            model.initial[*first] += 1.0;
        }
        for pair in sequence.windows(2) {
            model.transition[(pair[0], pair[1])] += 1.0;
        }
    }
    model.initial /= model.initial.sum();
    for mut row in model.transition.row_iter_mut() {
        row /= row.sum();
    }
}
