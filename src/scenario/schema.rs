//! The table of keys of a scenario file: robot, simulation, teaching, execution and the person; large parts are in files of their own beside it.

use super::key::Kind::{
    Choice, Count, Flag, Folders, Grid, List, Name, Number, Numbers, Path, Reference, Section, Tag, Text, Vector, Windows,
};
use super::key::Length::{AtLeast, Exactly};
use super::key::To::{MovableObject, Object};
use super::key::{Key, PathTo, Preset, Shape, Variant};
use super::measure::{above, within};
use super::schema_criteria::CRITERION;
use super::schema_learning::{COUPLING, LEARNING};
use super::schema_planar::PLANAR;
use super::schema_scene::{ALLOWED_CONTACT, OBJECT};
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

const ROBOT: Shape = Shape::plain(&[
    Key::new("urdf", Path(PathTo::Robot), "the robot's description").or(Preset::Text("builtin:baxter")),
    Key::new("package_directories", Folders, "where package://NAME/ is looked up, besides the folders above the URDF file").or_empty(),
    Key::new("tool_link", Text, "the link that is the tool, at the grasp centre; its arm works").or(Preset::Text("left_gripper_tool")),
    Key::new("grasp_link", Text, "the link that a person takes hold of").or(Preset::Text("left_wrist")),
    Key::new("finger_friction", Number(within("", 0.0, 5.0)), "coefficient of friction of the fingers: rubber pads 1, smooth caps less")
        .or_number(1.0),
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

#[cfg(test)]
mod tests {
    use super::super::key::Kind::{CountOrWord, NumberOrWord, Quantity, References, Texts};
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
