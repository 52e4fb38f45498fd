//! What a robot's file holds, for people and for other programs.

use schemars::JsonSchema;
use serde::Serialize;

use super::table::{figure, table};
use crate::robot::{Joint, JointKind, Loaded};

/// A robot as its file tells it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RobotSection {
    /// Its name.
    pub name: String,
    /// Number of rigid bodies: links joined by fixed joints count as one.
    pub bodies: usize,
    /// Number of links.
    pub links: usize,
    /// Mass of everything (kg).
    pub mass_kg: f64,
    /// Joints that move.
    pub joints: Vec<JointLine>,
    /// What is odd about the file.
    pub warnings: Vec<String>,
}

/// One joint that moves; rad, rad/s and N m for one that turns, m, m/s and N for one that slides.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JointLine {
    /// Its name.
    pub name: String,
    /// `revolute`, `continuous` or `prismatic`.
    pub kind: &'static str,
    /// Smallest position; none without a limit.
    pub lower: Option<f64>,
    /// Largest position.
    pub upper: Option<f64>,
    /// Largest speed.
    pub velocity_limit: Option<f64>,
    /// Largest effort.
    pub effort_limit: Option<f64>,
    /// Whether it follows another joint.
    pub mimic: bool,
}

impl RobotSection {
    /// Reads a robot.
    pub fn of(loaded: &Loaded) -> Self {
        let model = &loaded.model;
        Self {
            name: model.name.clone(),
            bodies: model.bodies.len(),
            links: model.frames.len(),
            mass_kg: model.bodies.iter().map(|body| body.mass_kg).sum(),
            joints: model.joints.iter().map(joint).collect(),
            warnings: loaded.warnings.iter().map(ToString::to_string).collect(),
        }
    }

    /// The section as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("  name         {}", self.name),
            format!("  links        {}, {} bodies, {} kg", self.links, self.bodies, figure(self.mass_kg)),
            String::new(),
        ];
        let heading = ["joint", "kind", "lower", "upper", "speed", "effort"].map(str::to_owned).to_vec();
        let number = |value: Option<f64>| value.map_or("-".to_owned(), figure);
        let row = |joint: &JointLine| {
            let kind = if joint.mimic { format!("{}, follows", joint.kind) } else { joint.kind.to_owned() };
            let mut row = vec![joint.name.clone(), kind];
            row.extend([joint.lower, joint.upper, joint.velocity_limit, joint.effort_limit].map(number));
            row
        };
        lines.extend(table(&std::iter::once(heading).chain(self.joints.iter().map(row)).collect::<Vec<_>>()));
        if !self.warnings.is_empty() {
            lines.push(String::new());
            lines.extend(self.warnings.iter().map(|warning| format!("  {warning}")));
        }
        lines
    }
}

fn joint(joint: &Joint) -> JointLine {
    let finite = |value: f64| Some(value).filter(|value| value.is_finite());
    JointLine {
        name: joint.name.clone(),
        kind: match joint.kind {
            JointKind::Revolute => "revolute",
            JointKind::Continuous => "continuous",
            JointKind::Prismatic => "prismatic",
        },
        lower: finite(joint.lower),
        upper: finite(joint.upper),
        velocity_limit: finite(joint.velocity_limit),
        effort_limit: finite(joint.effort_limit),
        mimic: joint.mimic.is_some(),
    }
}
