//! The one list of what a recording holds: its timelines and its entities, by name and meaning.

use rerun::{EntityPath, external::re_log_types::EntityPathPart};

/// A timeline: what time means.
#[derive(Clone, Copy, Debug)]
pub struct Timeline {
    /// Its name in the file.
    pub name: &'static str,
    /// What it counts.
    pub meaning: &'static str,
}

/// Simulated time.
pub const SIM_TIME: Timeline = Timeline { name: "sim_time", meaning: "simulated time since the start of the execution (ns)" };
/// Engine steps.
pub const STEP: Timeline = Timeline { name: "step", meaning: "number of the engine step since the start of the execution" };
/// Phase.
pub const PHASE: Timeline =
    Timeline { name: "phase", meaning: "elapsed fraction u = -ln(s)/alpha of the skill's duration, 1 s being all of it" };

/// Time of the teaching.
pub const TEACHING_TIME: Timeline =
    Timeline { name: "teaching_time", meaning: "simulated time in which a person taught, one lesson after the other (ns)" };
/// Time of the replay.
pub const REPLAY_TIME: Timeline =
    Timeline { name: "replay_time", meaning: "simulated time in which the demonstrations were replayed, one after the other (ns)" };

/// All timelines.
pub const TIMELINES: [Timeline; 5] = [SIM_TIME, STEP, PHASE, TEACHING_TIME, REPLAY_TIME];

/// A kind of entity: a path in which names in braces stand for one name each.
#[derive(Clone, Copy, Debug)]
pub struct Entity {
    /// The path, e.g. `world/robot/{body}`.
    pub pattern: &'static str,
    /// What is logged there.
    pub meaning: &'static str,
}

impl Entity {
    /// The path with the braces filled by `names`, in order.
    #[must_use]
    pub fn of(&self, names: &[&str]) -> EntityPath {
        let mut names = names.iter();
        let part = |part: &str| if part.starts_with('{') { names.next().copied().unwrap_or(part).to_owned() } else { part.to_owned() };
        EntityPath::new(self.pattern.split('/').map(part).map(EntityPathPart::new).collect())
    }

    /// The path of an entity that is one of a kind.
    #[must_use]
    pub fn path(&self) -> EntityPath {
        self.of(&[])
    }
}

macro_rules! entities {
    ($($name:ident $pattern:literal $meaning:literal)+) => {
        $(#[doc = concat!("`", $pattern, "`: ", $meaning, ".")] pub const $name: Entity = Entity { pattern: $pattern, meaning: $meaning };)+
        /// All kinds of entities of this recording.
        pub const ENTITIES: &[Entity] = &[$($name),+];
    };
}

pub(super) use entities;

// Plots draw in the order of the paths: what matters most comes last.
entities! {
    WORLD "world" "the scene in the robot's base frame: x forward, y left, z up (m)"
    ROBOT_BODY "world/robot/{body}" "pose of a robot body in the world, at every logged step if it ever moves"
    ROBOT_SHAPE "world/robot/{body}/{shape}" "what the body looks like, in its frame"
    OBJECT "world/objects/{object}" "pose of an object of the scene, at every logged step if it ever moves"
    OBJECT_SHAPE "world/objects/{object}/{shape}" "what the object looks like, in its frame"
    TAUGHT_PATH "world/paths/taught/{demonstration}" "path of the tool in a demonstration"
    BASELINE_PATH "world/paths/baseline" "path that plain LWR-DMPs from the same demonstrations generate: they are not told the parameters"
    PLANNED_PATH "world/paths/planned" "path that the skill generates for this setting without any force"
    EXECUTED_PATH "world/paths/executed" "path of the tool: at each step the piece since the step before; the view keeps them all"
    BESIDE_PATH "world/paths/run_beside/{run}" "path of the tool of something that was executed beside the run, as the scenario names it"
    TOOL "world/tool" "pose of the tool frame (grasp centre) at every logged step"
    STATES "world/states" "how far the demonstrations disagree in each state of the motion model, at two standard deviations, coloured by beta"
    ACTIVE_STATE "world/active_state" "the same of the state that is active"
    ACTIVE_LABEL "world/active_state/label" "its number, and whether it complies"
    WRENCH_ARROW "world/forces/measured" "force of the environment on the tool as the controller estimates it, drawn a little beside the tool; above 15 N it is hardly longer"
    EXPECTED_ARROW "world/forces/expected" "force that the force model expects, drawn a little beside the measured one"
    PERSON_ARROW "world/forces/person" "force of the person on the arm, as an arrow that starts at the arm's surface"
    TAUGHT_MOTION "plots/motion/{axis}/demonstrated/{demonstration}" "taught coordinate of the tool, its duration stretched to the skill's (m)"
    STATE_OUTLINES "plots/motion/{axis}/gaussians" "the same of all states as ellipses over time, along the planned coordinate: of each the upper and the lower half (m)"
    PLANNED_MOTION "plots/motion/{axis}/planned" "coordinate of the tool that the skill generates (m)"
    BESIDE_MOTION "plots/motion/{axis}/run_beside/{run}" "coordinate of the tool of something that was executed beside the run (m)"
    EXECUTED_MOTION "plots/motion/{axis}/tool" "coordinate of the tool as executed (m)"
    WRENCH "plots/force/{axis}/measured" "measured force on the tool along an axis (N)"
    EXPECTED "plots/force/{axis}/expected" "expected force (N)"
    PERSON "plots/force/{axis}/person" "force of the person (N)"
    EXTERNAL "plots/force/{axis}/unexpected" "measured less expected force: what the coupling acts on (N)"
    BESIDE_FORCE "plots/beside/force/{axis}/{run}" "measured force of the run (`executed`) and of everything beside it (N)"
    BESIDE_ERROR "plots/beside/force_error/{axis}/{run}" "measured less expected force of each (N)"
    TAUGHT_FORCING "plots/forcing/{axis}/demonstrated/{demonstration}" "what the forcing term of a demonstration must have been, eq. (4) (m)"
    FORCING_OUTLINES "plots/forcing/{axis}/gaussians" "all states as ellipses over the phase, at two standard deviations: of each the upper and the lower half (m)"
    FORCING "plots/forcing/{axis}/skill" "forcing term of the skill in this setting (m)"
    PERSON_FORCE "plots/person/force" "size of the person's force (N)"
    PERSON_POWER "plots/person/power" "power that the person puts into the arm: force times velocity of the point where it acts (W)"
    SPREAD "plots/spread/active_state" "root of the active state's statistic of eq. (20): how far demonstrations disagree (mm; mrad for a skill of the joints)"
    THRESHOLD "plots/spread/threshold" "root of the threshold sigma: states above it comply (mm; mrad)"
    TORQUE "plots/torque/{axis}" "measured torque about the tool (N m)"
    COUPLING "plots/coupling/{axis}" "displacement zeta/K by the coupling term (m)"
    BETA "plots/compliance/beta" "beta of the active state: 0 stiff, -1 complies, +1 minimises the force error"
    ACTIVATION "plots/compliance/activation" "how far the coupling is switched on, 0 to 1"
    GRIPPER_COMMAND "plots/gripper/commanded" "commanded opening of the gripper, 0 closed to 1 open"
    GRIPPER_OPENING "plots/gripper/measured" "measured opening of the gripper"
    COMPLIANCE_LANE "lanes/compliance" "whether the arm is stiff or complies"
    STATE_LANE "lanes/state" "the active state"
    GRIPPER_LANE "lanes/gripper" "whether the gripper is told to be open or closed, where the skill changes that"
    PERSON_LANE "lanes/person" "whether the person holds the arm"
    NEAREST "world/nearest/{object}" "where the arm, or what it holds, comes nearest to an object, if within 5 cm: a line while it happens"
    NEAREST_LABEL "world/nearest/{object}/label" "how near, and what, in words beside the scene"
    CONTACT "world/contacts" "where parts touch, at each logged step: of each pair the deepest point since the step before; red what must not, white what may"
    FORBIDDEN "world/forbidden/{part}/{other}" "where two parts that must not touch do so deepest, each time from its first moment to shortly after its last"
    FORBIDDEN_LABEL "world/forbidden/{part}/{other}/label" "which parts, how hard and how deep, in words beside the scene"
    TEACHING "teaching" "the lessons, on the timeline teaching_time: the scene in the robot's base frame (m)"
    TEACHING_BODY "teaching/robot/{body}" "pose of a robot body while a person leads the arm"
    TEACHING_BODY_SHAPE "teaching/robot/{body}/{shape}" "what the body looks like, in its frame"
    TEACHING_OBJECT "teaching/objects/{object}" "pose of an object of the scene"
    TEACHING_OBJECT_SHAPE "teaching/objects/{object}/{shape}" "what the object looks like in the lesson's setting, in its frame"
    TEACHING_PATH "teaching/path" "path of the tool in the lesson: at each moment the piece since the moment before"
    TEACHING_PERSON "teaching/person" "force of the person who leads the arm"
    TEACHING_MOTION "teaching_plots/motion/{axis}" "coordinate of the tool as the encoders saw it (m)"
    TEACHING_FORCE "teaching_plots/person/force" "size of the person's force (N)"
    TEACHING_GRIPPER "teaching_plots/gripper/commanded" "opening of the gripper that the person commands"
    TEACHING_LANE "teaching_lanes/lesson" "the number of the demonstration that is taught"
    TEACHING_NAME "teaching_name" "its name"
    REPLAY_PATH "replay/tool" "pose of the tool frame in the demonstration that is replayed"
    REPLAY_ARROW "replay/force" "force of the environment on the tool that the replaying arm estimates"
    REPLAY_FORCE "replay_plots/force/{axis}" "the same along an axis (N)"
    REPLAY_LANE "replay_lanes/demonstration" "the number of the demonstration that is replayed"
    REPLAY_NAME "replay_name" "its name"
    EVENTS "events" "what happens, in words"
    EVENTS_SO_FAR "events_so_far" "the events until now, the last one first"
    RESULT "result" "how the run ended, and what was asked of it"
    SCENE_KEY "legends/scene" "what ellipsoids, lines, arrows and points mean, and what the runs beside this one change"
    BESIDE_COLORS "legends/beside" "which colour is the run, and which what was executed beside it"
    ERROR_COLORS "legends/beside_error" "the same of those that expect a force"
    FORCE_COLORS "legends/force" "which colour is which force"
    GUIDE "guide" "how to read this recording"
}
