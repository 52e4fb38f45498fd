//! A filled tree to the settings of learning and coupling.

use super::tree::Node;
use crate::learning::cpdmp::{
    ComplianceSettings, CouplingMode, CouplingSettings, CouplingSpace, ForceConvention, Statistic, Switching, Threshold,
};
use crate::learning::dmp::PhaseInput;
use crate::learning::phmm::{CovarianceMode, PhmmSettings, Topology};
use crate::learning::selection::{StatesCriterion, StatesSearch};
use crate::learning::{Features, LearningSettings, ShapingKind};

/// How the skill is learned.
pub(super) fn learning(table: &Node) -> LearningSettings {
    LearningSettings {
        shaping: if table.text("shaping") == "lwr" { ShapingKind::Lwr } else { ShapingKind::Phmm },
        stiffness: table.number("stiffness"),
        alpha: table.number("alpha"),
        phase_input: if table.text("phase_input") == "phase" { PhaseInput::Phase } else { PhaseInput::TimeFraction },
        rate_hz: table.number("rate_hz"),
        smoothing_window_s: table.number("smoothing_window_s"),
        smoothing_degree: table.size("smoothing_degree"),
        gate_start: table.number("gate_start"),
        motion: hidden_markov_model(&table.section("motion")),
        force: hidden_markov_model(&table.section("force")),
        lwr_basis: table.size("lwr_basis"),
        compliance: compliance(&table.section("compliance")),
        orientation_basis: table.size("orientation_basis"),
        align: table.flag("align"),
        automatic_ridge: table.flag("automatic_ridge"),
        states_search: states_search(table),
    }
}

fn states_search(table: &Node) -> Option<StatesSearch> {
    let criterion = match table.text("states_criterion") {
        "bic" => StatesCriterion::Bic,
        "cross_validation" => StatesCriterion::CrossValidation,
        _ => return None,
    };
    Some(StatesSearch { criterion, min: table.size("states_min"), max: table.size("states_max") })
}

fn hidden_markov_model(table: &Node) -> PhmmSettings {
    PhmmSettings {
        states: table.size("states"),
        topology: if table.text("topology") == "ergodic" { Topology::Ergodic } else { Topology::LeftToRight },
        weights_on_phase: table.flag("weights_on_phase"),
        features: match table.text("features") {
            "quadratic" => Features::Quadratic,
            "rbf" => Features::Rbf { centres: table.size("rbf_centres"), width: table.number("rbf_width") },
            _ => Features::Linear,
        },
        covariance: if table.text("covariance") == "fixed" { CovarianceMode::Fixed } else { CovarianceMode::Estimated },
        ridge: table.number("ridge"),
        covariance_floor: table.number("covariance_floor"),
        kmeans_starts: table.count("kmeans_starts"),
        max_iterations: table.size("max_iterations"),
        tolerance: table.number("tolerance"),
    }
}

fn compliance(table: &Node) -> ComplianceSettings {
    let statistic = match table.text("statistic") {
        "literal" => Statistic::Literal,
        "conditional" => Statistic::Conditional,
        _ => Statistic::BetweenDemonstration,
    };
    let threshold = table.optional_number("threshold_m2").map_or(Threshold::Automatic, Threshold::Absolute);
    ComplianceSettings { statistic, threshold }
}

/// How force error moves the skill.
pub(super) fn coupling(table: &Node) -> CouplingSettings {
    let switching = if table.text("switching") == "hard" { Switching::Hard } else { Switching::Smooth(table.number("switching_ramp")) };
    CouplingSettings {
        enabled: table.flag("enabled"),
        compliance_m_per_n: table.numbers("compliance_m_per_n"),
        saturation_m: table.number("saturation_m"),
        convention: if table.text("convention") == "on_world" { ForceConvention::OnWorld } else { ForceConvention::OnRobot },
        switching,
        mode: coupling_mode(table),
        space: CouplingSpace::Task,
    }
}

fn coupling_mode(table: &Node) -> CouplingMode {
    match table.text("mode") {
        "minimise_force_error" => CouplingMode::MinimiseForceError,
        "per_state" => CouplingMode::PerState(table.numbers("beta")),
        _ => CouplingMode::Comply,
    }
}
