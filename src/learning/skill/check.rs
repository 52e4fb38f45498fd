//! Whether the parts of a skill fit together and hold usable numbers.

use super::Skill;
use super::request::selection;
use crate::demonstration::ParameterSource;
use crate::learning::cpdmp::Shaping;
use crate::learning::phmm::StateEvidence;
use crate::learning::{Combination, LearningError};

/// The most columns of a model, as in datasets.
const MOST_COLUMNS: usize = 32;
/// The most parameters of a model.
const MOST_PARAMETERS: usize = 64;

impl Skill {
    /// Checks that all parts fit together and hold usable numbers.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self) -> Result<(), LearningError> {
        let wrong = |what: String| Err(LearningError::Skill(what));
        let m = &self.motion;
        let (d, p) = (m.columns.len(), m.parameters.names.len());
        m.parameters.features.check(p)?;
        let q = m.parameters.feature_count();
        let scalars = [("stiffness", m.stiffness), ("duration_s", m.duration_s), ("alpha", m.alpha)];
        if let Some((name, value)) = scalars.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
            return wrong(format!("motion.{name} is {value}, but must be positive"));
        }
        if !(0.0..1.0).contains(&m.gate_start) {
            return wrong(format!("motion.gate_start is {}, but must be at least 0 and below 1", m.gate_start));
        }
        if d == 0 || m.parameters.ranges.len() != p {
            return wrong(format!("motion has {d} columns, {p} parameters and {} parameter ranges", m.parameters.ranges.len()));
        }
        self.check_names()?;
        for (name, map) in [("start", &m.start), ("goal", &m.goal)] {
            if map.mean.len() != d || map.weights.shape() != (d, q) {
                return wrong(format!("motion.{name} is not over {d} columns and {q} features"));
            }
            if !finite(map.mean.iter().chain(map.weights.iter())) {
                return wrong(format!("motion.{name} holds a number that is not finite"));
            }
        }
        if self.parameter_source != ParameterSource::Given {
            selection(self.parameter_source, &m.parameters.names, &m.columns)?;
        }
        self.check_shaping(d, q)?;
        self.check_profiles(self.motion.parameters.feature_count())?;
        check_evidence(&m.evidence, m.states(), q)?;
        if let Some(force) = &self.force {
            force.phmm.check()?;
            force.parameters.features.check(force.parameters.names.len())?;
            let shape = (force.columns.len() + 1, force.parameters.feature_count());
            if (force.phmm.dimension(), force.phmm.parameters()) != shape || force.parameters.ranges.len() != force.parameters.names.len() {
                return wrong(format!("force.phmm is not over the phase, {} columns and {} features", shape.0 - 1, shape.1));
            }
            check_evidence(&force.evidence, force.phmm.states(), shape.1)?;
        }
        Ok(())
    }

    /// Names, ranges and histories: what a file keeps beside the models.
    fn check_names(&self) -> Result<(), LearningError> {
        let wrong = |what: String| Err(LearningError::Skill(what));
        let mut spaces = vec![("motion", &self.motion.columns, &self.motion.parameters)];
        spaces.extend(self.force.as_ref().map(|force| ("force", &force.columns, &force.parameters)));
        for (place, columns, parameters) in spaces {
            if columns.len() > MOST_COLUMNS || parameters.names.len() > MOST_PARAMETERS {
                return wrong(format!("{place} has more than {MOST_COLUMNS} columns or {MOST_PARAMETERS} parameters"));
            }
            for (kind, names) in [("columns", columns), ("parameters", &parameters.names)] {
                if let Some(name) = (1..names.len()).find(|i| names[..*i].contains(&names[*i])).map(|i| &names[i]) {
                    return wrong(format!("{place}.{kind} holds {name} twice"));
                }
            }
            let ordered = |[from, to]: &[f64; 2]| from.is_finite() && to.is_finite() && from <= to;
            if let Some(j) = parameters.ranges.iter().position(|range| !ordered(range)) {
                let [from, to] = parameters.ranges[j];
                return wrong(format!("{place}.parameter_ranges[{j}] is [{from}, {to}], but must be two finite numbers that rise"));
            }
            let p = parameters.names.len();
            let sound = |c: &Combination| c.direction.len() == p && finite(c.direction.iter()) && ordered(&c.range);
            if let Some(j) = parameters.combinations.iter().position(|combination| !sound(combination)) {
                return wrong(format!("{place}.parameter_combinations[{j}] is not a direction of {p} numbers with a range that rises"));
            }
        }
        match self.histories.iter().find(|(_, history)| !finite(history.iter())) {
            Some((of, _)) => wrong(format!("{of}.phmm.log_likelihood holds a number that is not finite")),
            None => Ok(()),
        }
    }

    fn check_shaping(&self, d: usize, q: usize) -> Result<(), LearningError> {
        let wrong = |what: String| Err(LearningError::Skill(what));
        match &self.motion.shaping {
            Shaping::Phmm(phmm) => {
                phmm.check()?;
                if (phmm.dimension(), phmm.parameters()) != (d + 1, q) {
                    return wrong(format!("motion.phmm is not over the phase, {d} columns and {q} features"));
                }
            }
            Shaping::Lwr(lwr) => {
                let m = lwr.centres.len();
                let numbers = lwr.centres.iter().chain(lwr.widths.iter()).chain(lwr.weights.iter());
                if m == 0 || lwr.widths.len() != m || lwr.weights.shape() != (m, d) || !finite(numbers) {
                    return wrong(format!("motion.lwr is not over {d} columns with finite centres, widths and weights"));
                }
            }
        }
        let (n, c) = (self.motion.states(), &self.compliance);
        let states = [c.values_m2.len(), c.beta.len(), c.between.len()];
        if states.iter().any(|found| *found != n) || c.between.iter().any(|b| b.shape() != (d, d)) {
            return wrong(format!("compliance is not over the {n} states and {d} columns of the motion"));
        }
        if !finite(c.values_m2.iter().chain(&c.beta).chain(c.between.iter().flat_map(|b| b.iter()))) || c.threshold_m2.is_nan() {
            return wrong("compliance holds a number that is not finite".to_owned());
        }
        if let Some(value) = c.values_m2.iter().chain([&c.threshold_m2]).find(|value| **value < 0.0) {
            return wrong(format!("compliance.values_m2 or threshold_m2 holds {value}, but must not be negative"));
        }
        if let Some(beta) = c.beta.iter().find(|beta| **beta != 0.0 && **beta != -1.0) {
            return wrong(format!("compliance.beta holds {beta}, but must be 0 (stiff) or -1 (complies)"));
        }
        Ok(())
    }

    fn check_profiles(&self, features: usize) -> Result<(), LearningError> {
        let wrong = |what: &str| Err(LearningError::Skill(what.to_owned()));
        if let Some(o) = &self.orientation {
            let shape = (o.mean.nrows(), 3);
            let shaped =
                shape.0 >= 2 && o.mean.shape() == shape && o.weights.len() == features && o.weights.iter().all(|w| w.shape() == shape);
            let numbers = o.mean.iter().chain(o.weights.iter().flat_map(|w| w.iter()));
            let path = o.path.iter().flat_map(|path| path.iter());
            let path_shaped = o.path.as_ref().is_none_or(|path| path.shape() == (shape.0, 4));
            if !path_shaped || !finite(path) {
                return wrong("orientation.reference_path is not a finite quaternion for every row of orientation.mean");
            }
            if !shaped || !finite(numbers) || !finite(o.reference.coords.iter()) {
                return wrong("orientation is not a profile of finite rotation vectors for the motion's features");
            }
        }
        if let Some(g) = &self.gripper
            && (g.openings.len() < 2 || !finite(g.openings.iter()))
        {
            return wrong("gripper is not a list of at least two finite openings");
        }
        Ok(())
    }
}

/// Evidence may be missing, but not in part.
fn check_evidence(evidence: &[StateEvidence], states: usize, features: usize) -> Result<(), LearningError> {
    if !evidence.is_empty() && evidence.len() != states {
        return Err(LearningError::Skill(format!("evidence for {} states, but the model has {states}", evidence.len())));
    }
    evidence.iter().enumerate().try_for_each(|(i, e)| e.check(i, features))
}

fn finite<'a>(mut numbers: impl Iterator<Item = &'a f64>) -> bool {
    numbers.all(|x| x.is_finite())
}
