//! Keys of what a run is judged by.

use super::key::Kind::{Choice, Flag, Name, Number, Reference, References, Tag, Texts, Vector};
use super::key::Length::Exactly;
use super::key::To::{Object, ObjectOfKind};
use super::key::{Key, Preset, Shape, Variant};
use super::measure::within;
use super::schema_planar::METHODS;

pub(super) const CRITERION: Shape = Shape {
    keys: &[
        Key::new("name", Name, "its name in reports"),
        Key::new("kind", Tag, "the question"),
        Key::new("expect", Choice(&["pass", "fail", "report"]), "the answer that is expected").or(Preset::Text("pass")),
    ],
    variants: &[
        Variant {
            kind: "object_in_container",
            keys: &[
                Key::new("object", Reference(Object), "the object"),
                Key::new("container", Reference(ObjectOfKind("basket")), "the basket"),
                Key::new("speed_max_m_per_s", Number(within("m/s", 0.0, 10.0)), "largest speed that counts as rest").or_number(0.02),
            ],
        },
        Variant { kind: "no_contact", keys: &[Key::new("objects", References(Object), "what must not be touched")] },
        Variant {
            kind: "door_open",
            keys: &[
                Key::new("object", Reference(ObjectOfKind("cabinet")), "the cabinet"),
                Key::new("min_rad", Number(within("rad", 0.0, 3.1)), "smallest opening at the end"),
            ],
        },
        Variant {
            kind: "arc_followed",
            keys: &[
                Key::new("object", Reference(ObjectOfKind("cabinet")), "the cabinet"),
                Key::new("of", Choice(&["tool", "reference"]), "the tool, or where the controller wants it").or(Preset::Text("tool")),
                Key::new("max_m", Number(within("m", 0.0, 1.0)), "largest rms distance from the arc of the handle in use"),
            ],
        },
        Variant {
            kind: "hook_kept",
            keys: &[
                Key::new("object", Reference(ObjectOfKind("cabinet")), "the cabinet"),
                Key::new(
                    "max_m",
                    Number(within("m", 0.0, 1.0)),
                    "largest horizontal distance of the tool from the axis of the handle in use",
                ),
            ],
        },
        Variant {
            kind: "tool_force",
            keys: &[
                Key::new(
                    "mean_over_s",
                    Number(within("s", 0.0, 1.0)),
                    "over which time the force is averaged, rounded up to whole logged steps; 0: every step of the engine",
                )
                .or_number(0.0),
                Key::new(
                    "max_n",
                    Number(within("N", 0.0, 1000.0)),
                    "largest force of the objects on fingers and tool: of a clamp, and of contacts, pressing and rubbing",
                ),
            ],
        },
        Variant {
            kind: "clearance",
            keys: &[
                Key::new("objects", References(Object), "what must be kept away from"),
                Key::new("links", Texts, "links of the robot, or objects in the gripper, whose distance counts; all without it").or_empty(),
                Key::new("min_m", Number(within("m", 0.0, 1.0)), "smallest distance"),
            ],
        },
        Variant {
            kind: "planar_clearance",
            keys: &[
                Key::new("method", Choice(&METHODS), "whose movements"),
                Key::new("settings", Choice(&["all", "taught", "new", "beyond"]), "in which settings").or(Preset::Text("all")),
                Key::new("min_m", Number(within("m", -100.0, 100.0)), "smallest distance to the obstacle"),
            ],
        },
        Variant {
            kind: "planar_collides",
            keys: &[
                Key::new("method", Choice(&METHODS), "whose movements"),
                Key::new("settings", Choice(&["all", "taught", "new", "beyond"]), "in which settings").or(Preset::Text("all")),
            ],
        },
        Variant {
            kind: "planar_sides_passed",
            keys: &[
                Key::new("method", Choice(&METHODS), "whose movements"),
                Key::new("settings", Choice(&["all", "taught", "new", "beyond"]), "in which settings").or(Preset::Text("all")),
                Key::new("side_told", Flag, "whether the settings are those in which the side is a parameter"),
                Key::new("min_m", Number(within("m", -100.0, 100.0)), "smallest distance with which each side must be passed"),
            ],
        },
        Variant { kind: "no_collision", keys: &[] },
        Variant {
            kind: "expected_force",
            keys: &[
                Key::new("axis", Choice(&["x", "y", "z"]), "along which axis of the world"),
                Key::new("from", Choice(&["start", "touch"]), "whether it counts from the start of the skill, or from the first touch on")
                    .or(Preset::Text("start")),
                Key::new("max_n", Number(within("N", 0.0, 500.0)), "largest rms difference of the measured from the expected force"),
            ],
        },
        Variant {
            kind: "object_at",
            keys: &[
                Key::new("object", Reference(Object), "the object"),
                Key::new("at", Reference(Object), "the object near which it must end; the world's origin without one").optional(),
                Key::new("offset_m", Vector(within("m", -3.0, 3.0), Exactly(3)), "the place, from there along the world's axes")
                    .or(Preset::Vector(&[0.0, 0.0, 0.0])),
                Key::new("max_m", Number(within("m", 0.0, 1.0)), "largest distance from that place"),
            ],
        },
        Variant { kind: "goal_reached", keys: &[Key::new("max_m", Number(within("m", 0.0, 1.0)), "largest distance to the goal")] },
        Variant { kind: "human_force", keys: &[Key::new("max_n", Number(within("N", 0.0, 500.0)), "largest force of the person")] },
        Variant {
            kind: "compliance_window",
            keys: &[Key::new("stiff_at", References(ObjectOfKind("u_block")), "the objects at which the arm must be stiff")],
        },
        Variant {
            kind: "gripper_over_object",
            keys: &[
                Key::new("object", Reference(Object), "the object"),
                Key::new("max_m", Number(within("m", 0.0, 1.0)), "largest horizontal distance when the gripper closes"),
            ],
        },
        Variant {
            kind: "reference_unmoved",
            keys: &[Key::new("max_m", Number(within("m", 0.0, 1.0)), "largest displacement of the reference while the person pushes")],
        },
        Variant {
            kind: "gripper_unmoved",
            keys: &[Key::new("max_m", Number(within("m", 0.0, 1.0)), "largest displacement of the gripper while the person pushes")],
        },
    ],
};
