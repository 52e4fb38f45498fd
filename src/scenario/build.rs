//! A filled tree to the settings of the rooms below.

use super::load::RecordingPlan;
use super::tree::Node;
use super::{build_criteria, build_learning, build_scene};
use crate::control::{Feedback, ImpedanceSettings};
use crate::learning::PhaseStopping;
use crate::learning::dmp::Integrator;
use crate::robot::EffortModel;
use crate::simulation::{DemonstrationSource, ExecutionPlan, Experiment, Help, MotionSpace, RobotSettings, TraceSettings};
use crate::world::{HumanSettings, Parameters, PhysicsSettings, SensorSettings};

/// The experiment that a scenario describes.
pub(super) fn experiment(scenario: &Node) -> Experiment {
    let simulation = scenario.section("simulation");
    let learning = scenario.section("learning");
    let human = scenario.section("human");
    let parameters = scenario.section("parameters");
    Experiment {
        name: scenario.text("name").to_owned(),
        seed: scenario.count("seed"),
        parameters: Parameters(
            parameters.entries().iter().filter_map(|entry| Some((entry.key.clone(), entry.node.as_number()?))).collect(),
        ),
        robot: robot(&scenario.section("robot")),
        physics: PhysicsSettings {
            step_s: simulation.number("step_s"),
            solver_iterations: simulation.size("solver_iterations"),
            gravity_m_per_s2: simulation.array("gravity_m_per_s2"),
        },
        objects: scenario.tables("object").iter().filter_map(build_scene::object).collect(),
        human: hand(&human),
        demonstrations: match scenario.optional_path("demonstrations") {
            Some(path) => DemonstrationSource::Dataset(path),
            None => DemonstrationSource::Teach(build_scene::teaching(&scenario.section("teaching"))),
        },
        theta_m: learning.texts("theta_m"),
        theta_f: learning.texts("theta_f"),
        space: if learning.text("space") == "joint" { MotionSpace::Joint } else { MotionSpace::Task },
        learning: build_learning::learning(&learning),
        execution: execution(&scenario.section("execution"), &scenario.section("coupling"), &human.section("help")),
        log_rate_hz: simulation.number("log_rate_hz"),
        trace: TraceSettings {
            every_steps: scenario.section("recording").count("hash_every_steps"),
            snapshot_every_steps: scenario.section("recording").count("snapshot_every_steps"),
            detail: None,
        },
        named_parts: build_criteria::named_parts(scenario),
    }
}

fn robot(table: &Node) -> RobotSettings {
    let impedance = table.section("impedance");
    let sensor = table.section("sensor");
    RobotSettings {
        urdf: table.optional_path("urdf").filter(|path| !path.starts_with("builtin:baxter")),
        package_directories: table.texts("package_directories").into_iter().map(Into::into).collect(),
        tool_link: table.text("tool_link").to_owned(),
        grasp_link: table.text("grasp_link").to_owned(),
        idle_tool_link: table.text("idle_tool_link").to_owned(),
        rest_posture_rad: table.numbers("rest_posture_rad"),
        idle_posture_rad: table.numbers("idle_posture_rad"),
        finger_friction: table.number("finger_friction"),
        impedance: ImpedanceSettings {
            stiffness_nm_per_rad: impedance.numbers("stiffness_nm_per_rad"),
            damping_nms_per_rad: impedance.numbers("damping_nms_per_rad"),
        },
        sensor: SensorSettings {
            effort_noise_nm: sensor.number("effort_noise_nm"),
            effort_bias_nm: sensor.number("effort_bias_nm"),
            dry_friction_nm: sensor.number("dry_friction_nm"),
            model: if sensor.text("dynamics_model") == "full" { EffortModel::FullDynamics } else { EffortModel::GravityOnly },
            filter_cutoff_hz: sensor.number("filter_cutoff_hz"),
        },
    }
}

fn hand(table: &Node) -> HumanSettings {
    HumanSettings {
        stiffness_n_per_m: table.number("stiffness_n_per_m"),
        damping_ns_per_m: table.number("damping_ns_per_m"),
        rotational_stiffness_nm_per_rad: table.number("rotational_stiffness_nm_per_rad"),
        rotational_damping_nms_per_rad: table.number("rotational_damping_nms_per_rad"),
        teaching_force_max_n: table.number("teaching_force_max_n"),
        moment_max_nm: table.number("moment_max_nm"),
        visual_gain_per_s: table.number("visual_gain_per_s"),
        visual_correction_max_m: table.number("visual_correction_max_m"),
        helping_stiffness_n_per_m: table.number("helping_stiffness_n_per_m"),
        helping_rate_n_per_ms: table.number("helping_rate_n_per_ms"),
        helping_damping_ns_per_m: table.number("helping_damping_ns_per_m"),
        aim_spread_m: table.number("aim_spread_m"),
        strength_spread: table.number("strength_spread"),
    }
}

fn execution(table: &Node, coupling: &Node, help: &Node) -> ExecutionPlan {
    let help = match help.text("kind") {
        "guide" => Help::Guide {
            object: help.text("object").to_owned(),
            reach_m: help.number("reach_m"),
            force_max_n: help.number("force_max_n"),
            weight_xy: help.array("weight_xy"),
        },
        "push" => Help::Push { force_n: help.array("force_n"), windows_s: help.windows("windows_s") },
        _ => Help::None,
    };
    ExecutionPlan {
        coupling: build_learning::coupling(coupling),
        integrator: if table.text("integrator") == "rk4" { Integrator::RungeKutta4 } else { Integrator::ExactHold },
        feedback: match table.text("feedback") {
            "measured" => Feedback::Measured { time_constant_s: table.number("feedback_time_s") },
            _ => Feedback::None,
        },
        phase_stopping: table
            .flag("phase_stopping")
            .then(|| PhaseStopping { gain: table.number("phase_stopping_gain"), slowest: table.number("phase_stopping_slowest") }),
        duration_s: table.optional_number("duration_s"),
        settle_s: table.number("settle_s"),
        help,
    }
}

/// What is written to the run folder.
pub(super) fn recording(scenario: &Node) -> RecordingPlan {
    let table = scenario.section("recording");
    RecordingPlan {
        rrd: table.flag("rrd"),
        steps: table.flag("steps"),
        demonstrations: table.flag("demonstrations"),
        hash_every_steps: table.count("hash_every_steps"),
    }
}
