//! How forces enter an execution: which wrench is expected, where the movement yields, and how strongly.

use crate::learning::cpdmp::{
    ComplianceWindow, CouplingMode, CouplingSettings, CouplingSpace, ForceCoupling, JACOBIAN_ROWS, Segment, Switching, compliance_windows,
};
use crate::learning::dmp::PhaseInput;
use crate::learning::{ExecutionSettings, Gmr, LearningError, Skill};
use crate::math::smooth_step;

/// `F_des(theta_f, s)` at one `theta_f`.
#[derive(Debug, Clone)]
pub(super) struct ExpectedWrench {
    gmr: Gmr,
    input: PhaseInput,
    weights: Vec<f64>,
}

/// The coupling law and where it acts.
#[derive(Debug, Clone)]
pub(super) struct Coupling {
    law: ForceCoupling,
    beta: Vec<f64>,
    /// `beta` of a model without states: 1 to minimise the force error, else 0.
    uniform: f64,
    windows: Vec<ComplianceWindow>,
    /// Length of the ramps at the windows' edges, as a fraction of the duration; 0 for none.
    ramp: f64,
    fade_start: f64,
}

impl ExpectedWrench {
    /// `None` when the skill has no force model.
    pub(super) fn of(skill: &Skill, settings: &ExecutionSettings) -> Result<Option<Self>, LearningError> {
        let Some(model) = &skill.force else {
            return match settings.theta_f.first() {
                Some((name, _)) => Err(LearningError::Request(format!("unknown parameter {name}: the skill has no force model"))),
                None => Ok(None),
            };
        };
        let gmr = model.regression_at(&model.parameters.resolve(&settings.theta_f)?)?;
        let weights = vec![0.0; gmr.components()];
        Ok(Some(Self { gmr, input: model.phase_input, weights }))
    }

    /// The wrench expected at time fraction `u` (clamped to [0, 1]), for the phase decay `alpha`.
    pub(super) fn at(&mut self, u: f64, alpha: f64, wrench: &mut [f64]) {
        let x = [self.input.at(u.clamp(0.0, 1.0), alpha)];
        self.gmr.weights(&x, &mut self.weights);
        self.gmr.mean_into(&x, &self.weights, wrench);
    }
}

impl Coupling {
    /// The law (17).
    pub(super) fn law(&self) -> &ForceCoupling {
        &self.law
    }

    /// Where the movement yields.
    pub(super) fn windows(&self) -> &[ComplianceWindow] {
        &self.windows
    }

    pub(super) fn new(settings: &CouplingSettings, skill: &Skill, wrench: &[String], segments: &[Segment]) -> Result<Self, LearningError> {
        let ramp = match settings.switching {
            Switching::Hard => 0.0,
            // 1 / (omega tau) = 1 / sqrt(K).
            Switching::Smooth(times) => times / skill.motion.stiffness.sqrt(),
        };
        let beta = settings.beta(&skill.compliance.beta)?;
        let always = settings.mode == CouplingMode::MinimiseForceError;
        Ok(Self {
            law: ForceCoupling::new(settings, &skill.motion.columns, wrench)?,
            uniform: if always { 1.0 } else { 0.0 },
            windows: if always { vec![ComplianceWindow { start: 0.0, end: 1.0 }] } else { compliance_windows(segments, &beta) },
            beta,
            ramp,
            fade_start: skill.motion.gate_start,
        })
    }

    /// `beta` of the active state and the activation `b` at time fraction `u`. `b` ramps inside the window, so that outside it nothing
    /// acts, and fades to 0 towards `u = 1`, so that the goal is reached.
    pub(super) fn strength(&self, u: f64, state: usize) -> (f64, f64) {
        let beta = self.beta.get(state).copied().unwrap_or(self.uniform);
        let Some(window) = self.windows.iter().find(|w| (w.start..w.end).contains(&u)) else { return (beta, 0.0) };
        let ramp = self.ramp.min(0.5 * (window.end - window.start));
        let inside = if ramp > 0.0 {
            smooth_step(u, window.start, window.start + ramp) * smooth_step(u, window.end, window.end - ramp)
        } else {
            1.0
        };
        (beta, inside * smooth_step(u, 1.0, self.fade_start))
    }
}

/// The columns of the wrench that a skill with these motion columns takes: those of its force model (`force`, when it has one), else those
/// that can act.
#[must_use]
pub fn wrench_columns(motion: &[String], force: Option<&[String]>, space: &CouplingSpace) -> Vec<String> {
    match (force, space) {
        (Some(columns), _) => columns.to_vec(),
        (None, CouplingSpace::Joint { .. }) => JACOBIAN_ROWS.map(str::to_owned).to_vec(),
        (None, CouplingSpace::Task) => motion.iter().filter_map(|c| Some(format!("f{}_n", c.strip_suffix("_m")?))).collect(),
    }
}
