//! What an experiment found: everything that tables and figures need, as data.

use super::{Case, Ellipse, ForcingCurve, Guidance, Method, Side};
use crate::demonstration::Parameters;
use crate::learning::Skill;
use crate::learning::phmm::{FitStatus, StateChain, TransitionGraph};

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

/// How a method's model was learned.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelReport {
    /// Whose model.
    pub method: Method,
    /// What it was told.
    pub guidance: Guidance,
    /// Number of states, components or basis functions.
    pub states: usize,
    /// Number of starts of which the best was kept; 0 for methods without iterations.
    pub starts: usize,
    /// How the chosen start ended; `None` for methods without iterations.
    pub status: Option<FitStatus>,
    /// Objective (log-likelihood in user units plus log prior) before each iteration and after the last.
    pub log_likelihood: Vec<f64>,
    /// What a person should know about it.
    pub warnings: Vec<String>,
}

/// A skill, which moves without the experiment that it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedSkill {
    /// Whose.
    pub method: Method,
    /// What it was told.
    pub guidance: Guidance,
    /// The skill.
    pub skill: Skill,
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
    /// Every skill that was learned, CPDMP's own first. TP-GMM is none, and a chain is a part of one.
    pub skills: Vec<LearnedSkill>,
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

    /// The forcing terms of models that are told this, after those of the demonstrations: they are the same whatever is told.
    pub fn forcing_with(&self, guidance: Guidance) -> impl Iterator<Item = &ForcingCurve> {
        self.forcing.iter().filter(move |curve| curve.method.is_none() || curve.guidance == guidance)
    }

    /// The methods of these situations, each once, in their order.
    #[must_use]
    pub fn methods_with(&self, guidance: Guidance) -> Vec<Method> {
        let movements = self.cases_with(guidance).flat_map(|case| &case.movements);
        let mut methods: Vec<Method> = movements.map(|movement| movement.method).collect();
        methods.sort();
        methods.dedup();
        methods
    }

    /// What the models of this experiment are told, in order.
    #[must_use]
    pub fn guidances(&self) -> Vec<Guidance> {
        let mut guidances: Vec<Guidance> = self.cases.iter().map(|case| case.guidance).collect();
        guidances.sort();
        guidances.dedup();
        guidances
    }

    /// The situations in which the models are told the same.
    pub fn cases_with(&self, guidance: Guidance) -> impl Iterator<Item = &Case> {
        self.cases.iter().filter(move |case| case.guidance == guidance)
    }
}
