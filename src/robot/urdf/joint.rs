//! The structural check of joints.

use roxmltree::Node;

use super::elements::Check;
use super::outline::child;

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
            Some("revolute" | "prismatic" | "continuous") => self.moving(joint, kind == Some("continuous")),
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

    fn moving(&mut self, joint: Node<'_, '_>, continuous: bool) {
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
            Some(limit) => self.limit(limit, continuous),
            None if continuous => {}
            None => self.error(joint, "has no <limit>", "give lower, upper, effort and velocity"),
        }
    }

    fn limit(&mut self, limit: Node<'_, '_>, continuous: bool) {
        for name in ["effort", "velocity"] {
            if limit.attribute(name).is_none() {
                self.error(limit, format!("has no `{name}`"), "");
            } else if self.not_negative(limit, name) == Some(0.0) {
                self.warning(limit, format!("`{name}` is zero: the joint cannot be moved"), "");
            }
        }
        let range = ["lower", "upper"].map(|name| self.optional_number(limit, name));
        if continuous {
            return;
        }
        if limit.attribute("lower").is_none() && limit.attribute("upper").is_none() {
            return self.error(limit, "has neither `lower` nor `upper`", "give the range, or use type continuous");
        }
        let [lower, upper] = range.map(|bound| bound.unwrap_or(0.0));
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
