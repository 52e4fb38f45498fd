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
    /// The method that keeps most of the ideal clearance on the ideal side on which it keeps least of it. More than the ideal counts as
    /// the ideal; of methods that keep the same within 1 % of it, the one with the smaller path error. `None` when every method fails on
    /// some side: collides there, or never passes there.
    pub winner: Option<Method>,
}

/// What a situation is beside those that were demonstrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Novelty {
    /// One of them.
    Taught,
    /// Between them.
    New,
    /// Outside of them.
    Beyond,
}

impl Novelty {
    /// Its name in words and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Taught => "taught",
            Self::New => "new",
            Self::Beyond => "beyond",
        }
    }
}

impl Case {
    /// What it is beside the demonstrated ones.
    #[must_use]
    pub fn novelty(&self) -> Novelty {
        match (self.taught, self.extrapolation > 0.0) {
            (true, _) => Novelty::Taught,
            (false, false) => Novelty::New,
            (false, true) => Novelty::Beyond,
        }
    }

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
        let rated: Vec<(Method, f64, f64)> = methods.into_iter().filter_map(|method| self.rated(method)).collect();
        let most = rated.iter().map(|(_, kept, _)| *kept).fold(f64::NEG_INFINITY, f64::max);
        let equal = rated.into_iter().filter(|(_, kept, _)| *kept >= most - EQUAL);
        self.winner = equal.min_by(|(.., a), (.., b)| a.total_cmp(b)).map(|(method, ..)| method);
    }

    /// A method with the least share of the ideal clearance that it keeps on any ideal side (-, at most 1), and its largest path error
    /// there (m); `None` when it fails on one of them.
    fn rated(&self, method: Method) -> Option<(Method, f64, f64)> {
        let sides = self.ideals.iter().map(|ideal| self.best(method, ideal.side)).collect::<Option<Vec<_>>>()?;
        let kept = sides.iter().map(|movement| movement.clearance_ratio.min(1.0)).fold(f64::INFINITY, f64::min);
        Some((method, kept, sides.iter().map(|movement| movement.path_error_m).fold(0.0, f64::max)))
    }
}
