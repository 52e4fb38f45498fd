//! The structural check of joints.

use roxmltree::Node;

use super::elements::Check;
use super::outline::child;

/// Angle beyond which a joint's limit is probably in degrees (rad): two turns.
const MOST_TURNED_RAD: f64 = 4.0 * std::f64::consts::PI;
/// Way beyond which a joint's limit is probably in millimetres (m).
const FARTHEST_SLID_M: f64 = 20.0;

impl Check<'_> {
    pub(super) fn joint(&mut self, joint: Node<'_, '_>) {
        self.named(joint);
        let parts = ["origin", "parent", "child", "axis", "limit", "dynamics", "mimic"];
        self.at_most_one(joint, &parts);
        self.origin(joint);
        for end in ["parent", "child"] {
            match child(joint, end) {
                Some(node) if node.attribute("link").is_some() => {}
                Some(node) => self.error(node, "has no `link`", ""),
                None => self.error(joint, format!("has no <{end}>"), ""),
            }
        }
        let kind = joint.attribute("type");
        match kind {
            Some("fixed") => {}
            Some(kind @ ("revolute" | "prismatic" | "continuous")) => self.moving(joint, kind),
            Some("floating" | "planar" | "spherical") => {
                self.error(joint, "only joints with one degree of freedom can be simulated", "use a chain of them");
            }
            Some(other) => {
                let help = "known types: revolute, continuous, prismatic, fixed";
                self.error(joint, format!("unknown type `{other}`"), help);
            }
            None => self.error(joint, "has no `type`", ""),
        }
    }

    fn moving(&mut self, joint: Node<'_, '_>, kind: &str) {
        if let Some(axis) = child(joint, "axis")
            && self.required(axis, "xyz", 3).is_some_and(|axis| axis.iter().all(|part| part.abs() < 1e-9))
        {
            self.error(axis, "the axis has no direction", "");
        }
        if let Some(dynamics) = child(joint, "dynamics") {
            for name in ["damping", "friction"] {
                self.not_negative(dynamics, name);
            }
        }
        if let Some(mimic) = child(joint, "mimic") {
            self.optional_number(mimic, "multiplier");
            self.optional_number(mimic, "offset");
            if mimic.attribute("joint").is_none() {
                self.error(mimic, "has no `joint`", "");
            }
        }
        match child(joint, "limit") {
            Some(limit) => self.limit(limit, kind),
            None if kind == "continuous" => {}
            None => self.error(joint, "has no <limit>", "give lower, upper, effort and velocity"),
        }
    }

    fn limit(&mut self, limit: Node<'_, '_>, kind: &str) {
        for name in ["effort", "velocity"] {
            if limit.attribute(name).is_none() {
                self.error(limit, format!("has no `{name}`"), "");
            } else if self.not_negative(limit, name) == Some(0.0) {
                self.warning(limit, format!("`{name}` is zero: the joint cannot be moved"), "");
            }
        }
        let range = ["lower", "upper"].map(|name| self.optional_number(limit, name));
        if kind == "continuous" {
            if range.iter().flatten().any(|bound| *bound != 0.0) {
                self.warning(limit, "a continuous joint turns without end: its `lower` and `upper` are left aside", "use type revolute");
            }
            return;
        }
        if limit.attribute("lower").is_none() && limit.attribute("upper").is_none() {
            return self.error(limit, "has neither `lower` nor `upper`", "give the range, or use type continuous");
        }
        let [lower, upper] = range.map(|bound| bound.unwrap_or(0.0));
        let widest = lower.abs().max(upper.abs());
        if kind == "revolute" && widest > MOST_TURNED_RAD {
            self.warning(limit, format!("the joint turns as far as {widest} rad, which looks like degrees"), "limits are in radians");
        } else if kind == "prismatic" && widest > FARTHEST_SLID_M {
            self.warning(limit, format!("the joint slides as far as {widest} m, which looks like millimetres"), "limits are in metres");
        }
        if lower > upper {
            self.error(limit, format!("lower ({lower}) is greater than upper ({upper})"), "swap them");
        } else if lower == upper {
            self.warning(limit, format!("the range is the single position {lower}"), "use type fixed");
        }
    }

    fn not_negative(&mut self, node: Node<'_, '_>, attribute: &str) -> Option<f64> {
        let number = self.optional_number(node, attribute)?;
        if number < 0.0 {
            self.error(node, format!("`{attribute}` is negative: {number}"), "");
        }
        Some(number)
    }
}
