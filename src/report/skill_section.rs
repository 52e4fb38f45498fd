//! What a skill holds, for people and for other programs.

use std::collections::BTreeMap;

use nalgebra::DVector;
use schemars::JsonSchema;
use serde::Serialize;

use super::Window;
use super::table::{figure, table};
use crate::learning::cpdmp::{Segment, Shaping, Statistic, compliance_windows, segments, squared_unit};
use crate::learning::phmm::FitStatus;
use crate::learning::{FitReport, LearningError, ParameterSpace, Skill};

/// What a skill holds. States and windows are those at the middle of the demonstrated parameters.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SkillSection {
    /// What stands for the forcing term: `phmm`, or `lwr`.
    pub shaping: &'static str,
    /// Motion columns.
    pub columns: Vec<String>,
    /// Wrench columns; none without a force model.
    pub wrench: Vec<String>,
    /// Where the motion's parameters come from: `given`, `start`, `goal` or `start_relative_to_goal`.
    pub parameter_source: &'static str,
    /// Parameters of the motion.
    pub parameters: Vec<ParameterRange>,
    /// Parameters of the force.
    pub force_parameters: Vec<ParameterRange>,
    /// Learned duration (s).
    pub duration_s: f64,
    /// `K`.
    pub stiffness: f64,
    /// Whether it turns the tool.
    pub orientation: bool,
    /// Whether it opens and closes the gripper.
    pub gripper: bool,
    /// Number of states of the force model.
    pub force_states: Option<usize>,
    /// States of the motion model, in order; none for the baseline.
    pub states: Vec<StateRow>,
    /// What decides about compliance: `literal`, `conditional` or `between_demonstration`.
    pub statistic: &'static str,
    /// Unit of the statistic and of the threshold: `m^2`, of joints `rad^2`.
    pub statistic_unit: &'static str,
    /// `sigma` (`statistic_unit`); none when no threshold separates the states.
    pub threshold_m2: Option<f64>,
    /// When it complies, at the learned duration.
    pub windows: Vec<Window>,
    /// Where it comes from.
    pub provenance: BTreeMap<String, String>,
}

/// A parameter and the range in which it was demonstrated.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ParameterRange {
    /// Its name.
    pub name: String,
    /// Smallest demonstrated value; none when the file does not say.
    pub from: Option<f64>,
    /// Largest.
    pub to: Option<f64>,
}

/// One state of the motion model.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StateRow {
    /// Counted from 0.
    pub index: usize,
    /// When it is the most responsible one (s); none when it never is.
    pub from_s: Option<f64>,
    /// Until when (s).
    pub to_s: Option<f64>,
    /// How long, gaps left out (s).
    pub duration_s: f64,
    /// Mean of the forcing term (unit of each column).
    pub mean: Vec<f64>,
    /// Standard deviation of the forcing term, given the phase (unit of each column).
    pub spread: Vec<f64>,
    /// The statistic that is held against the threshold (`statistic_unit` of the skill).
    pub value_m2: f64,
    /// -1 complies, 0 is stiff.
    pub beta: f64,
}

/// How one model was fitted.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FitSection {
    /// Number of states.
    pub states: usize,
    /// Number of starts.
    pub starts: usize,
    /// How many of them came within 1e-6 of the best objective.
    pub starts_at_best: usize,
    /// Iterations of the start that was kept.
    pub iterations: usize,
    /// How it ended.
    pub status: &'static str,
    /// Objective (log-likelihood with log prior) before each iteration and after the last.
    pub log_likelihood: Vec<f64>,
}

impl FitSection {
    /// From what learning reports.
    pub fn of(fit: &FitReport) -> Self {
        let best = fit.starts.iter().map(|start| start.objective).fold(f64::NEG_INFINITY, f64::max);
        Self {
            states: fit.states,
            starts: fit.starts.len(),
            starts_at_best: fit.starts.iter().filter(|start| best - start.objective <= 1e-6 * best.abs()).count(),
            iterations: fit.log_likelihood.len().saturating_sub(1),
            status: match fit.status {
                FitStatus::Converged => "converged",
                FitStatus::IterationLimit => "iteration_limit",
                FitStatus::Fell => "fell",
                FitStatus::Degenerate => "degenerate",
            },
            log_likelihood: fit.log_likelihood.iter().copied().filter(|value| value.is_finite()).collect(),
        }
    }
}

impl SkillSection {
    /// Reads a skill.
    ///
    /// # Errors
    /// When its covariances are not usable.
    pub fn of(skill: &Skill) -> Result<Self, LearningError> {
        let motion = &skill.motion;
        let middle = motion.parameters.ranges.iter().map(|[from, to]| from / 2.0 + to / 2.0);
        let theta = DVector::from_iterator(motion.parameters.ranges.len(), middle);
        let mut shaping = motion.shaping_at(&theta)?;
        let segments = segments(&mut shaping);
        let windows = compliance_windows(&segments, &skill.compliance.beta);
        let window = |start: f64, end: f64| Window { start_s: start * motion.duration_s, end_s: end * motion.duration_s };
        Ok(Self {
            shaping: if matches!(motion.shaping, Shaping::Phmm(_)) { "phmm" } else { "lwr" },
            columns: motion.columns.clone(),
            wrench: skill.force.as_ref().map_or_else(Vec::new, |force| force.columns.clone()),
            parameter_source: skill.parameter_source.word(),
            parameters: ranges(&motion.parameters),
            force_parameters: skill.force.as_ref().map_or_else(Vec::new, |force| ranges(&force.parameters)),
            duration_s: motion.duration_s,
            stiffness: motion.stiffness,
            orientation: skill.orientation.is_some(),
            gripper: skill.gripper.is_some(),
            force_states: skill.force.as_ref().map(|force| force.phmm.states()),
            states: states(skill, &theta, &segments)?,
            statistic: match skill.compliance.statistic {
                Statistic::Literal => "literal",
                Statistic::Conditional => "conditional",
                Statistic::BetweenDemonstration => "between_demonstration",
            },
            statistic_unit: squared_unit(&motion.columns),
            threshold_m2: Some(skill.compliance.threshold_m2).filter(|sigma| sigma.is_finite()),
            windows: windows.iter().map(|w| window(w.start, w.end)).collect(),
            provenance: skill.provenance.iter().cloned().collect(),
        })
    }

    /// The section as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let list = |names: &[String]| if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        let parameters = |of: &[ParameterRange]| list(&of.iter().map(ParameterRange::text).collect::<Vec<_>>());
        let model = if self.shaping == "lwr" { "locally weighted regression" } else { "parametric hidden Markov model" };
        let states = if self.states.is_empty() { String::new() } else { format!(", {} states", self.states.len()) };
        let force = self.force_states.map_or("none".to_owned(), |n| format!("{}, {n} states", list(&self.wrench)));
        let source = if self.parameter_source == "given" { String::new() } else { format!(" (from the {})", self.parameter_source) };
        let also: Vec<&str> =
            [(self.orientation, "orientation"), (self.gripper, "gripper")].iter().filter(|(has, _)| *has).map(|(_, name)| *name).collect();
        let mut lines = vec![
            format!("  motion       {}: {model}{states}", list(&self.columns)),
            format!("  parameters   {}{source}", parameters(&self.parameters)),
            format!("  force        {force}"),
            format!("  duration     {} s, stiffness {}", figure(self.duration_s), figure(self.stiffness)),
        ];
        if !self.force_parameters.is_empty() {
            lines.insert(3, format!("  theta_f      {}", parameters(&self.force_parameters)));
        }
        if !also.is_empty() {
            lines.push(format!("  also         {}", also.join(", ")));
        }
        if !self.states.is_empty() {
            lines.push(String::new());
            lines.extend(self.state_table());
            lines.push(String::new());
            lines.push(self.compliance());
        }
        lines
    }

    fn state_table(&self) -> Vec<String> {
        let mut heading: Vec<String> = ["state", "from s", "to s", "for s"].map(str::to_owned).to_vec();
        heading.extend(self.columns.iter().map(|name| format!("mean f {name}")));
        heading.extend(self.columns.iter().map(|name| format!("std f {name}")));
        heading.extend([format!("{} {}", self.statistic.replace('_', " "), self.shown_unit()), "beta".to_owned(), String::new()]);
        let time = |t: Option<f64>| t.map_or("-".to_owned(), |t| format!("{t:.2}"));
        let row = |state: &StateRow| {
            let mut row = vec![state.index.to_string(), time(state.from_s), time(state.to_s), format!("{:.2}", state.duration_s)];
            row.extend(state.mean.iter().chain(&state.spread).map(|value| figure(*value)));
            let word = if state.beta == 0.0 { "stiff" } else { "complies" };
            row.extend([figure(state.value_m2), figure(state.beta), word.to_owned()]);
            row
        };
        table(&std::iter::once(heading).chain(self.states.iter().map(row)).collect::<Vec<_>>())
    }

    fn compliance(&self) -> String {
        let windows: Vec<String> = self.windows.iter().map(|w| format!("{:.2} … {:.2} s", w.start_s, w.end_s)).collect();
        let when = if windows.is_empty() { "never".to_owned() } else { windows.join(", ") };
        let sigma = self
            .threshold_m2
            .map_or("none that separates the states".to_owned(), |sigma| format!("{} {}", figure(sigma), self.shown_unit()));
        format!("  complies     {when} (threshold sigma: {sigma})")
    }

    /// The unit of the statistic for people.
    fn shown_unit(&self) -> String {
        self.statistic_unit.replace("^2", "²")
    }
}

impl ParameterRange {
    fn text(&self) -> String {
        match (self.from, self.to) {
            (Some(from), Some(to)) if from == to => format!("{} = {}", self.name, figure(from)),
            (Some(from), Some(to)) => format!("{} {} … {}", self.name, figure(from), figure(to)),
            _ => self.name.clone(),
        }
    }
}

fn ranges(space: &ParameterSpace) -> Vec<ParameterRange> {
    let known = |value: f64| Some(value).filter(|value| value.abs() < f64::MAX);
    let both = space.names.iter().zip(&space.ranges);
    both.map(|(name, [from, to])| ParameterRange { name: name.clone(), from: known(*from), to: known(*to) }).collect()
}

fn states(skill: &Skill, theta: &DVector<f64>, segments: &[Segment]) -> Result<Vec<StateRow>, LearningError> {
    let Shaping::Phmm(phmm) = &skill.motion.shaping else { return Ok(Vec::new()) };
    let (shaping, features) = (skill.motion.shaping_at(theta)?, skill.motion.parameters.features.at(theta));
    let duration = skill.motion.duration_s;
    let row = |i: usize| {
        let active: Vec<&Segment> = segments.iter().filter(|segment| segment.state == i).collect();
        let spread = shaping.mixture().map(|(gmr, _)| gmr.conditional_covariance(i).diagonal());
        StateRow {
            index: i,
            from_s: active.first().map(|segment| segment.start * duration),
            to_s: active.last().map(|segment| segment.end * duration),
            duration_s: active.iter().fold(0.0, |sum, segment| sum + segment.end - segment.start) * duration,
            mean: phmm.mean_at(i, &features).iter().skip(1).copied().collect(),
            spread: spread.iter().flat_map(|variances| variances.iter()).map(|v| v.max(0.0).sqrt()).collect(),
            value_m2: skill.compliance.values_m2[i],
            beta: skill.compliance.beta[i],
        }
    };
    Ok((0..phmm.states()).map(row).collect())
}
