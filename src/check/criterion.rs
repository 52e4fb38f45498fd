//! What a scenario asks of a run, and what came of it.

use crate::planar::Method;

/// One question about a run and the answer that the scenario expects.
#[derive(Clone, Debug, PartialEq)]
pub struct CriterionSpec {
    /// Its name in reports: unique in the scenario.
    pub name: String,
    /// The question.
    pub kind: CriterionKind,
    /// The answer that the scenario expects.
    pub expect: Expectation,
}

/// The answer that a scenario expects of a criterion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expectation {
    /// It must hold.
    Pass,
    /// It must not hold: a counterfactual run shows what goes wrong.
    Fail,
    /// It is only reported.
    Report,
}

impl Expectation {
    /// As scenarios and reports call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Report => "report",
        }
    }
}

/// The questions that can be asked. They are answered from the simulated world, but for three that are about what the skill wants:
/// [`Self::GoalReached`] and [`Self::ExpectedForce`] hold the world against the skill's goal and its expected force, and [`Self::ArcFollowed`] of
/// the reference asks where the controller wants the tool.
#[derive(Clone, Debug, PartialEq)]
pub enum CriterionKind {
    /// The object lies inside the container, at rest. Value: distance of the centres along x or y, whichever is larger (m); beyond the limit when
    /// the object sticks out at the top or is not at rest.
    ObjectInContainer {
        /// The object's name.
        object: String,
        /// The container's name.
        container: String,
        /// Largest speed that counts as rest (m/s).
        speed_max_m_per_s: f64,
    },
    /// Neither the robot nor what it holds touches the objects. Value: number of touching pairs.
    NoContact {
        /// The objects' names.
        objects: Vec<String>,
    },
    /// The door of a cabinet is open at the end. Value: its opening (rad).
    DoorOpen {
        /// The cabinet's name.
        object: String,
        /// The smallest opening (rad).
        min_rad: f64,
    },
    /// The arc of the handle in use about the hinge is followed. Value: rms distance from the arc in the horizontal plane over the run (m).
    ArcFollowed {
        /// The cabinet's name.
        object: String,
        /// What follows it.
        of: Followed,
        /// The largest rms distance (m).
        max_m: f64,
    },
    /// The handle in use stays in the hook from the start to the end, as far as a horizontal distance tells: a bar is upright, and may slide along
    /// the hook. Value: largest horizontal distance of the tool from its axis (m).
    HookKept {
        /// The cabinet's name.
        object: String,
        /// The largest distance (m): half the width of the hook's pocket, less what the bar needs.
        max_m: f64,
    },
    /// The objects never push or pull harder on fingers and tool than this, as the engine solved it: through a clamp and by contacts,
    /// pressing and rubbing. Value: the largest force (N).
    ToolForce {
        /// Over which time the force is averaged, rounded up to whole logged steps (s); 0: at every engine step. A blow of stiff parts is
        /// over within a step of the engine, so that its force says more about the step than about the blow: its momentum is what counts.
        mean_over_s: f64,
        /// The largest force (N).
        max_n: f64,
    },
    /// The robot and what it holds stay away from the objects. Value: the smallest distance (m).
    Clearance {
        /// The objects' names.
        objects: Vec<String>,
        /// Links of the robot, or objects in the gripper, whose distance counts; all of them when there is none.
        links: Vec<String>,
        /// The smallest distance allowed (m).
        min_m: f64,
    },
    /// A method passes on every side that is asked for, in planar settings where the side is told or not.
    PlanarSidesPassed {
        /// Whose movements.
        method: Method,
        /// In which settings.
        settings: PlanarSettings,
        /// Whether the side is a parameter of them.
        side_told: bool,
        /// Smallest distance to the obstacle with which each side must be passed (m).
        min_m: f64,
    },
    /// The movements of a method stay away from the obstacle. Value: the smallest clearance (m), negative inside. Without such a movement there
    /// is no answer.
    PlanarClearance {
        /// Whose movements.
        method: Method,
        /// In which settings.
        settings: PlanarSettings,
        /// The smallest clearance allowed (m).
        min_m: f64,
    },
    /// The movements of a method collide at least once. Value: settings with a collision.
    PlanarCollides {
        /// Whose movements.
        method: Method,
        /// In which settings.
        settings: PlanarSettings,
    },
    /// Nothing touches that the scene does not allow: the robot touches nothing, except with its fingers what can be moved. Value: number of
    /// touching pairs.
    NoCollision,
    /// The arm feels the force that the skill expects. Value: rms difference of the arm's own measured force from the expected one along one
    /// axis, to the end of the skill (N). Without a force model, or without the touch from which it counts, there is no answer.
    ExpectedForce {
        /// The axis: 0, 1, 2 for x, y, z of the world.
        axis: usize,
        /// From when on the difference counts.
        from: CountsFrom,
        /// The largest rms difference (N).
        max_n: f64,
    },
    /// An object ends at a place. Value: its distance from there (m).
    ObjectAt {
        /// The object's name.
        object: String,
        /// The object from whose place at the end the offset counts; the world's origin without one.
        at: Option<String>,
        /// The offset, world axes (m).
        offset_m: [f64; 3],
        /// The largest distance (m).
        max_m: f64,
    },
    /// The tool ends at the skill's goal, as learned for the setting. Value: the distance (m).
    GoalReached {
        /// The largest distance allowed (m).
        max_m: f64,
    },
    /// The person's force never exceeds the limit. Value: the peak force (N).
    HumanForce {
        /// The largest force (N).
        max_n: f64,
    },
    /// The arm complies when the gripper closes, and is stiff while the hand is over any of the objects. Value: seconds to
    /// spare. There is no answer when the hand never comes to one of the objects.
    ComplianceWindow {
        /// The objects at which the arm must be stiff.
        stiff_at: Vec<String>,
    },
    /// When the gripper closes, it is over the place where the object lay at the start. Value: horizontal distance to the grasp centre (m).
    GripperOverObject {
        /// The object's name.
        object: String,
        /// The largest distance allowed (m).
        max_m: f64,
    },
    /// While the person pushes, the coupling moves the reference by no more than this. Value: the largest displacement (m), of what the coupling
    /// asks for and of what has come of it. Without a push there is no answer.
    ReferenceUnmoved {
        /// The largest displacement (m); 0 asks for exactly none.
        max_m: f64,
    },
    /// While the person pushes, the tool stays near where the reference wants it. Value: largest change of the distance since the push began (m). Without a
    /// push there is no answer.
    GripperUnmoved {
        /// The largest change (m).
        max_m: f64,
    },
}

/// From when on a difference counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CountsFrom {
    /// The start of the skill.
    Start,
    /// The first logged moment at which an object has touched fingers or tool.
    Touch,
}

/// What follows an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Followed {
    /// The tool, in the simulated world.
    Tool,
    /// Where the controller wants the tool.
    Reference,
}

/// Settings of a planar experiment, by what was demonstrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanarSettings {
    /// Every one.
    All,
    /// Those that were demonstrated.
    Taught,
    /// Those between the demonstrated ones.
    New,
    /// Those outside of them.
    Beyond,
}

/// The answer to one criterion.
#[derive(Clone, Debug, PartialEq)]
pub struct Criterion {
    /// Its name.
    pub name: String,
    /// The answer that was expected.
    pub expect: Expectation,
    /// Whether it holds.
    pub passed: bool,
    /// The measured value, in `unit`. NaN when the event it is about never happened.
    pub value: f64,
    /// The limit it is held against, in `unit`.
    pub limit: f64,
    /// How far the value is on the right side of the limit, in `unit` (negative: on the wrong side).
    pub margin: f64,
    /// `m`, `rad`, `N`, `s`, `pairs` or `settings`.
    pub unit: &'static str,
    /// When it first failed (s), if it failed at a moment.
    pub first_failed_time_s: Option<f64>,
    /// Why it was not judged at all, if it was not. No verdict depends on it then.
    pub not_judged: Option<&'static str>,
}

impl Criterion {
    /// Whether the answer is the one that the scenario expects. What was never measured is neither good nor bad, and so never expected.
    pub fn as_expected(&self) -> bool {
        match self.expect {
            Expectation::Pass => self.passed,
            Expectation::Fail => !self.passed && !self.value.is_nan(),
            Expectation::Report => true,
        }
    }

    /// Whether it speaks against the run: it was judged, and the answer is not the one that the scenario expects.
    pub fn fails(&self) -> bool {
        self.not_judged.is_none() && !self.as_expected()
    }
}
