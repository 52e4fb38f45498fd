//! Keys of learning, compliance and the coupling.

use super::key::Kind::{Choice, Count, CountOrWord, Flag, Number, NumberOrWord, References, Section, Vector};
use super::key::Length::AtLeast;
use super::key::To::Parameter;
use super::key::{Key, Preset, Shape};
use super::measure::{above, within};

pub(super) const LEARNING: Shape = Shape::plain(&[
    Key::new("theta_m", References(Parameter), "parameters that the motion model is told").or_empty(),
    Key::new("theta_f", References(Parameter), "parameters that the force model is told; none for a fixed one").or_empty(),
    Key::new("space", Choice(&["task", "joint"]), "what the motion model learns: the place of the tool (m), or the arm's joints (rad)")
        .or(Preset::Text("task")),
    Key::new("shaping", Choice(&["phmm", "lwr"]), "what stands for the forcing term: the paper's model, or its baseline")
        .or(Preset::Text("phmm")),
    Key::new("stiffness", Number(within("", 1.0, 1e7)), "stiffness K of the movement primitive (1)").or_number(5000.0),
    Key::new("alpha", Number(within("", 0.1, 20.0)), "decay of the phase (3)").or_number(2.0 * std::f64::consts::LN_10),
    Key::new("phase_input", Choice(&["time_fraction", "phase"]), "what the models see of the phase").or(Preset::Text("time_fraction")),
    Key::new("rate_hz", Number(within("Hz", 0.1, 1000.0)), "samples per second that are learned from").or_number(25.0),
    Key::new("smoothing_window_s", Number(within("s", 0.001, 60.0)), "window that differentiates the movement").or_number(0.5),
    Key::new("smoothing_degree", Count(2, 6), "degree of the polynomials in that window").or(Preset::Count(4)),
    Key::new("gate_start", Number(within("", 0.5, 0.999)), "fraction of the duration from which the forcing fades out").or_number(0.94),
    Key::new("lwr_basis", Count(2, 1000), "basis functions of the baseline").or(Preset::Count(100)),
    Key::new(
        "lwr_ends",
        Choice(&["mean", "regression"]),
        "start and goal of the baseline: the mean of the demonstrations, or told to it, by a regression on theta_m",
    )
    .or(Preset::Text("mean")),
    Key::new("orientation_basis", Count(2, 500), "basis functions of the orientation").or(Preset::Count(40)),
    Key::new("align", Flag, "whether demonstrations are brought to one timing first, by one warp each for all columns")
        .or(Preset::Flag(false)),
    Key::new("automatic_ridge", Flag, "the same as motion.ridge = \"auto\"").or(Preset::Flag(false)),
    Key::new(
        "states_criterion",
        Choice(&["given", "bic", "cross_validation"]),
        "what decides about states = \"auto\": `given` leaves it to cross-validation; another word makes motion.states \"auto\"",
    )
    .or(Preset::Text("given")),
    Key::new("states_min", Count(1, 200), "fewest states that are tried for \"auto\"").or(Preset::Count(4)),
    Key::new("states_max", Count(1, 200), "most states that are tried for \"auto\"").or(Preset::Count(24)),
    Key::new("motion", Section(MOTION_MODEL), "the hidden Markov model of the motion").or_empty(),
    Key::new("force", Section(FORCE_MODEL), "the hidden Markov model of the force").or_empty(),
    Key::new("compliance", Section(COMPLIANCE), "where the skill complies (20)").or_empty(),
]);

const MOTION_MODEL: Shape = Shape::plain(&hidden_markov_model(16));

const FORCE_MODEL: Shape = Shape::plain(&hidden_markov_model(10));

/// The word for what the demonstrations choose.
pub(super) const AUTO: &str = "auto";

const fn hidden_markov_model(states: i64) -> [Key; 12] {
    [
        Key::new("states", CountOrWord(1, 200, AUTO), "number of states; \"auto\" tries states_min to states_max")
            .or(Preset::Count(states)),
        Key::new("topology", Choice(&["left_to_right", "ergodic"]), "which transitions exist").or(Preset::Text("left_to_right")),
        Key::new("weights_on_phase", Flag, "whether parameters also move the phase at which a state sits").or(Preset::Flag(false)),
        Key::new("features", Choice(&["linear", "quadratic", "rbf"]), "functions of the parameters that the means are linear in")
            .or(Preset::Text("linear")),
        Key::new("rbf_centres", Count(1, 200), "most bumps of the rbf features").or(Preset::Count(9)),
        Key::new("rbf_width", Number(within("", 0.1, 100.0)), "width of a bump, as a multiple of the distance between neighbours")
            .or_number(1.5),
        Key::new(
            "covariance",
            Choice(&["estimated", "fixed"]),
            "whether covariances are learned with the parameters, or kept from the model without",
        )
        .or(Preset::Text("estimated")),
        Key::new(
            "ridge",
            NumberOrWord(within("", 0.0, 1e6), AUTO),
            "strength of the prior W = 0, as a number of demonstrations; \"auto\" leaves demonstrations out to choose it",
        )
        .or_number(0.1),
        Key::new("covariance_floor", Number(within("", 0.0, 0.1)), "smallest eigenvalue of a covariance, columns scaled to 1; 0 for none")
            .or_number(1e-5),
        Key::new("kmeans_starts", Count(0, 1000), "starts by k-means, besides the two by time slices").or(Preset::Count(4)),
        Key::new("max_iterations", Count(1, 100_000), "most iterations of each stage").or(Preset::Count(200)),
        Key::new("tolerance", Number(within("", 0.0, 1.0)), "relative rise of the objective below which iterations stop").or_number(1e-6),
    ]
}

const COMPLIANCE: Shape = Shape::plain(&[
    Key::new("statistic", Choice(&["between_demonstration", "conditional", "literal"]), "which covariance of a state decides")
        .or(Preset::Text("between_demonstration")),
    Key::new(
        "threshold_m2",
        NumberOrWord(above("m²", 0.0, 1e6), "automatic"),
        "a state complies when it exceeds this; in joint space rad²",
    )
    .or_number(1e-4),
]);

pub(super) const COUPLING: Shape = Shape::plain(&[
    Key::new("enabled", Flag, "whether force error moves the skill at all (16)").or(Preset::Flag(false)),
    Key::new("compliance_m_per_n", Vector(within("m/N", 0.0, 10.0), AtLeast(1)), "displacement per force error: per axis, or one for all")
        .or(Preset::Vector(&[0.01])),
    Key::new("saturation_m", Number(within("m", 0.0, 10.0)), "largest displacement, per axis").or_number(0.1),
    Key::new(
        "space",
        Choice(&["task", "joint"]),
        "J of (17): the identity, so that a force moves the tool along itself, or the arm's Jacobian, for a motion of the joints",
    )
    .or(Preset::Text("task")),
    Key::new(
        "compliance_rad_per_nm",
        Vector(within("rad/(N m)", 0.0, 10.0), AtLeast(1)),
        "turn per torque J^T (F - F_des) at the joints, in joint space: per joint, or one for all",
    )
    .or(Preset::Vector(&[0.01])),
    Key::new("saturation_rad", Number(within("rad", 0.0, 10.0)), "largest displacement per joint, in joint space").or_number(0.3),
    Key::new("convention", Choice(&["on_robot", "on_world"]), "whose force the wrench columns hold").or(Preset::Text("on_robot")),
    Key::new("switching", Choice(&["smooth", "hard"]), "how the coupling goes on and off at the edges of a window")
        .or(Preset::Text("smooth")),
    Key::new("switching_ramp", Number(within("", 0.01, 100.0)), "length of the smooth edge, in units of 1/omega").or_number(1.0),
    Key::new(
        "mode",
        Choice(&["comply", "minimise_force_error", "per_state"]),
        "yield in the states that comply (19), meet the expected force everywhere (18), or as `beta` says",
    )
    .or(Preset::Text("comply")),
    Key::new("beta", Vector(within("", -1.0, 1.0), AtLeast(0)), "beta of each state, -1, 0 or 1, in the mode `per_state`")
        .or(Preset::Vector(&[])),
]);
