//! A filled tree to the scene and to what is taught in it.

use super::tree::Node;
use crate::simulation::{TeachingPlan, Waypoint};
use crate::world::{Cabinet, Grip, Object, ObjectKind, Solid};

/// An object of the scene; none if its kind is faulty.
pub(super) fn object(table: &Node) -> Option<Object> {
    let kind = match table.text("kind") {
        "table" => ObjectKind::Table {
            size_m: table.vector2("size_m"),
            top_height_m: table.number("top_height_m"),
            friction: table.quantity("friction"),
        },
        "u_block" => ObjectKind::UBlock {
            base_height_m: table.quantity("base_height_m"),
            aperture_m: table.number("aperture_m"),
            post_height_m: table.number("post_height_m"),
            post_width_m: table.number("post_width_m"),
            thickness_m: table.number("thickness_m"),
            friction: table.quantity("friction"),
        },
        "ball" => ObjectKind::Ball {
            radius_m: table.number("radius_m"),
            mass_kg: table.quantity("mass_kg"),
            friction: table.quantity("friction"),
            rolling_damping_per_s: table.number("rolling_damping_per_s"),
        },
        "box" => ObjectKind::Box { size_m: table.array::<3>("size_m").into(), body: solid(table) },
        "cylinder" => ObjectKind::Cylinder { radius_m: table.number("radius_m"), height_m: table.number("height_m"), body: solid(table) },
        "spring_plate" => ObjectKind::SpringPlate {
            size_m: table.array::<3>("size_m").into(),
            travel_m: table.number("travel_m"),
            stiffness_n_per_m: table.quantity("stiffness_n_per_m"),
            damping_ns_per_m: table.number("damping_ns_per_m"),
            mass_kg: table.quantity("mass_kg"),
            friction: table.quantity("friction"),
        },
        "basket" => ObjectKind::Basket {
            inner_size_m: table.vector2("inner_size_m"),
            wall_height_m: table.number("wall_height_m"),
            wall_thickness_m: table.number("wall_thickness_m"),
            friction: table.quantity("friction"),
        },
        "cabinet" => ObjectKind::Cabinet(cabinet(table)),
        _ => return None,
    };
    Some(Object {
        name: table.text("name").to_owned(),
        center_m: table.vector2("center_m"),
        lateral_offset_m: table.quantity("lateral_offset_m"),
        offset_y_m: table.quantity("offset_y_m"),
        raised_m: table.quantity("raised_m"),
        yaw_rad: table.quantity("yaw_rad"),
        kind,
    })
}

fn solid(table: &Node) -> Solid {
    Solid { mass_kg: table.quantity("mass_kg"), friction: table.quantity("friction"), fixed: table.flag("fixed") }
}

fn cabinet(table: &Node) -> Cabinet {
    Cabinet {
        door_size_m: table.vector2("door_size_m"),
        bottom_height_m: table.number("bottom_height_m"),
        depth_m: table.number("depth_m"),
        mass_kg: table.quantity("mass_kg"),
        friction_nm: table.quantity("friction_nm"),
        damping_nms_per_rad: table.number("damping_nms_per_rad"),
        seal_nm_per_rad: table.number("seal_nm_per_rad"),
        seal_travel_rad: table.number("seal_travel_rad"),
        opening_max_rad: table.number("opening_max_rad"),
        handles: table.size("handles"),
        first_handle_m: table.number("first_handle_m"),
        handle_spacing_m: table.number("handle_spacing_m"),
        handle_lateral_m: table.quantity("handle_lateral_m"),
        handle_length_m: table.number("handle_length_m"),
        handle_radius_m: table.number("handle_radius_m"),
        handle_standoff_m: table.number("handle_standoff_m"),
        grip: if table.text("grip") == "contact" { Grip::Contact } else { Grip::Clamp },
    }
}

/// How the virtual human teaches.
pub(super) fn teaching(table: &Node) -> TeachingPlan {
    let grid = table.section("grid");
    TeachingPlan {
        grid: grid.entries().iter().map(|entry| (entry.key.clone(), entry.node.as_numbers())).collect(),
        repetitions: table.size("repetitions"),
        tool_yaw_rad: table.number("tool_yaw_rad"),
        tool_pitch_rad: table.number("tool_pitch_rad"),
        tool_roll_rad: table.number("tool_roll_rad"),
        turns_with_door: table.number("turns_with_door"),
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
        opening_rad: table.optional_number("opening_rad"),
        gripper: table.optional_number("gripper"),
    }
}
