//! What an experiment found: everything that tables and figures need, as data.

use super::{Ellipse, ForcingCurve};
use crate::demonstration::Parameters;
use crate::learning::phmm::{FitStatus, StateChain, TransitionGraph};

/// What made a movement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// The parametric model of the paper, read by regression over all its states.
    Cpdmp,
    /// The same, told `side x half width` as a third parameter: means that are linear in `theta` cannot form a product.
    CpdmpProduct,
    /// The same model as [`Self::Cpdmp`] taken apart: regression over the states of one chain.
    CpdmpChain,
    /// A primitive whose forcing term is locally weighted regression, blind to parameters; it is told the new goal.
    LwrDmp,
    /// Task-parameterised Gaussian mixture: the paper's rival.
    TpGmm,
}

impl Method {
    /// Its name in keys and columns.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Cpdmp => "cpdmp",
            Self::CpdmpProduct => "cpdmp_product",
            Self::CpdmpChain => "cpdmp_chain",
            Self::LwrDmp => "lwr_dmp",
            Self::TpGmm => "tp_gmm",
        }
    }

    /// Its name in tables and figures.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Cpdmp => "CPDMP",
            Self::CpdmpProduct => "CPDMP, side x width",
            Self::CpdmpChain => "CPDMP, one chain",
            Self::LwrDmp => "LWR-DMP",
            Self::TpGmm => "TP-GMM",
        }
    }

    /// Whether it is one of the paper's, not a rival.
    #[must_use]
    pub fn is_cpdmp(self) -> bool {
        matches!(self, Self::Cpdmp | Self::CpdmpProduct | Self::CpdmpChain)
    }
}

/// On which side of the obstacle a movement passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// Negative x.
    Left,
    /// Positive x.
    Right,
}

impl Side {
    /// -1 or +1, as in `theta`.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }

    /// Its name in keys, tables and figures.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// What a model is told beside the shape of the task.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Guidance {
    /// The task leaves no choice of the side (section 4.1).
    OneSide,
    /// The side is a parameter (section 4.2, first part).
    WithSide,
    /// The side is not told (section 4.2, second part).
    WithoutSide,
}

/// A demonstration.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// Its name.
    pub name: String,
    /// The situation, by name.
    pub theta: Parameters,
    /// On which side it passes.
    pub side: Side,
    /// The obstacle it passes.
    pub obstacle: Ellipse,
    /// Positions as recorded (m).
    pub path_m: Vec<[f64; 2]>,
    /// Its smallest signed distance to the obstacle (m).
    pub clearance_m: f64,
}

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
    /// Which chain, for [`Method::CpdmpChain`]; an index into [`Transitions::chains`].
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
    /// The method that keeps most of the ideal clearance on every ideal side, the smaller path error deciding among those that keep all of it;
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

/// How a method's model was learned.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelReport {
    /// Whose model.
    pub method: Method,
    /// What it was told.
    pub guidance: Guidance,
    /// Number of states, components or basis functions.
    pub states: usize,
    /// How the chosen start ended; `None` for methods without iterations.
    pub status: Option<FitStatus>,
    /// Objective (log-likelihood in user units plus log prior) before each iteration and after the last.
    pub log_likelihood: Vec<f64>,
    /// What a person should know about it.
    pub warnings: Vec<String>,
}

/// How the states of the model without side follow each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Transitions {
    /// Probability of going from the row's state to the column's, row by row (N of N).
    pub matrix: Vec<Vec<f64>>,
    /// States and the transitions that matter.
    pub graph: TransitionGraph,
    /// The chains, the most probable one first.
    pub chains: Vec<StateChain>,
}

/// Everything an experiment found.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarOutcome {
    /// What was shown.
    pub demonstrations: Vec<Shown>,
    /// How the models were learned.
    pub models: Vec<ModelReport>,
    /// Every situation, taught ones first.
    pub cases: Vec<Case>,
    /// Forcing terms: those of the demonstrations first, then those of the models.
    pub forcing: Vec<ForcingCurve>,
    /// The chains, where there are some (section 4.2 without side).
    pub transitions: Option<Transitions>,
}

impl PlanarOutcome {
    /// The report on one model.
    #[must_use]
    pub fn model(&self, method: Method, guidance: Guidance) -> Option<&ModelReport> {
        self.models.iter().find(|model| model.method == method && model.guidance == guidance)
    }

    /// The situations in which the models are told the same.
    pub fn cases_with(&self, guidance: Guidance) -> impl Iterator<Item = &Case> {
        self.cases.iter().filter(move |case| case.guidance == guidance)
    }
}
