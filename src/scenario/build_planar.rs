//! A filled tree to an experiment in a plane.

use super::build_learning;
use super::tree::Node;
use super::work::{PlanarPlan, PlanarRun};
use crate::planar::{HandSettings, ObstacleAvoidanceSettings};

/// The experiment that `[planar]` describes.
pub(super) fn planar(scenario: &Node) -> PlanarRun {
    let table = scenario.section("planar");
    PlanarRun {
        name: scenario.text("name").to_owned(),
        seed: scenario.count("seed"),
        plan: PlanarPlan::ObstacleAvoidance(ObstacleAvoidanceSettings {
            obstacle_half_width_m: table.number("obstacle_half_width_m"),
            obstacle_half_depth_m: table.number("obstacle_half_depth_m"),
            start_m: table.array("start_m"),
            goal_y_m: table.number("goal_y_m"),
            taught_goals_x_m: table.numbers("taught_goals_x_m"),
            new_goals_x_m: table.numbers("new_goals_x_m"),
            clearance_m: table.number("clearance_m"),
            pass_fraction: table.number("pass_fraction"),
            hand: hand(&table.section("hand")),
            learning: build_learning::learning(&scenario.section("learning")),
        }),
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
