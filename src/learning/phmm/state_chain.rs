//! State chains (section 4.2): one model that has learned several kinds of movement, taken apart again.
//!
//! An ergodic model of movements that pass an obstacle on either side holds states of both sides at the same phase; regression over all
//! of them averages the sides and hits the obstacle. Each **chain** of states that follows the transitions from a start is one kind of
//! movement, and is reproduced by regression on its own states.
//!
//! ```text
//! starts: pi_i > 0.05       edge i -> j: A_ij / (1 - A_ii) > 0.05, unless it leads back to a start
//! P(path) = pi_first prod A_ij / (1 - A_ii)                                    paths repeat no state
//! ```
//!
//! Paths are taken from the most probable one on; one becomes a chain when it holds a state that no chain before it holds, and gives way
//! again when a later chain holds all its states. That drops prefixes and short cuts, and crossings from one kind to the other that noise
//! leaves. Where branches truly share a state it belongs to both chains: its Gaussian serves both. States that no start leads to
//! belong to none.

use nalgebra::DVector;

use super::Phmm;

/// A state is a start from this probability on (-).
const LEAST_INITIAL: f64 = 0.05;
/// A transition is an edge from this share of all departures on (-).
const LEAST_DEPARTURE: f64 = 0.05;
/// A state that is left more rarely than this per sample is an end (-): what remains in its row is rounding.
const LEAST_LEAVING: f64 = 1e-9;
/// Paths that are looked at; a model of a few kinds of movement has tens.
const MOST_PATHS: usize = 4096;

/// A state, drawn as a node.
#[derive(Debug, Clone, PartialEq)]
pub struct TransitionNode {
    /// Its number.
    pub state: usize,
    /// Its mean phase input.
    pub phase: f64,
    /// `pi_i`: probability to start here (-).
    pub initial: f64,
    /// Whether chains start here.
    pub start: bool,
}

/// A transition, drawn as an arrow.
#[derive(Debug, Clone, PartialEq)]
pub struct TransitionEdge {
    /// The state that is left.
    pub from: usize,
    /// The state that follows.
    pub to: usize,
    /// `A_ij / (1 - A_ii)`: share of the departures from `from` that go to `to` (-).
    pub probability: f64,
}

/// Which state follows which, without what is too rare to mean something.
#[derive(Debug, Clone, PartialEq)]
pub struct TransitionGraph {
    /// One per state, in order.
    pub nodes: Vec<TransitionNode>,
    /// Sorted by `from`, then from the most probable one on.
    pub edges: Vec<TransitionEdge>,
}

/// One kind of movement.
#[derive(Debug, Clone, PartialEq)]
pub struct StateChain {
    /// Its states in the order of the phase.
    pub states: Vec<usize>,
    /// Probability of this kind among all chains (-); the weights of all chains sum to 1.
    pub weight: f64,
}

impl TransitionGraph {
    /// The graph of a model, with phases at `theta` (p).
    #[must_use]
    pub fn of(model: &Phmm, theta: &DVector<f64>) -> Self {
        let phase = |i: usize| model.mean_at(i, theta)[0];
        let most = model.initial.max();
        // Of more than 20 states none may reach the limit: then the most probable ones start.
        let least = if most > LEAST_INITIAL { LEAST_INITIAL } else { most * (1.0 - 1e-9) };
        let node = |i: usize| TransitionNode { state: i, phase: phase(i), initial: model.initial[i], start: model.initial[i] > least };
        let nodes: Vec<TransitionNode> = (0..model.states()).map(node).collect();
        let direction = direction(&nodes);
        let mut edges = Vec::new();
        for from in &nodes {
            let leaving: f64 = nodes.iter().filter(|to| to.state != from.state).map(|to| model.transition[(from.state, to.state)]).sum();
            if leaving < LEAST_LEAVING {
                continue;
            }
            let mut onward: Vec<TransitionEdge> = Vec::new();
            for to in nodes.iter().filter(|to| to.state != from.state) {
                let probability = model.transition[(from.state, to.state)] / leaving;
                let back_to_start = to.start && direction * (to.phase - from.phase) <= 0.0;
                if probability > LEAST_DEPARTURE && !back_to_start {
                    onward.push(TransitionEdge { from: from.state, to: to.state, probability });
                }
            }
            onward.sort_by(|a, b| b.probability.total_cmp(&a.probability));
            edges.extend(onward);
        }
        Self { nodes, edges }
    }

    /// The chains, from the most probable one on.
    #[must_use]
    pub fn chains(&self) -> Vec<StateChain> {
        let mut paths = self.paths();
        paths.sort_by(|a, b| b.probability.total_cmp(&a.probability).then_with(|| a.states.cmp(&b.states)));
        let mut kept: Vec<usize> = Vec::new();
        for (k, path) in paths.iter().enumerate() {
            if path.states.iter().any(|state| !kept.iter().any(|other| paths[*other].states.contains(state))) {
                kept.push(k);
            }
        }
        let holds = |outer: usize, inner: usize| paths[inner].states.iter().all(|state| paths[outer].states.contains(state));
        let candidates = kept.clone();
        kept.retain(|inner| !candidates.iter().any(|outer| outer > inner && holds(*outer, *inner)));
        let mut weights = vec![0.0; kept.len()];
        for path in &paths {
            weights[most_shared(path, &paths, &kept)] += path.probability;
        }
        let total: f64 = weights.iter().sum();
        let direction = direction(&self.nodes);
        let mut chains: Vec<StateChain> = Vec::new();
        for (k, weight) in kept.iter().zip(weights) {
            let mut states = paths[*k].states.clone();
            states.sort_by(|a, b| (direction * self.nodes[*a].phase).total_cmp(&(direction * self.nodes[*b].phase)));
            chains.push(StateChain { states, weight: weight / total });
        }
        chains.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        chains
    }

    /// All paths from the starts that cannot go on without repeating a state.
    fn paths(&self) -> Vec<Path> {
        let starts = self.nodes.iter().filter(|node| node.start);
        let mut open: Vec<Path> = starts.map(|node| Path { states: vec![node.state], probability: node.initial }).collect();
        open.sort_by(|a, b| a.probability.total_cmp(&b.probability));
        let mut complete = Vec::new();
        while let Some(path) = open.pop().filter(|_| complete.len() < MOST_PATHS) {
            let last = path.states.last().copied();
            let onward = self.edges.iter().filter(|e| Some(e.from) == last && !path.states.contains(&e.to));
            let before = open.len();
            open.extend(onward.map(|edge| path.followed_by(edge)));
            if open.len() == before {
                complete.push(path);
            } else {
                // The most probable edge is followed first, in case there are too many paths.
                open[before..].reverse();
            }
        }
        complete
    }
}

/// States in the order they follow each other.
struct Path {
    states: Vec<usize>,
    probability: f64,
}

impl Path {
    fn followed_by(&self, edge: &TransitionEdge) -> Self {
        let states = self.states.iter().copied().chain([edge.to]).collect();
        Self { states, probability: self.probability * edge.probability }
    }
}

/// The index in `kept` of the chain with which a path shares most states; the most probable one among equals.
fn most_shared(path: &Path, paths: &[Path], kept: &[usize]) -> usize {
    let shared = |k: usize| path.states.iter().filter(|state| paths[kept[k]].states.contains(state)).count();
    (0..kept.len()).rev().max_by_key(|k| shared(*k)).unwrap_or(0)
}

/// +1 when the phase input rises over the movement (time fraction), -1 when it falls (the paper's `s`).
fn direction(nodes: &[TransitionNode]) -> f64 {
    let mean = nodes.iter().map(|node| node.phase).sum::<f64>() / nodes.len().max(1) as f64;
    let at_start: f64 = nodes.iter().map(|node| node.initial * (node.phase - mean)).sum();
    if at_start > 0.0 { -1.0 } else { 1.0 }
}

impl Phmm {
    /// The model of one chain alone: its states in the chain's order, probabilities renormalised among them.
    #[must_use]
    pub fn restricted(&self, chain: &StateChain) -> Self {
        let states = &chain.states;
        let n = states.len();
        let mut initial = DVector::from_fn(n, |i, _| self.initial[states[i]]);
        let total = initial.sum();
        if total > 0.0 {
            initial /= total;
        } else if n > 0 {
            initial[0] = 1.0;
        }
        let mut transition = nalgebra::DMatrix::from_fn(n, n, |i, j| self.transition[(states[i], states[j])]);
        for (i, mut row) in transition.row_iter_mut().enumerate() {
            let total = row.sum();
            if total > 0.0 {
                row /= total;
            } else {
                row[i] = 1.0;
            }
        }
        Self {
            initial,
            transition,
            weights: states.iter().map(|i| self.weights[*i].clone()).collect(),
            means: states.iter().map(|i| self.means[*i].clone()).collect(),
            covariances: states.iter().map(|i| self.covariances[*i].clone()).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    /// States at these phases, with transitions `(from, to, probability)`; the rest of every row is staying.
    fn model(phases: &[f64], initial: &[f64], transitions: &[(usize, usize, f64)]) -> Phmm {
        let n = phases.len();
        let mut transition = DMatrix::identity(n, n);
        for (from, to, probability) in transitions {
            transition[(*from, *to)] += probability;
            transition[(*from, *from)] -= probability;
        }
        Phmm {
            initial: DVector::from_column_slice(initial),
            transition,
            weights: vec![DMatrix::zeros(2, 0); n],
            means: phases.iter().map(|u| DVector::from_vec(vec![*u, 0.0])).collect(),
            covariances: vec![DMatrix::identity(2, 2); n],
        }
    }

    fn chains(model: &Phmm) -> Vec<(Vec<usize>, f64)> {
        let found = TransitionGraph::of(model, &DVector::zeros(0)).chains();
        found.into_iter().map(|c| (c.states, (c.weight * 1e9).round() / 1e9)).collect()
    }

    #[test]
    fn two_sides_are_two_chains_whatever_the_order_of_the_states() {
        // 0, 2, 4 on the one side; 5, 3, 1 on the other; 6 is left over.
        let transitions = [(0, 2, 0.1), (2, 4, 0.01), (5, 3, 0.2), (3, 1, 0.05), (6, 1, 0.5)];
        let two = model(&[0.1, 0.8, 0.5, 0.5, 0.9, 0.1, 0.3], &[0.4, 0.0, 0.0, 0.0, 0.0, 0.6, 0.0], &transitions);
        assert_eq!(chains(&two), [(vec![5, 3, 1], 0.6), (vec![0, 2, 4], 0.4)]);
        let falling = model(&[0.9, 0.2, 0.5, 0.5, 0.1, 0.9, 0.7], &[0.4, 0.0, 0.0, 0.0, 0.0, 0.6, 0.0], &transitions);
        assert_eq!(chains(&falling), [(vec![5, 3, 1], 0.6), (vec![0, 2, 4], 0.4)], "phase that falls");
    }

    #[test]
    fn noise_that_crosses_between_sides_makes_no_chain() {
        let transitions = [(0, 1, 0.9), (0, 4, 0.1), (1, 2, 0.92), (1, 5, 0.08), (3, 4, 1.0), (4, 5, 0.5), (4, 2, 0.1), (4, 0, 0.2)];
        let noisy = model(&[0.1, 0.5, 0.9, 0.1, 0.5, 0.9], &[0.5, 0.0, 0.0, 0.47, 0.03, 0.0], &transitions);
        let found = chains(&noisy);
        assert_eq!(found.iter().map(|c| c.0.clone()).collect::<Vec<_>>(), [vec![0, 1, 2], vec![3, 4, 5]]);
        assert!((found[0].1 + found[1].1 - 1.0).abs() < 1e-8 && found[0].1 > 0.4 && found[1].1 > 0.4);
    }

    #[test]
    fn short_cuts_prefixes_and_second_starts_belong_to_the_longer_chain() {
        // 0 -> 2 skips 1 most of the time; 3 loops back to 0.
        let short = model(&[0.1, 0.3, 0.6, 0.9], &[1.0, 0.0, 0.0, 0.0], &[(0, 2, 0.6), (0, 1, 0.4), (1, 2, 0.5), (2, 3, 0.1), (3, 0, 0.2)]);
        assert_eq!(chains(&short), [(vec![0, 1, 2, 3], 1.0)]);
        // 1 is also a start, and what follows 0.
        let late = model(&[0.1, 0.3, 0.6, 0.9], &[0.7, 0.3, 0.0, 0.0], &[(0, 2, 0.01), (0, 1, 0.09), (1, 2, 0.5), (2, 3, 0.1)]);
        assert_eq!(chains(&late), [(vec![0, 1, 2, 3], 1.0)]);
    }

    #[test]
    fn branches_that_merge_share_the_states_they_share() {
        let merging = model(&[0.1, 0.5, 0.5, 0.9], &[1.0, 0.0, 0.0, 0.0], &[(0, 1, 0.3), (0, 2, 0.2), (1, 3, 0.1), (2, 3, 0.1)]);
        assert_eq!(chains(&merging), [(vec![0, 1, 3], 0.6), (vec![0, 2, 3], 0.4)]);
    }

    #[test]
    fn a_chain_is_a_model_of_its_own() {
        let two = model(&[0.1, 0.1, 0.9, 0.9], &[0.3, 0.7, 0.0, 0.0], &[(0, 2, 0.1), (1, 3, 0.2), (1, 2, 0.004)]);
        for chain in TransitionGraph::of(&two, &DVector::zeros(0)).chains() {
            let alone = two.restricted(&chain);
            assert!(alone.check().is_ok() && alone.states() == 2 && alone.initial[0] == 1.0);
        }
    }

    #[test]
    fn every_graph_gives_chains_that_start_at_a_start_and_weigh_one() {
        for seed in 0..200 {
            let mut random = crate::math::stream(seed, "graphs", 0);
            let n = 1 + seed as usize % 25;
            let mut draw = |r, c| DMatrix::from_fn(r, c, |_, _| crate::math::uniform(&mut random, 0.0, 1.0).powi(6));
            let (mut initial, mut transition, phases) = (draw(n, 1), draw(n, n), draw(n, 1));
            initial /= initial.sum();
            for mut row in transition.row_iter_mut() {
                row /= row.sum();
            }
            let mut any = model(phases.as_slice(), initial.as_slice(), &[]);
            any.transition = transition;
            let graph = TransitionGraph::of(&any, &DVector::zeros(0));
            let chains = graph.chains();
            assert!(!chains.is_empty() && (chains.iter().map(|c| c.weight).sum::<f64>() - 1.0).abs() < 1e-9, "seed {seed}");
            for chain in &chains {
                assert!(chain.states.iter().any(|i| graph.nodes[*i].start), "seed {seed}");
                assert!(any.restricted(chain).check().is_ok(), "seed {seed}");
            }
        }
    }
}
