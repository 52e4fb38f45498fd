//! A filled tree to an experiment in a plane.

use super::build_learning;
use super::tree::Node;
use super::work::{PlanarPlan, PlanarRun};
use crate::learning::LearningSettings;
use crate::learning::phmm::{PhmmSettings, Topology};
use crate::learning::tpgmm::TpGmmSettings;
use crate::planar::{HandSettings, ObstacleAvoidanceSettings, TwoSidedObstacleSettings};

/// The experiment that `[planar]` describes.
pub(super) fn planar(scenario: &Node) -> PlanarRun {
    let table = scenario.section("planar");
    let learning = build_learning::learning(&scenario.section("learning"));
    PlanarRun {
        name: scenario.text("name").to_owned(),
        seed: scenario.count("seed"),
        plan: match table.text("kind") {
            "two_sided_obstacle" => PlanarPlan::TwoSidedObstacle(Box::new(two_sided(&table, learning))),
            _ => PlanarPlan::ObstacleAvoidance(Box::new(obstacle_avoidance(&table, learning))),
        },
    }
}

fn obstacle_avoidance(table: &Node, learning: LearningSettings) -> ObstacleAvoidanceSettings {
    ObstacleAvoidanceSettings {
        obstacle_half_width_m: table.number("obstacle_half_width_m"),
        obstacle_half_depth_m: table.number("obstacle_half_depth_m"),
        start_m: table.array("start_m"),
        goal_y_m: table.number("goal_y_m"),
        taught_goals_x_m: table.numbers("taught_goals_x_m"),
        new_goals_x_m: table.numbers("new_goals_x_m"),
        clearance_m: table.number("clearance_m"),
        pass_fraction: table.number("pass_fraction"),
        hand: hand(&table.section("hand")),
        learning,
    }
}

fn two_sided(table: &Node, learning: LearningSettings) -> TwoSidedObstacleSettings {
    let without_side = PhmmSettings {
        states: table.size("states_without_side"),
        kmeans_starts: table.count("kmeans_starts_without_side"),
        topology: Topology::Ergodic,
        ..learning.motion.clone()
    };
    TwoSidedObstacleSettings {
        taught_half_widths_m: table.numbers("taught_half_widths_m"),
        new_half_widths_m: table.numbers("new_half_widths_m"),
        obstacle_half_depth_m: table.number("obstacle_half_depth_m"),
        start_m: table.array("start_m"),
        goal_m: table.array("goal_m"),
        clearance_m: table.number("clearance_m"),
        pass_fraction: table.number("pass_fraction"),
        hand: hand(&table.section("hand")),
        learning_without_side: LearningSettings { motion: without_side, ..learning.clone() },
        learning,
        tpgmm: TpGmmSettings { components: table.size("tp_gmm_components"), ..TpGmmSettings::default() },
    }
}

fn hand(table: &Node) -> HandSettings {
    HandSettings {
        repetitions: table.size("repetitions"),
        duration_s: table.number("duration_s"),
        rate_hz: table.number("rate_hz"),
        duration_spread: table.number("duration_spread"),
        timing_spread: table.number("timing_spread"),
        shape_spread_m: table.number("shape_spread_m"),
        noise_m: table.number("noise_m"),
    }
}
