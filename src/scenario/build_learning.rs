//! A filled tree to the settings of learning and coupling.

use super::schema_learning::AUTO;
use super::tree::Node;
use crate::learning::cpdmp::{
    ComplianceSettings, CouplingMode, CouplingSettings, CouplingSpace, ForceConvention, Statistic, Switching, Threshold,
};
use crate::learning::dmp::PhaseInput;
use crate::learning::phmm::{CovarianceMode, PhmmSettings, Topology};
use crate::learning::selection::{Selection, StatesCriterion, StatesSearch};
use crate::learning::{EndRule, Features, LearningSettings, ShapingKind};

/// How the skill is learned.
pub(super) fn learning(table: &Node) -> LearningSettings {
    let defaults = LearningSettings::default();
    LearningSettings {
        shaping: if table.text("shaping") == "lwr" { ShapingKind::Lwr } else { ShapingKind::Phmm },
        stiffness: table.number("stiffness"),
        alpha: table.number("alpha"),
        phase_input: if table.text("phase_input") == "phase" { PhaseInput::Phase } else { PhaseInput::TimeFraction },
        rate_hz: table.number("rate_hz"),
        smoothing_window_s: table.number("smoothing_window_s"),
        smoothing_degree: table.size("smoothing_degree"),
        gate_start: table.number("gate_start"),
        motion: hidden_markov_model(&table.section("motion"), &defaults.motion),
        force: hidden_markov_model(&table.section("force"), &defaults.force),
        lwr_basis: table.size("lwr_basis"),
        lwr_ends: if table.text("lwr_ends") == "regression" { EndRule::Regression } else { EndRule::Mean },
        compliance: compliance(&table.section("compliance")),
        orientation_basis: table.size("orientation_basis"),
        align: table.flag("align"),
        motion_selection: Selection {
            states: states_search(table, "motion", table.text("states_criterion") != "given"),
            ridge: is_automatic(table, "motion", "ridge") || table.flag("automatic_ridge"),
        },
        force_selection: Selection { states: states_search(table, "force", false), ridge: is_automatic(table, "force", "ridge") },
    }
}

/// Whether a key of a model leaves its value to the demonstrations.
pub(super) fn is_automatic(learning: &Node, model: &str, key: &str) -> bool {
    learning.section(model).text(key) == AUTO
}

/// How a model's number of states is chosen, if it is: because it says so, or because it is asked for.
fn states_search(learning: &Node, model: &str, asked: bool) -> Option<StatesSearch> {
    let criterion = if learning.text("states_criterion") == "bic" { StatesCriterion::Bic } else { StatesCriterion::CrossValidation };
    let search = StatesSearch { criterion, min: learning.size("states_min"), max: learning.size("states_max") };
    (asked || is_automatic(learning, model, "states")).then_some(search)
}

/// The settings of a model. What the demonstrations choose begins at the default.
fn hidden_markov_model(table: &Node, default: &PhmmSettings) -> PhmmSettings {
    PhmmSettings {
        states: if table.text("states") == AUTO { default.states } else { table.size("states") },
        topology: if table.text("topology") == "ergodic" { Topology::Ergodic } else { Topology::LeftToRight },
        weights_on_phase: table.flag("weights_on_phase"),
        features: match table.text("features") {
            "quadratic" => Features::Quadratic,
            "rbf" => Features::Rbf { centres: table.size("rbf_centres"), width: table.number("rbf_width") },
            _ => Features::Linear,
        },
        covariance: if table.text("covariance") == "fixed" { CovarianceMode::Fixed } else { CovarianceMode::Estimated },
        ridge: if table.text("ridge") == AUTO { default.ridge } else { table.number("ridge") },
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
        space: match table.text("space") {
            "joint" => CouplingSpace::Joint {
                compliance_rad_per_nm: table.numbers("compliance_rad_per_nm"),
                saturation_rad: table.number("saturation_rad"),
            },
            _ => CouplingSpace::Task,
        },
    }
}

fn coupling_mode(table: &Node) -> CouplingMode {
    match table.text("mode") {
        "minimise_force_error" => CouplingMode::MinimiseForceError,
        "per_state" => CouplingMode::PerState(table.numbers("beta")),
        _ => CouplingMode::Comply,
    }
}
