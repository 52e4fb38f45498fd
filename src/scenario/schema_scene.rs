//! Keys of what stands in the scene.

use super::key::Kind::{Choice, Count, Flag, Name, Number, Quantity, Tag, Text, Vector};
use super::key::Length::Exactly;
use super::key::{Key, Preset, Shape, Variant};
use super::measure::within;

pub(super) const OBJECT: Shape = Shape {
    keys: &[
        Key::new("name", Name, "its name in reports, way-points and criteria"),
        Key::new("kind", Tag, "what it is"),
        Key::new(
            "center_m",
            Vector(within("m", -3.0, 3.0), Exactly(2)),
            "centre in the horizontal plane (x forward, y left of the robot); of a cabinet, its hinge",
        ),
        Key::new("lateral_offset_m", Quantity(within("m", -1.0, 1.0)), "added to the centre along x").or_number(0.0),
        Key::new("offset_y_m", Quantity(within("m", -1.0, 1.0)), "added to the centre along y").or_number(0.0),
        Key::new("raised_m", Quantity(within("m", -1.0, 1.0)), "added to the height at which it stands").or_number(0.0),
        Key::new("yaw_rad", Quantity(within("rad", -7.0, 7.0)), "turn about the vertical through its centre").or_number(0.0),
    ],
    variants: &[
        Variant {
            kind: "table",
            keys: &[
                Key::new("size_m", Vector(within("m", 0.01, 5.0), Exactly(2)), "extent along x and y"),
                Key::new("top_height_m", Number(within("m", -2.0, 2.0)), "height of its top above the robot's base frame"),
                Key::new("friction", Quantity(within("", 0.0, 5.0)), "coefficient of friction").or_number(0.6),
            ],
        },
        Variant {
            kind: "u_block",
            keys: &[
                Key::new("base_height_m", Quantity(within("m", 0.005, 1.0)), "height of the base above the table"),
                Key::new("aperture_m", Number(within("m", 0.01, 2.0)), "free width between the posts, along x"),
                Key::new("post_height_m", Number(within("m", 0.005, 1.0)), "height of the posts above the base"),
                Key::new("post_width_m", Number(within("m", 0.001, 1.0)), "width of each post, along x").or_number(0.03),
                Key::new("thickness_m", Number(within("m", 0.0001, 1.0)), "extent along y").or_number(0.05),
                Key::new("friction", Quantity(within("", 0.0, 5.0)), "coefficient of friction").or_number(0.5),
            ],
        },
        Variant {
            kind: "ball",
            keys: &[
                Key::new("radius_m", Number(within("m", 0.001, 0.5)), "radius"),
                Key::new("mass_kg", Quantity(within("kg", 0.001, 50.0)), "mass"),
                Key::new("friction", Quantity(within("", 0.0, 5.0)), "coefficient of friction").or_number(0.8),
                Key::new("rolling_damping_per_s", Number(within("1/s", 0.0, 1000.0)), "rolling resistance, as angular damping")
                    .or_number(5.0),
            ],
        },
        Variant {
            kind: "box",
            keys: &[
                Key::new("size_m", Vector(within("m", 0.001, 2.0), Exactly(3)), "extent along x, y, z"),
                Key::new("mass_kg", Quantity(within("kg", 0.001, 50.0)), "mass").or_number(1.0),
                Key::new("friction", Quantity(within("", 0.0, 5.0)), "coefficient of friction").or_number(0.6),
                Key::new("fixed", Flag, "whether it is fixed to the world instead of free to move").or(Preset::Flag(false)),
            ],
        },
        Variant {
            kind: "cylinder",
            keys: &[
                Key::new("radius_m", Number(within("m", 0.001, 1.0)), "radius"),
                Key::new("height_m", Number(within("m", 0.001, 2.0)), "height: it stands upright"),
                Key::new("mass_kg", Quantity(within("kg", 0.001, 50.0)), "mass").or_number(0.5),
                Key::new("friction", Quantity(within("", 0.0, 5.0)), "coefficient of friction").or_number(0.6),
                Key::new("fixed", Flag, "whether it is fixed to the world instead of free to move").or(Preset::Flag(false)),
            ],
        },
        Variant {
            kind: "spring_plate",
            keys: &[
                Key::new("size_m", Vector(within("m", 0.001, 2.0), Exactly(3)), "extent of the plate along x, y, z"),
                Key::new("travel_m", Number(within("m", 0.001, 0.5)), "how far it can yield downward").or_number(0.03),
                Key::new("stiffness_n_per_m", Quantity(within("N/m", 10.0, 1e5)), "stiffness of the spring under it").or_number(1000.0),
                Key::new("damping_ns_per_m", Number(within("N s/m", 0.0, 1e4)), "damping of the spring").or_number(20.0),
                Key::new("mass_kg", Quantity(within("kg", 0.001, 50.0)), "mass of the plate, which the spring carries").or_number(0.2),
                Key::new("friction", Quantity(within("", 0.0, 5.0)), "coefficient of friction").or_number(0.3),
            ],
        },
        Variant {
            kind: "basket",
            keys: &[
                Key::new("inner_size_m", Vector(within("m", 0.01, 2.0), Exactly(2)), "inner extent along x and y"),
                Key::new("wall_height_m", Number(within("m", 0.001, 1.0)), "height of its walls"),
                Key::new("wall_thickness_m", Number(within("m", 0.001, 0.2)), "thickness of walls and floor").or_number(0.005),
                Key::new("friction", Quantity(within("", 0.0, 5.0)), "coefficient of friction").or_number(0.5),
            ],
        },
        Variant { kind: "cabinet", keys: CABINET },
    ],
};

const CABINET: &[Key] = &[
    Key::new("door_size_m", Vector(within("m", 0.05, 2.0), Exactly(2)), "width (from the hinge, along -y) and height of the door"),
    Key::new("bottom_height_m", Number(within("m", -2.0, 2.0)), "height of the door's lower edge above what the cabinet stands on"),
    Key::new("depth_m", Number(within("m", 0.05, 2.0)), "depth behind the door").or_number(0.3),
    Key::new("mass_kg", Quantity(within("kg", 0.1, 50.0)), "mass of the door").or_number(3.0),
    Key::new("friction_nm", Quantity(within("N m", 0.0, 20.0)), "dry friction of the hinge").or_number(0.3),
    Key::new("damping_nms_per_rad", Number(within("N m s/rad", 0.0, 50.0)), "damping of the hinge").or_number(0.5),
    Key::new("seal_nm_per_rad", Number(within("N m/rad", 0.0, 1e4)), "stiffness of the seal that the closing door presses").or_number(20.0),
    Key::new("seal_travel_rad", Number(within("rad", 0.0, 0.2)), "how far the seal yields before the door stands still").or_number(0.05),
    Key::new("opening_max_rad", Number(within("rad", 0.1, 3.1)), "how far the door opens").or_number(1.2),
    Key::new("handles", Count(1, 9), "handles in a row; the first is the nearest to the hinge").or(Preset::Count(5)),
    Key::new("first_handle_m", Number(within("m", 0.01, 2.0)), "distance of the first handle from the hinge").or_number(0.2),
    Key::new("handle_spacing_m", Number(within("m", 0.01, 1.0)), "distance between handles").or_number(0.05),
    Key::new(
        "handle_lateral_m",
        Quantity(within("m", -3.0, 3.0)),
        "place of the handle in use along y, door closed; handles of the row less than a spacing beside it are not mounted",
    ),
    Key::new("handle_length_m", Number(within("m", 0.04, 1.0)), "length of a handle's bar").or_number(0.12),
    Key::new("handle_radius_m", Number(within("m", 0.001, 0.05)), "radius of a handle's bar").or_number(0.006),
    Key::new("handle_standoff_m", Number(within("m", 0.01, 0.2)), "distance of a bar's axis from the door's face").or_number(0.04),
    Key::new(
        "grip",
        Choice(&["clamp", "contact"]),
        "how a hook holds the handle: a clamp that closes with the gripper, or nothing but contact",
    )
    .or(Preset::Text("clamp")),
];

pub(super) const ALLOWED_CONTACT: Shape = Shape::plain(&[
    Key::new("name", Name, "its name in reports"),
    Key::new("a", Text, "a link of the robot or an object, with all its parts"),
    Key::new("b", Text, "the other one"),
]);
