//! A filled tree to the settings of the rooms below.

use super::load::RecordingPlan;
use super::tree::Node;
use crate::check::{CriterionKind, CriterionSpec, Expectation};
use crate::control::ImpedanceSettings;
use crate::simulation::{DemonstrationSource, ExecutionPlan, Experiment, Help, RobotSettings, TeachingPlan, Waypoint};
use crate::robot::EffortModel;
use crate::world::{HumanSettings, Object, ObjectKind, Parameters, PhysicsSettings, SensorSettings};

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
        objects: scenario.tables("object").iter().filter_map(object).collect(),
        human: hand(&human),
        demonstrations: match scenario.optional_path("demonstrations") {
            Some(path) => DemonstrationSource::Dataset(path),
            None => DemonstrationSource::Teach(teaching(&scenario.section("teaching"))),
        },
        theta_m: learning.texts("theta_m"),
        theta_f: learning.texts("theta_f"),
        learning: super::build_learning::learning(&learning),
        execution: execution(&scenario.section("execution"), &scenario.section("coupling"), &human.section("help")),
        log_rate_hz: simulation.number("log_rate_hz"),
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

fn object(table: &Node) -> Option<Object> {
    let kind = match table.text("kind") {
        "table" => ObjectKind::Table {
            size_m: table.vector2("size_m"),
            top_height_m: table.number("top_height_m"),
            friction: table.number("friction"),
        },
        "u_block" => ObjectKind::UBlock {
            base_height_m: table.quantity("base_height_m"),
            aperture_m: table.number("aperture_m"),
            post_height_m: table.number("post_height_m"),
            post_width_m: table.number("post_width_m"),
            thickness_m: table.number("thickness_m"),
        },
        "ball" => ObjectKind::Ball {
            radius_m: table.number("radius_m"),
            mass_kg: table.number("mass_kg"),
            friction: table.number("friction"),
            rolling_damping_per_s: table.number("rolling_damping_per_s"),
        },
        "box" => ObjectKind::Box {
            size_m: table.array::<3>("size_m").into(),
            mass_kg: table.number("mass_kg"),
            friction: table.number("friction"),
        },
        "basket" => ObjectKind::Basket {
            inner_size_m: table.vector2("inner_size_m"),
            wall_height_m: table.number("wall_height_m"),
            wall_thickness_m: table.number("wall_thickness_m"),
        },
        _ => return None,
    };
    let center_m = table.vector2("center_m");
    Some(Object { name: table.text("name").to_owned(), center_m, lateral_offset_m: table.quantity("lateral_offset_m"), kind })
}

fn teaching(table: &Node) -> TeachingPlan {
    let grid = table.section("grid");
    TeachingPlan {
        grid: grid.entries().iter().map(|entry| (entry.key.clone(), entry.node.as_numbers())).collect(),
        tool_yaw_rad: table.number("tool_yaw_rad"),
        zero_gravity_damping_nms_per_rad: table.number("zero_gravity_damping_nms_per_rad"),
        duration_s: table.number("duration_s"),
        record_rate_hz: table.number("record_rate_hz"),
        position_spread_m: table.number("position_spread_m"),
        timing_spread: table.number("timing_spread"),
        waypoints: table.tables("waypoint").iter().map(waypoint).collect(),
    }
}

fn waypoint(table: &Node) -> Waypoint {
    Waypoint {
        time_s: table.number("time_s"),
        at: table.optional_text("at"),
        offset_m: table.array("offset_m"),
        gripper: table.optional_number("gripper"),
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
        coupling: super::build_learning::coupling(coupling),
        duration_s: table.optional_number("duration_s"),
        settle_s: table.number("settle_s"),
        help,
    }
}

/// What a scenario asks of the run.
pub(super) fn criteria(scenario: &Node) -> Vec<CriterionSpec> {
    scenario.tables("criterion").iter().filter_map(criterion).collect()
}

fn criterion(table: &Node) -> Option<CriterionSpec> {
    let object = || table.text("object").to_owned();
    let max_m = || table.number("max_m");
    let kind = match table.text("kind") {
        "object_in_container" => CriterionKind::ObjectInContainer {
            object: object(),
            container: table.text("container").to_owned(),
            speed_max_m_per_s: table.number("speed_max_m_per_s"),
        },
        "no_contact" => CriterionKind::NoContact { objects: table.texts("objects") },
        "clearance" => CriterionKind::Clearance { objects: table.texts("objects"), min_m: table.number("min_m") },
        "goal_reached" => CriterionKind::GoalReached { max_m: max_m() },
        "human_force" => CriterionKind::HumanForce { max_n: table.number("max_n") },
        "compliance_window" => CriterionKind::ComplianceWindow { ends_before: table.text("ends_before").to_owned() },
        "gripper_over_object" => CriterionKind::GripperOverObject { object: object(), max_m: max_m() },
        "reference_unmoved" => CriterionKind::ReferenceUnmoved { max_m: max_m() },
        "gripper_unmoved" => CriterionKind::GripperUnmoved { max_m: max_m() },
        _ => return None,
    };
    let expect = match table.text("expect") {
        "fail" => Expectation::Fail,
        "report" => Expectation::Report,
        _ => Expectation::Pass,
    };
    Some(CriterionSpec { name: table.text("name").to_owned(), kind, expect })
}

/// What is written to the run folder.
pub(super) fn recording(scenario: &Node) -> RecordingPlan {
    let table = scenario.section("recording");
    RecordingPlan { rrd: table.flag("rrd"), steps: table.flag("steps"), demonstrations: table.flag("demonstrations") }
}
