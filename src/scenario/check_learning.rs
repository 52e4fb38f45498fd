//! Settings of `[learning]` that mean nothing beside each other.

use super::fault::{Code, Fault};
use super::tree::Node;

/// The baseline's ends, told about while there is no baseline. The default says nothing: a resolved scenario has it.
pub(super) fn ends_of_no_baseline(learning: &Node, faults: &mut Vec<Fault>) {
    if let Some(ends) = learning.get("lwr_ends")
        && ends.as_text() == Some("regression")
        && learning.text("shaping") == "phmm"
    {
        let fault = Fault::at(Code::Conflict, ends.origin, "`learning.lwr_ends` means nothing with shaping = \"phmm\"");
        faults.push(fault.expected("shaping = \"lwr\", the baseline: the paper's model always has its ends from theta_m").warning());
    }
}
