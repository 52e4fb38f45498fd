//! One situation: what would be right, what every method does, and who does best.

use super::{Ellipse, Guidance, Method, Side};
use crate::demonstration::Parameters;

/// What the person would have done without variation and noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Ideal {
    /// On which side it passes.
    pub side: Side,
    /// Equally timed positions (m).
    pub path_m: Vec<[f64; 2]>,
    /// Its smallest signed distance to the obstacle (m).
    pub clearance_m: f64,
}

/// One movement of one method.
#[derive(Debug, Clone, PartialEq)]
pub struct Movement {
    /// What made it.
    pub method: Method,
    /// Which chain, for [`Method::CpdmpChain`]; an index into [`super::Transitions::chains`].
    pub chain: Option<usize>,
    /// Equally timed positions (m).
    pub path_m: Vec<[f64; 2]>,
    /// Smallest signed distance of the whole path to the obstacle (m); negative is the depth of penetration.
    pub clearance_m: f64,
    /// Clearance over the ideal one on its side (-): 1 is as good as the person.
    pub clearance_ratio: f64,
    /// Whether the path touches the obstacle.
    pub collides: bool,
    /// On which side the path passes the obstacle's centre; `None` when it never comes that far.
    pub side: Option<Side>,
    /// Root mean square distance from the ideal path on its side, at equal fractions of the duration (m).
    pub path_error_m: f64,
    /// Distance from where the movement ends to the goal (m).
    pub goal_error_m: f64,
}

/// One situation and what every method makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name: `goal_x_m = -1`, `half_width_m = 1.5, left`.
    pub name: String,
    /// What the models are told beside it.
    pub guidance: Guidance,
    /// The situation, by name.
    pub theta: Parameters,
    /// Whether it was demonstrated.
    pub taught: bool,
    /// How far it lies outside what was demonstrated, as a fraction of its range (-); 0 inside.
    pub extrapolation: f64,
    /// The obstacle.
    pub obstacle: Ellipse,
    /// Where the movement should end (m).
    pub goal_m: [f64; 2],
    /// What would be right: one path, or one per side where either will do.
    pub ideals: Vec<Ideal>,
    /// What the methods do.
    pub movements: Vec<Movement>,
    /// The method that keeps most of the ideal clearance on every ideal side, the smaller path error deciding among those that keep all
    /// of it;
    /// `None` when every method fails on some side.
    pub winner: Option<Method>,
}

impl Case {
    /// The movements of one method.
    pub fn of(&self, method: Method) -> impl Iterator<Item = &Movement> {
        self.movements.iter().filter(move |movement| movement.method == method)
    }

    /// The smallest clearance (m) with which a method passes on one side; `None` when it does not pass there at all.
    #[must_use]
    pub fn clearance_m(&self, method: Method, side: Side) -> Option<f64> {
        self.of(method).filter(|movement| movement.side == Some(side)).map(|movement| movement.clearance_m).reduce(f64::min)
    }

    /// The best movement of a method on one side.
    fn best(&self, method: Method, side: Side) -> Option<&Movement> {
        let there = self.of(method).filter(|movement| movement.side == Some(side) && !movement.collides);
        there.max_by(|a, b| a.clearance_ratio.total_cmp(&b.clearance_ratio))
    }

    /// Decides [`Self::winner`].
    pub(super) fn decide(&mut self) {
        /// A share of the ideal clearance that makes no difference (-).
        const EQUAL: f64 = 0.01;
        let mut methods: Vec<Method> = self.movements.iter().map(|movement| movement.method).collect();
        methods.sort();
        methods.dedup();
        let mut best: Option<(Method, f64, f64)> = None;
        for method in methods {
            let Some(sides) = self.ideals.iter().map(|ideal| self.best(method, ideal.side)).collect::<Option<Vec<_>>>() else { continue };
            let kept = sides.iter().map(|m| m.clearance_ratio.min(1.0)).fold(f64::INFINITY, f64::min);
            let error = sides.iter().map(|m| m.path_error_m).fold(0.0, f64::max);
            let better = best.is_none_or(|(_, k, e)| kept > k + EQUAL || (kept > k - EQUAL && error < e));
            if better {
                best = Some((method, kept, error));
            }
        }
        self.winner = best.map(|(method, ..)| method);
    }
}
