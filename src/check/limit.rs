//! Which number a criterion's value is held against, so that a value that is known can be held against another one.

use super::{CriterionKind, CriterionSpec};

/// A limit, and on which side of it a value must lie; in the unit of the value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The largest value allowed.
    AtMost(f64),
    /// The smallest value allowed.
    AtLeast(f64),
}

impl Limit {
    /// The limit itself.
    #[must_use]
    pub fn value(self) -> f64 {
        let (Self::AtMost(limit) | Self::AtLeast(limit)) = self;
        limit
    }

    /// How far `value` is on the right side of it (negative: on the wrong side).
    #[must_use]
    pub fn margin(self, value: f64) -> f64 {
        match self {
            Self::AtMost(limit) => limit - value,
            Self::AtLeast(limit) => value - limit,
        }
    }
}

impl CriterionSpec {
    /// The limit that the scenario gives; `None` of a question whose limit is part of the scene or of the question itself.
    #[must_use]
    pub fn limit(&self) -> Option<Limit> {
        split(self.kind.clone()).1
    }

    /// Whether `other` asks for the same value, whatever limit and answer it expects.
    #[must_use]
    pub fn asks_the_same(&self, other: &Self) -> bool {
        self.name == other.name && split(self.kind.clone()).0 == split(other.kind.clone()).0
    }
}

/// The question without its limit, and the limit.
fn split(mut kind: CriterionKind) -> (CriterionKind, Option<Limit>) {
    let limit = match &mut kind {
        CriterionKind::ArcFollowed { max_m: max, .. }
        | CriterionKind::HookKept { max_m: max, .. }
        | CriterionKind::ObjectAt { max_m: max, .. }
        | CriterionKind::GoalReached { max_m: max }
        | CriterionKind::GripperOverObject { max_m: max, .. }
        | CriterionKind::ReferenceUnmoved { max_m: max }
        | CriterionKind::GripperUnmoved { max_m: max }
        | CriterionKind::ToolForce { max_n: max, .. }
        | CriterionKind::ExpectedForce { max_n: max, .. }
        | CriterionKind::HumanForce { max_n: max } => Some(Limit::AtMost(std::mem::take(max))),
        CriterionKind::DoorOpen { min_rad: min, .. }
        | CriterionKind::Clearance { min_m: min, .. }
        | CriterionKind::PlanarClearance { min_m: min, .. }
        | CriterionKind::PlanarSidesPassed { min_m: min, .. } => Some(Limit::AtLeast(std::mem::take(min))),
        CriterionKind::ObjectInContainer { .. }
        | CriterionKind::NoContact { .. }
        | CriterionKind::NoCollision
        | CriterionKind::ComplianceWindow { .. }
        | CriterionKind::PlanarCollides { .. } => None,
    };
    (kind, limit)
}
