//! What a skill is asked for: parameters, start and goal that fit together, also when the parameters *are* the start or the goal.

use nalgebra::{DMatrix, DVector};

use super::Skill;
use crate::demonstration::ParameterSource;
use crate::learning::{ExecutionSettings, FeatureMap, LearningError};

/// How far a parameter may be from the end that it is, relative to both, or absolutely where both are below 1: digits that a person leaves out.
const SAME: f64 = 1e-3;

/// Parameters, start and goal of one execution.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// `theta_m` (p).
    pub theta: DVector<f64>,
    /// `x0` (d; unit of the motion columns).
    pub start: DVector<f64>,
    /// `g` (d; unit of the motion columns).
    pub goal: DVector<f64>,
}

impl Skill {
    /// Parameters, start and goal for these settings. Parameters that come from the start or the goal ([`Skill::parameter_source`]) need
    /// not be given: they are read off the start and goal that are asked for. What is not asked for comes from the maps of the motion.
    ///
    /// # Errors
    /// When parameters are missing or unknown, or a start or goal does not have one finite number per motion column.
    pub fn request(&self, settings: &ExecutionSettings) -> Result<Request, LearningError> {
        let d = self.motion.columns.len();
        let start = checked("start", settings.start.as_deref(), d)?;
        let goal = checked("goal", settings.goal.as_deref(), d)?;
        let theta = match self.parameter_source {
            ParameterSource::Given => self.motion.parameters.resolve(&settings.theta_m)?,
            _ if !settings.theta_m.is_empty() => self.motion.parameters.resolve(&settings.theta_m)?,
            source => self.read_off(source, start.as_ref(), goal.as_ref())?,
        };
        let (x0, g) = self.ends_at(&theta);
        Ok(Request { start: start.unwrap_or(x0), goal: goal.unwrap_or(g), theta })
    }

    /// [`super::super::ParameterSpace::extrapolation`] of what these settings ask for (-).
    ///
    /// # Errors
    /// As [`Self::request`].
    pub fn extrapolation_of(&self, settings: &ExecutionSettings) -> Result<f64, LearningError> {
        Ok(self.motion.parameters.extrapolation(&self.request(settings)?.theta))
    }

    /// Whether parameters that *are* an end of the movement are what that end says, when both are given. [`Self::request`] lets the
    /// parameters and the end each have their own way.
    ///
    /// # Errors
    /// When they are not; and as [`Self::request`].
    pub fn ends_agree(&self, settings: &ExecutionSettings) -> Result<(), LearningError> {
        let d = self.motion.columns.len();
        let (start, goal) = (checked("start", settings.start.as_deref(), d)?, checked("goal", settings.goal.as_deref(), d)?);
        let source = self.parameter_source;
        if source == ParameterSource::Given || settings.theta_m.is_empty() {
            return Ok(());
        }
        let theta = self.motion.parameters.resolve(&settings.theta_m)?;
        let Ok(read) = self.read_off(source, start.as_ref(), goal.as_ref()) else { return Ok(()) };
        for (name, (given, read)) in self.motion.parameters.names.iter().zip(theta.iter().zip(read.iter())) {
            if (given - read).abs() > SAME * given.abs().max(read.abs()).max(1.0) {
                let word = source.word();
                return Err(LearningError::Request(format!(
                    "{name} is {given}, but the ends that are asked for make it {read}: give one of the two, the parameters are the {word}"
                )));
            }
        }
        Ok(())
    }

    fn read_off(
        &self,
        source: ParameterSource,
        start: Option<&DVector<f64>>,
        goal: Option<&DVector<f64>>,
    ) -> Result<DVector<f64>, LearningError> {
        let select = selection(source, &self.motion.parameters.names, &self.motion.columns)?;
        match (source, start, goal) {
            (ParameterSource::Start, Some(x0), _) => Ok(select * x0),
            (ParameterSource::Goal, _, Some(g)) => Ok(select * g),
            (ParameterSource::StartRelativeToGoal, Some(x0), Some(g)) => Ok(select * (x0 - g)),
            (ParameterSource::StartRelativeToGoal, Some(x0), None) => self.relative_to_own_goal(&select, x0),
            _ => Err(self.nothing_to_read(source)),
        }
    }

    /// `theta = S (x0 - g(theta))`: the goal that the skill has for that very `theta`, by fixed-point iteration; linear features have a
    /// closed form.
    fn relative_to_own_goal(&self, select: &DMatrix<f64>, x0: &DVector<f64>) -> Result<DVector<f64>, LearningError> {
        /// Most iterations, and the relative change at which they end.
        const MOST: usize = 200;
        const SETTLED: f64 = 1e-12;
        let (d, map, features) = (x0.len(), &self.motion.goal, &self.motion.parameters.features);
        let no_goal = || LearningError::Request("the skill has no goal for this start: give the goal too".to_owned());
        if *features == FeatureMap::Linear {
            let effect = &map.weights * select;
            let right = &effect * x0 + &map.mean;
            let goal = (DMatrix::identity(d, d) + effect).lu().solve(&right).ok_or_else(no_goal)?;
            return Ok(select * (x0 - goal));
        }
        let mut theta = select * (x0 - &map.mean);
        for _ in 0..MOST {
            let next = select * (x0 - map.at(&features.at(&theta)));
            let change = (&next - &theta).norm();
            theta = next;
            if change <= SETTLED * theta.norm().max(1.0) {
                return Ok(theta);
            }
        }
        Err(no_goal())
    }

    fn nothing_to_read(&self, source: ParameterSource) -> LearningError {
        let (end, columns) = (if source == ParameterSource::Goal { "goal" } else { "start" }, &self.motion.columns);
        let ranges = self.motion.parameters.names.iter().zip(&self.motion.parameters.ranges);
        let ranges: Vec<String> = ranges.map(|(name, [from, to])| format!("{name} {from:.4} to {to:.4}")).collect();
        LearningError::Request(format!(
            "this skill's parameters are read off the {end} of the movement: give a {end} for [{}] (demonstrated: {})",
            columns.join(", "),
            ranges.join(", ")
        ))
    }
}

/// The matrix (p x d) that picks the parameters out of the motion columns they were read off.
pub(in crate::learning) fn selection(
    source: ParameterSource,
    parameters: &[String],
    columns: &[String],
) -> Result<DMatrix<f64>, LearningError> {
    let prefix = match source {
        ParameterSource::Given => "",
        ParameterSource::Start => "start_",
        ParameterSource::Goal => "goal_",
        ParameterSource::StartRelativeToGoal => "relative_start_",
    };
    let mut select = DMatrix::zeros(parameters.len(), columns.len());
    for (j, name) in parameters.iter().enumerate() {
        let column = name.strip_prefix(prefix).and_then(|rest| columns.iter().position(|column| column == rest));
        let unknown = || format!("parameter {name} is read off the {}, but there is no such motion column", source.word());
        select[(j, column.ok_or_else(|| LearningError::Skill(unknown()))?)] = 1.0;
    }
    Ok(select)
}

fn checked(what: &str, given: Option<&[f64]>, d: usize) -> Result<Option<DVector<f64>>, LearningError> {
    match given {
        None => Ok(None),
        Some(values) if values.len() == d && values.iter().all(|x| x.is_finite()) => Ok(Some(DVector::from_column_slice(values))),
        Some(values) => {
            Err(LearningError::Request(format!("the {what} is {values:?}, but must be {d} finite numbers, one per motion column")))
        }
    }
}
