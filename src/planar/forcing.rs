//! Forcing terms over the phase, with the Gaussians that make them: the paper's Figs. 1 and 3.

use nalgebra::Matrix3;

use super::{Guidance, Method, chain_color};
use crate::demonstration::{Dataset, Parameters};
use crate::learning::{LearningError, LearningSettings, Skill, motion_sequences};
use crate::palette::Rgb;
use crate::palette::meaning::{STIFF, TAUGHT};

/// The parameter that tells the obstacle's half width (m).
pub(super) const HALF_WIDTH: &str = "half_width_m";

/// One state's Gaussian over (phase input, forcing along x, forcing along y) at one `theta`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateGaussian {
    /// Its number in the model.
    pub state: usize,
    /// Its mean (-, m, m).
    pub mean: [f64; 3],
    /// Its covariance, row by row (squares of those units).
    pub covariance: [[f64; 3]; 3],
}

/// A forcing term over the phase input.
#[derive(Debug, Clone, PartialEq)]
pub struct ForcingCurve {
    /// Whose; `None` for what a demonstration's forcing term must have been (4).
    pub method: Option<Method>,
    /// What the model was told.
    pub guidance: Guidance,
    /// Which chain, for [`Method::CpdmpChain`].
    pub chain: Option<usize>,
    /// The situation, by name.
    pub theta: Parameters,
    /// Whether it was demonstrated.
    pub taught: bool,
    /// The phase input of the model: the time fraction `u`, or `s` where settings say so (-).
    pub phase: Vec<f64>,
    /// `f` along x and y (m).
    pub forcing_m: Vec<[f64; 2]>,
    /// The states at this `theta`; none for demonstrations and for methods without states.
    pub states: Vec<StateGaussian>,
}

impl ForcingCurve {
    /// The half width of the obstacle that was told (m); none where the obstacle is always the same.
    #[must_use]
    pub fn half_width_m(&self) -> Option<f64> {
        self.theta.iter().find(|(name, _)| name == HALF_WIDTH).map(|(_, value)| *value)
    }

    /// Its colour, wherever it is drawn: that of its chain, or else of its method.
    #[must_use]
    pub fn color(&self) -> Rgb {
        self.chain.map(chain_color).or(self.method.map(Method::color)).unwrap_or(TAUGHT)
    }

    /// The colour of its states: that of states that do nothing about forces, of which a plane has none; those of a chain are told from others by
    /// its colour.
    #[must_use]
    pub fn color_of_states(&self) -> Rgb {
        self.chain.map_or(STIFF, chain_color)
    }
}

/// What the forcing terms of the demonstrations must have been (4), one curve per demonstration.
///
/// # Errors
/// As [`motion_sequences`].
pub fn demonstrated_forcing(
    dataset: &Dataset,
    settings: &LearningSettings,
    guidance: Guidance,
) -> Result<Vec<ForcingCurve>, LearningError> {
    let sequences = motion_sequences(dataset, settings)?;
    let curves = dataset.demonstrations.iter().zip(&sequences).map(|(demonstration, sequence)| {
        let rows = sequence.values.chunks_exact(sequence.dimension);
        ForcingCurve {
            method: None,
            guidance,
            chain: None,
            theta: demonstration.theta_m.clone(),
            taught: true,
            phase: rows.clone().map(|row| row[0]).collect(),
            forcing_m: rows.map(|row| [row[1], row[2]]).collect(),
            states: Vec::new(),
        }
    });
    Ok(curves.collect())
}

/// The forcing term of a planar skill at `theta`, with its states.
///
/// # Errors
/// When a parameter is missing or unknown, or the skill is not planar.
pub fn forcing_curve(
    (method, guidance, chain): (Method, Guidance, Option<usize>),
    skill: &Skill,
    theta: &Parameters,
    taught: bool,
) -> Result<ForcingCurve, LearningError> {
    /// Points of a curve.
    const POINTS: usize = 201;
    let values = skill.motion.parameters.resolve(theta)?;
    let mut shaping = skill.motion.shaping_at(&values)?;
    let (mut phase, mut forcing_m, mut f) = (Vec::with_capacity(POINTS), Vec::with_capacity(POINTS), [0.0; 2]);
    if skill.motion.columns.len() != f.len() {
        return Err(LearningError::Request(format!("{} motion columns, but a planar skill has 2", skill.motion.columns.len())));
    }
    for i in 0..POINTS {
        let u = i as f64 / (POINTS - 1) as f64;
        shaping.forcing(u, &mut f);
        phase.push(skill.motion.phase_input.at(u, skill.motion.alpha));
        forcing_m.push(f);
    }
    let states = match skill.motion.phmm() {
        None => Vec::new(),
        Some(phmm) => (0..phmm.states())
            .map(|state| {
                let (mean, covariance) = (phmm.mean_at(state, &values), &phmm.covariances[state]);
                let covariance = Matrix3::from_fn(|a, b| covariance[(a, b)]).transpose().into();
                StateGaussian { state, mean: [mean[0], mean[1], mean[2]], covariance }
            })
            .collect(),
    };
    Ok(ForcingCurve { method: Some(method), guidance, chain, theta: theta.clone(), taught, phase, forcing_m, states })
}
