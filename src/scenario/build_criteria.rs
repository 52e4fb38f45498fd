//! A filled tree to what a run must show.

use super::tree::Node;
use crate::check::{AllowedContact, CountsFrom, CriterionKind, CriterionSpec, Expectation, Followed, PlanarSettings};
use crate::planar::Method;
use crate::simulation::NamedPart;

/// What a scenario asks of the run.
pub(super) fn criteria(scenario: &Node) -> Vec<CriterionSpec> {
    scenario.tables("criterion").iter().filter_map(criterion).collect()
}

/// The contacts that a scenario allows.
pub(super) fn allowed_contacts(scenario: &Node) -> Vec<AllowedContact> {
    let text = |table: &Node, key: &str| table.text(key).to_owned();
    let contact = |table: &Node| AllowedContact { name: text(table, "name"), a: text(table, "a"), b: text(table, "b") };
    scenario.tables("allowed_contact").iter().map(contact).collect()
}

/// Links and objects that criteria about distances and allowed contacts name.
pub(super) fn named_parts(scenario: &Node) -> Vec<NamedPart> {
    let part = |list: &str, table: &Node, key: &str, node: &Node| {
        Some(NamedPart { key: format!("{list}.{}.{key}", table.text("name")), name: node.as_text()?.to_owned() })
    };
    let distances = scenario.tables("criterion").iter().filter(|table| table.text("kind") == "clearance");
    let links = distances.flat_map(|table| {
        let links = table.get("links").map_or(&[][..], Node::items).iter().enumerate();
        links.filter_map(move |(index, link)| part("criterion", table, &format!("links.{index}"), link))
    });
    let contacts = scenario.tables("allowed_contact").iter().flat_map(|table| ["a", "b"].map(|key| (table, key)));
    let ends = contacts.filter_map(|(table, key)| part("allowed_contact", table, key, table.get(key)?));
    links.chain(ends).collect()
}

fn method(table: &Node) -> Option<Method> {
    let methods = [Method::Cpdmp, Method::CpdmpProduct, Method::CpdmpChain, Method::LwrDmp, Method::TpGmm];
    methods.into_iter().find(|method| method.key() == table.text("method"))
}

fn settings(table: &Node) -> PlanarSettings {
    match table.text("settings") {
        "taught" => PlanarSettings::Taught,
        "new" => PlanarSettings::New,
        "beyond" => PlanarSettings::Beyond,
        _ => PlanarSettings::All,
    }
}

/// The place of an axis in a vector.
fn axis(name: &str) -> Option<usize> {
    ["x", "y", "z"].iter().position(|axis| *axis == name)
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
        "door_open" => CriterionKind::DoorOpen { object: object(), min_rad: table.number("min_rad") },
        "arc_followed" => {
            let of = if table.text("of") == "reference" { Followed::Reference } else { Followed::Tool };
            CriterionKind::ArcFollowed { object: object(), of, max_m: max_m() }
        }
        "hook_kept" => CriterionKind::HookKept { object: object(), max_m: max_m() },
        "tool_force" => CriterionKind::ToolForce { mean_over_s: table.number("mean_over_s"), max_n: table.number("max_n") },
        "clearance" => {
            CriterionKind::Clearance { objects: table.texts("objects"), links: table.texts("links"), min_m: table.number("min_m") }
        }
        "planar_clearance" => {
            CriterionKind::PlanarClearance { method: method(table)?, settings: settings(table), min_m: table.number("min_m") }
        }
        "planar_sides_passed" => CriterionKind::PlanarSidesPassed {
            method: method(table)?,
            settings: settings(table),
            side_told: table.flag("side_told"),
            min_m: table.number("min_m"),
        },
        "planar_collides" => CriterionKind::PlanarCollides { method: method(table)?, settings: settings(table) },
        "no_collision" => CriterionKind::NoCollision,
        "expected_force" => {
            let from = if table.text("from") == "touch" { CountsFrom::Touch } else { CountsFrom::Start };
            CriterionKind::ExpectedForce { axis: axis(table.text("axis"))?, from, max_n: table.number("max_n") }
        }
        "object_at" => {
            CriterionKind::ObjectAt { object: object(), at: table.optional_text("at"), offset_m: table.array("offset_m"), max_m: max_m() }
        }
        "goal_reached" => CriterionKind::GoalReached { max_m: max_m() },
        "human_force" => CriterionKind::HumanForce { max_n: table.number("max_n") },
        "compliance_window" => CriterionKind::ComplianceWindow { stiff_at: table.texts("stiff_at") },
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
