//! The table of keys: the whole scenario language on one page.

use super::key::Kind::{
    Choice, Count, CountOrWord, Flag, Folders, Grid, List, Name, Number, NumberOrWord, Numbers, Path, Quantity, Reference, References,
    Section, Tag, Text, Texts, Vector, Windows,
};
use super::key::Length::{AtLeast, Exactly};
use super::key::To::{MovableObject, Object, ObjectOfKind, Parameter};
use super::key::{Key, PathTo, Preset, Shape, Variant};
use super::measure::{above, within};
use super::schema_sweep::{BESIDE, SWEEP};

/// The version of the language that this program reads and writes.
pub(super) const SCHEMA_VERSION: i64 = 1;

/// A scenario file.
pub(super) const SCENARIO: Shape = Shape::plain(&[
    Key::new("schema_version", Count(1, SCHEMA_VERSION), "version of the scenario language"),
    Key::new("name", Name, "name of the scenario, also that of its run folder"),
    Key::new("description", Text, "what it shows, in one line").or(Preset::Text("")),
    Key::new("seed", Count(0, i64::MAX), "decides every random number of the run").or(Preset::Count(0)),
    Key::new("parameters", Numbers, "task parameters: the setting in which the skill is executed").or_empty(),
    Key::new("demonstrations", Path(PathTo::Dataset), "a recorded dataset, instead of [teaching]").optional(),
    Key::new("planar", Section(PLANAR), "an experiment in a plane without an arm, instead of everything about robot, scene and person")
        .optional(),
    Key::new("robot", Section(ROBOT), "the robot, its postures and its joint controller").or_empty(),
    Key::new("simulation", Section(SIMULATION), "the engine").or_empty(),
    Key::new("object", List(OBJECT), "the scene").or_empty(),
    Key::new("teaching", Section(TEACHING), "how the virtual human teaches").optional(),
    Key::new("learning", Section(LEARNING), "how the skill is learned").or_empty(),
    Key::new("coupling", Section(COUPLING), "the coupling of force error and motion").or_empty(),
    Key::new("execution", Section(EXECUTION), "how the skill is executed").or_empty(),
    Key::new("human", Section(HUMAN), "the virtual human").or_empty(),
    Key::new("recording", Section(RECORDING), "what is written to the run folder").or_empty(),
    Key::new("allowed_contact", List(ALLOWED_CONTACT), "contacts that are no collisions").or_empty(),
    Key::new("criterion", List(CRITERION), "what the run must show").or_empty(),
    Key::new("beside", List(BESIDE), "what is executed besides, after the same lessons in the same scene, to be held against the run")
        .or_empty(),
    Key::new("sweep", List(SWEEP), "what `cpdmp sweep` varies from run to run; a single run leaves it aside").or_empty(),
]);

/// A file with nothing but the `[learning]` table.
pub(super) const LEARNING_FILE: Shape = Shape::plain(&[
    Key::new("schema_version", Count(1, SCHEMA_VERSION), "version of the scenario language").optional(),
    Key::new("learning", Section(LEARNING), "how the skill is learned").or_empty(),
]);

const PLANAR: Shape = Shape {
    keys: &[
        Key::new("kind", Tag, "which experiment"),
        Key::new("obstacle_half_depth_m", Number(within("m", 0.05, 10.0)), "half depth of the obstacle, along y").or_number(0.5),
        Key::new("start_m", Vector(within("m", -100.0, 100.0), Exactly(2)), "where movements start").or(Preset::Vector(&[0.0, -4.0])),
        Key::new("clearance_m", Number(within("m", 0.01, 10.0)), "distance at which the person passes the obstacle's edge").or_number(1.0),
        Key::new("pass_fraction", Number(within("", 0.1, 0.9)), "when they pass it, as a fraction of the duration").or_number(0.5),
    ],
    variants: &[
        Variant {
            kind: "obstacle_avoidance",
            keys: &[
                Key::new("hand", Section(TWICE), "how movements are shown").or_empty(),
                Key::new("goal_y_m", Number(within("m", -100.0, 100.0)), "where goals lie along y").or_number(4.0),
                Key::new("obstacle_half_width_m", Number(within("m", 0.05, 10.0)), "half width of the obstacle, along x").or_number(1.0),
                Key::new("taught_goals_x_m", Vector(within("m", -100.0, 100.0), AtLeast(2)), "taught goals along x")
                    .or(Preset::Vector(&[1.0, 2.0, 3.0, 4.0])),
                Key::new("new_goals_x_m", Vector(within("m", -100.0, 100.0), AtLeast(0)), "new goals along x")
                    .or(Preset::Vector(&[-2.0, -1.0, 0.0, 2.5, 5.0])),
            ],
        },
        Variant {
            kind: "two_sided_obstacle",
            keys: &[
                Key::new("hand", Section(THRICE), "how movements are shown").or_empty(),
                Key::new(
                    "taught_half_widths_m",
                    Vector(within("m", 0.05, 10.0), AtLeast(2)),
                    "taught half widths of the obstacle, along x",
                )
                .or(Preset::Vector(&[1.0, 2.0])),
                Key::new("new_half_widths_m", Vector(within("m", 0.05, 10.0), AtLeast(0)), "new half widths")
                    .or(Preset::Vector(&[1.5, 2.5])),
                Key::new("goal_m", Vector(within("m", -100.0, 100.0), Exactly(2)), "where movements end").or(Preset::Vector(&[0.0, 4.0])),
                Key::new("states_without_side", Count(1, 200), "states of the model that is not told the side; any may follow any other")
                    .or(Preset::Count(9)),
                Key::new("kmeans_starts_without_side", Count(0, 1000), "its starts by k-means, beside those by time slices")
                    .or(Preset::Count(4)),
                Key::new("tp_gmm_components", Count(1, 200), "components of TP-GMM").or(Preset::Count(16)),
            ],
        },
    ],
};

const TWICE: Shape = Shape::plain(&hand(2));
const THRICE: Shape = Shape::plain(&hand(3));

const fn hand(repetitions: i64) -> [Key; 7] {
    [
        Key::new("repetitions", Count(1, 50), "how often each situation is shown").or(Preset::Count(repetitions)),
        Key::new("duration_s", Number(within("s", 0.5, 60.0)), "mean duration").or_number(4.0),
        Key::new("rate_hz", Number(within("Hz", 10.0, 1000.0)), "samples per second").or_number(100.0),
        Key::new("duration_spread", Number(within("", 0.0, 0.3)), "spread of the duration, as a fraction of it").or_number(0.05),
        Key::new("timing_spread", Number(within("", 0.0, 0.1)), "spread of when the obstacle is passed, as a fraction of the duration")
            .or_number(0.02),
        Key::new("shape_spread_m", Number(within("m", 0.0, 1.0)), "spread of where it is passed, per axis").or_number(0.05),
        Key::new("noise_m", Number(within("m", 0.0, 0.1)), "noise of the position sensor per axis, standard deviation").or_number(0.002),
    ]
}

const ROBOT: Shape = Shape::plain(&[
    Key::new("urdf", Path(PathTo::Robot), "the robot's description").or(Preset::Text("builtin:baxter")),
    Key::new("package_directories", Folders, "where package://NAME/ is looked up, besides the folders above the URDF file").or_empty(),
    Key::new("tool_link", Text, "the link that is the tool, at the grasp centre; its arm works").or(Preset::Text("left_gripper_tool")),
    Key::new("grasp_link", Text, "the link that a person takes hold of").or(Preset::Text("left_wrist")),
    Key::new("idle_tool_link", Text, "the link that is the other arm's tool").or(Preset::Text("right_hand")),
    Key::new(
        "rest_posture_rad",
        Vector(within("rad", -7.0, 7.0), AtLeast(1)),
        "posture that inverse kinematics prefers, from the shoulder",
    )
    .or(Preset::Vector(&[-0.4347, -1.0645, -0.4138, 1.934, 0.2873, 0.7587, -0.2272])),
    Key::new(
        "idle_posture_rad",
        Vector(within("rad", -7.0, 7.0), AtLeast(0)),
        "posture that the other arm holds; empty without another arm",
    )
    .or(Preset::Vector(&[0.6, -0.6, 0.0, 1.6, 0.0, 0.6, 0.0])),
    Key::new("impedance", Section(IMPEDANCE), "the joint controller of both arms").or_empty(),
    Key::new("sensor", Section(SENSOR), "what is wrong with joints and wrench estimate").or_empty(),
]);

const IMPEDANCE: Shape = Shape::plain(&[
    Key::new("stiffness_nm_per_rad", Vector(above("N m/rad", 0.0, 1e5), AtLeast(1)), "stiffness of each joint, from the shoulder")
        .or(Preset::Vector(&[1500.0, 1500.0, 800.0, 800.0, 250.0, 250.0, 120.0])),
    Key::new("damping_nms_per_rad", Vector(within("N m s/rad", 0.0, 1e4), AtLeast(1)), "damping of each joint, from the shoulder")
        .or(Preset::Vector(&[60.0, 60.0, 30.0, 30.0, 8.0, 8.0, 4.0])),
]);

const SENSOR: Shape = Shape::plain(&[
    Key::new("effort_noise_nm", Number(within("N m", 0.0, 5.0)), "white noise on each joint's effort, standard deviation").or_number(0.05),
    Key::new("effort_bias_nm", Number(within("N m", 0.0, 5.0)), "constant offset of each joint's effort, standard deviation")
        .or_number(0.1),
    Key::new("dry_friction_nm", Number(within("N m", 0.0, 5.0)), "dry friction of each joint").or_number(0.1),
    Key::new("dynamics_model", Choice(&["gravity", "full"]), "what the wrench estimate subtracts").or(Preset::Text("gravity")),
    Key::new("filter_cutoff_hz", Number(within("Hz", 0.1, 500.0).or_infinite()), "low-pass on the wrench estimate").or_number(5.0),
]);

const SIMULATION: Shape = Shape::plain(&[
    Key::new("step_s", Number(within("s", 1e-4, 2e-3)), "step of the engine and of the controller").or_number(1e-3),
    Key::new("solver_iterations", Count(1, 16), "solver iterations per step").or(Preset::Count(1)),
    Key::new("gravity_m_per_s2", Vector(within("m/s²", -100.0, 100.0), Exactly(3)), "acceleration of gravity, world axes")
        .or(Preset::Vector(&[0.0, 0.0, -9.81])),
    Key::new("log_rate_hz", Number(within("Hz", 10.0, 1e4)), "samples per second in step log and recording").or_number(100.0),
]);

const OBJECT: Shape = Shape {
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

const TEACHING: Shape = Shape::plain(&[
    Key::new("repetitions", Count(1, 100), "how often each combination of the grid is shown").or(Preset::Count(1)),
    Key::new("tool_yaw_rad", Number(within("rad", -7.0, 7.0)), "turn of the tool about the vertical").or_number(0.0),
    Key::new("tool_pitch_rad", Number(within("rad", -7.0, 7.0)), "by how much the tool is lifted from pointing down towards the front")
        .or_number(0.0),
    Key::new("tool_roll_rad", Number(within("rad", -7.0, 7.0)), "turn of the tool about its own z axis").or_number(0.0),
    Key::new("turns_with_door", Number(within("", 0.0, 1.0)), "how far the tool turns with a door: 0 not at all … 1 as the door")
        .or_number(0.0),
    Key::new(
        "zero_gravity_damping_nms_per_rad",
        Number(within("N m s/rad", 0.0, 100.0)),
        "damping of the joints while a person leads the arm",
    )
    .or_number(2.0),
    Key::new("duration_s", Number(within("s", 0.5, 600.0)), "how long a demonstration lasts").or_number(28.0),
    Key::new("record_rate_hz", Number(within("Hz", 1.0, 1e4)), "samples per second of the dataset").or_number(100.0),
    Key::new("position_spread_m", Number(within("m", 0.0, 0.2)), "spread of a way-point between demonstrations, per axis").or_number(0.0),
    Key::new("timing_spread", Number(within("", 0.0, 0.2)), "spread of a way-point's time, as a fraction of the duration").or_number(0.0),
    Key::new("grid", Grid, "values of parameters: each combination is one demonstration").or_empty(),
    Key::new("waypoint", List(WAYPOINT), "where the person leads the gripper"),
]);

const WAYPOINT: Shape = Shape::plain(&[
    Key::new("time_s", Number(within("s", 0.0, 600.0)), "when it is reached, from the start of the demonstration"),
    Key::new("at", Reference(Object), "the object whose anchor the offset is relative to; the world's origin without one").optional(),
    Key::new("offset_m", Vector(within("m", -3.0, 3.0), Exactly(3)), "offset from the anchor, world axes")
        .or(Preset::Vector(&[0.0, 0.0, 0.0])),
    Key::new("opening_rad", Number(within("rad", 0.0, 3.1)), "how far the door is open: the way-point is carried along with it").optional(),
    Key::new("gripper", Number(within("", 0.0, 1.0)), "opening that is commanded from here on (0 closed … 1 open)").optional(),
]);

const LEARNING: Shape = Shape::plain(&[
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

const COUPLING: Shape = Shape::plain(&[
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

const EXECUTION: Shape = Shape::plain(&[
    Key::new("duration_s", Number(within("s", 0.5, 600.0)), "duration of the skill; that of the demonstrations without it").optional(),
    Key::new("integrator", Choice(&["hold", "rk4"]), "exact for a forcing held over the step, or Runge-Kutta").or(Preset::Text("hold")),
    Key::new(
        "feedback",
        Choice(&["none", "measured"]),
        "whether the skill goes on from where it sent the arm, or is drawn to where the arm is",
    )
    .or(Preset::Text("none")),
    Key::new("feedback_time_s", Number(within("s", 0.001, 100.0)), "time constant with which it is drawn there").or_number(0.2),
    Key::new(
        "phase_stopping",
        Flag,
        "whether the phase waits while the movement is off its path: pushed by the coupling or, with feedback, held back",
    )
    .or(Preset::Flag(false)),
    Key::new(
        "phase_stopping_gain",
        Number(within("per m² or rad²", 0.0, 1e9)),
        "the phase's rate is 1 / (1 + gain times the squared distance from the path)",
    )
    .or_number(1e4),
    Key::new("phase_stopping_slowest", Number(within("", 0.001, 1.0)), "the rate below which it never falls").or_number(0.05),
    Key::new("settle_s", Number(within("s", 0.0, 60.0)), "how long the run goes on before the world is judged").or_number(1.5),
]);

const HUMAN: Shape = Shape::plain(&[
    Key::new("stiffness_n_per_m", Number(within("N/m", 1.0, 5000.0)), "stiffness of the hand").or_number(600.0),
    Key::new("damping_ns_per_m", Number(within("N s/m", 0.0, 500.0)), "damping of the hand").or_number(60.0),
    Key::new("rotational_stiffness_nm_per_rad", Number(within("N m/rad", 0.0, 500.0)), "rotational stiffness of the grip").or_number(30.0),
    Key::new("rotational_damping_nms_per_rad", Number(within("N m s/rad", 0.0, 50.0)), "rotational damping of the grip").or_number(1.5),
    Key::new("teaching_force_max_n", Number(within("N", 0.0, 200.0)), "largest force while teaching").or_number(40.0),
    Key::new("moment_max_nm", Number(within("N m", 0.0, 50.0)), "largest moment of the grip").or_number(8.0),
    Key::new("helping_stiffness_n_per_m", Number(within("N/m", 0.0, 2000.0)), "push of a helping hand per metre that the gripper is off")
        .or_number(60.0),
    Key::new("helping_rate_n_per_ms", Number(within("N/(m s)", 0.0, 5000.0)), "how fast it pushes harder while the gripper stays off")
        .or_number(150.0),
    Key::new("aim_spread_m", Number(within("m", 0.0, 0.1)), "how far a helping person misjudges where an object is, standard deviation")
        .or_number(0.003),
    Key::new("strength_spread", Number(within("", 0.0, 0.5)), "how much helping people differ in strength and reach, as a fraction")
        .or_number(0.15),
    Key::new("helping_damping_ns_per_m", Number(within("N s/m", 0.0, 500.0)), "how much it holds back while the gripper moves")
        .or_number(10.0),
    Key::new("visual_gain_per_s", Number(within("1/s", 0.0, 20.0)), "rate of the visual correction").or_number(2.0),
    Key::new("visual_correction_max_m", Number(within("m", 0.0, 0.5)), "largest visual correction").or_number(0.12),
    Key::new("help", Section(HELP), "what the person does while the skill is executed").or_empty(),
]);

const HELP: Shape = Shape {
    keys: &[Key::new("kind", Tag, "nothing, bringing the gripper over an object, or a given push").or(Preset::Text("none"))],
    variants: &[
        Variant { kind: "none", keys: &[] },
        Variant {
            kind: "guide",
            keys: &[
                Key::new("object", Reference(MovableObject), "the object over which the person brings the gripper"),
                Key::new("reach_m", Number(within("m", 0.0, 2.0)), "horizontal distance at which the person takes hold").or_number(0.12),
                Key::new("force_max_n", Number(within("N", 0.0, 200.0)), "largest force").or_number(15.0),
                Key::new("weight_xy", Vector(within("", 0.0, 1.0), Exactly(2)), "how much of the error along x and y the person corrects")
                    .or(Preset::Vector(&[1.0, 1.0])),
            ],
        },
        Variant {
            kind: "push",
            keys: &[
                Key::new("force_n", Vector(within("N", -200.0, 200.0), Exactly(3)), "the force, world axes"),
                Key::new("windows_s", Windows(within("s", 0.0, 660.0)), "start and end of each push, from the start of the skill"),
            ],
        },
    ],
};

const RECORDING: Shape = Shape::plain(&[
    Key::new("rrd", Flag, "recording.rrd, for the rerun viewer").or(Preset::Flag(true)),
    Key::new("steps", Flag, "steps.parquet, one row per logged step; paths.parquet of a planar experiment").or(Preset::Flag(true)),
    Key::new("demonstrations", Flag, "demonstrations/, the dataset that was learned from").or(Preset::Flag(true)),
    Key::new("hash_every_steps", Count(0, 1_000_000), "state_hashes.parquet, for `cpdmp replay`: steps between two hashes; 0 for none")
        .or(Preset::Count(100)),
    Key::new(
        "snapshot_every_steps",
        Count(0, 10_000_000),
        "snapshots.bin, from which `cpdmp replay --from-time` takes the execution up: steps between two; 0 for none",
    )
    .or(Preset::Count(5000)),
]);

/// What makes movements in planar experiments.
const METHODS: [&str; 5] = ["cpdmp", "cpdmp_product", "cpdmp_chain", "lwr_dmp", "tp_gmm"];

const ALLOWED_CONTACT: Shape = Shape::plain(&[
    Key::new("name", Name, "its name in reports"),
    Key::new("a", Text, "a link of the robot or an object, with all its parts"),
    Key::new("b", Text, "the other one"),
]);

const CRITERION: Shape = Shape {
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::key::Kind;
    use super::*;

    /// Every table of the language, with each of its kinds.
    fn tables(shape: &Shape, all: &mut Vec<Vec<Key>>) {
        all.push(shape.keys.to_vec());
        all.extend(shape.variants.iter().map(|variant| shape.keys_of(Some(variant.kind)).copied().collect()));
        for key in all.last().cloned().unwrap_or_default() {
            if let Kind::Section(inner) | Kind::List(inner) = key.kind {
                tables(&inner, all);
            }
        }
    }

    fn language() -> Vec<Vec<Key>> {
        let mut all = Vec::new();
        tables(&SCENARIO, &mut all);
        all
    }

    #[test]
    fn no_table_has_a_key_twice() {
        for table in language() {
            let names: BTreeSet<&str> = table.iter().map(|key| key.name).collect();
            assert_eq!(names.len(), table.len(), "{names:?}");
        }
    }

    #[test]
    fn what_stands_for_an_absent_key_suits_the_key() {
        for key in language().concat() {
            let suits = match (key.kind, key.preset) {
                (Number(measure) | Quantity(measure) | NumberOrWord(measure, _), Preset::Number(number)) => measure.accepts(number),
                (Vector(measure, Exactly(length)), Preset::Vector(numbers)) => {
                    numbers.len() == length && numbers.iter().all(|&number| measure.accepts(number))
                }
                (Vector(measure, AtLeast(length)), Preset::Vector(numbers)) => {
                    numbers.len() >= length && numbers.iter().all(|&number| measure.accepts(number))
                }
                (Count(min, max) | CountOrWord(min, max, _), Preset::Count(count)) => (min..=max).contains(&count),
                (Choice(choices), Preset::Text(text)) => choices.contains(&text),
                (Flag, Preset::Flag(_)) | (Text | Path(_) | Tag, Preset::Text(_)) => true,
                (Numbers | Grid | Section(_) | List(_) | References(_) | Texts | Folders, Preset::Empty) => true,
                (_, preset) => matches!(preset, Preset::Required | Preset::Optional),
            };
            assert!(suits, "{key:?}");
        }
    }
}
