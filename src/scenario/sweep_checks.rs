//! What keeps a sweep from being run, before its members are checked one by one.

use std::path::Path;

use super::diagnostic::Diagnostic;
use super::fault::{Code, Fault, Severity};
use super::load::LoadOptions;
use super::overrides::steps;
use super::sweep::Sweep;
use super::sweep_axis::{Axis, AxisKey};
use super::tree::Node;

/// Most members that are looked at without being asked for.
const LOOKED_AT: usize = 200;

impl Sweep {
    /// What keeps members from being run as far as their scenarios' text says it: the values of every direction, each with the first values of the
    /// others, and no more than [`LOOKED_AT`] of them.
    pub(super) fn faults(&self) -> Vec<Diagnostic> {
        let first = vec![0; self.axes.len()];
        let along = |axis: usize| {
            let first = &first;
            (1..self.axes[axis].points).map(move |point| {
                let mut points = first.clone();
                points[axis] = point;
                points
            })
        };
        let looked_at = std::iter::once(first.clone()).chain((0..self.axes.len()).flat_map(along)).take(LOOKED_AT);
        let invalid = looked_at.filter_map(|points| self.member_at(0, &points).err());
        let mut found: Vec<Diagnostic> = Vec::new();
        for fault in invalid.flat_map(|member| member.invalid.0) {
            if fault.severity == Severity::Error && !found.contains(&fault) {
                found.push(fault);
            }
        }
        found
    }
}

/// What keeps the `[[sweep]]` of a file from being run. Nothing in a file that has none. A flag may mend a file; one that makes a single run of it
/// decides what otherwise varies; and what only flags make wrong in other members is no fault of a file that is good without them, unless they are
/// about the sweep itself.
pub(super) fn faults_of_file(path: &Path, options: &LoadOptions) -> Vec<Diagnostic> {
    let faults = |options: &LoadOptions| match Sweep::load_decided(path, options) {
        Ok(sweep) if sweep.axes.is_empty() => Vec::new(),
        Ok(sweep) => sweep.faults(),
        Err(invalid) => invalid.0,
    };
    let found = faults(&LoadOptions { deny_warnings: false, ..options.clone() });
    let about_sweep = options.set.iter().any(|typed| typed.trim_start().starts_with("sweep"));
    if found.is_empty() || about_sweep || !faults(&options.without_overrides()).is_empty() { found } else { Vec::new() }
}

/// Whether a flag gives a key of a sweep its one value.
pub(super) fn is_decided(key: &AxisKey, tree: &Node, options: &LoadOptions) -> bool {
    let place = steps(tree, &key.name);
    let mut set = options.set.iter().filter_map(|typed| Some(steps(tree, typed.split_once('=')?.0)));
    // Repetitions begin at the seed of `--seed`; listed seeds leave it nothing to say.
    let seeded = key.name == "seed" && options.seed.is_some() && key.is_listed();
    let robot = || within(&["robot", "urdf"].map(str::to_owned), &place);
    set.any(|set| within(&set, &place)) || seeded || (options.robot.is_some() && robot())
}

/// One within the other: whichever is put in place last would change what the other says.
fn within(a: &[String], b: &[String]) -> bool {
    a.starts_with(b) || b.starts_with(a)
}

/// Keys that two entries vary, or that something else decides.
pub(super) fn contradictions(axes: &[Axis], tree: &Node, options: &LoadOptions) -> Vec<Fault> {
    let keys: Vec<_> = axes.iter().flat_map(|axis| &axis.keys).collect();
    let places: Vec<Vec<String>> = keys.iter().map(|key| steps(tree, &key.name)).collect();
    let mut faults = Vec::new();
    for (index, key) in keys.iter().enumerate() {
        let mut refuse = |message: String, expected: &str| faults.push(Fault::at(Code::Conflict, key.origin, message).expected(expected));
        let first = key.name.split('.').next().unwrap_or_default();
        if ["extends", "sweep", "schema_version", "name"].contains(&first) {
            refuse(format!("`{}` cannot vary in a sweep", key.name), "a key that says something about the experiment");
        }
        if places[..index].iter().any(|earlier| within(earlier, &places[index])) {
            refuse(format!("`{}` varies twice", key.name), "one entry of the sweep per key");
        }
        if is_decided(key, tree, options) {
            refuse(format!("`{}` varies, but a flag gives it one value", key.name), "one of the two");
        }
        if let Some(again) = key.repeated() {
            let fault = Fault::at(Code::Conflict, again.origin, format!("this value of `{}` is listed twice", key.name));
            faults.push(fault.expected("every value once: --repeat N runs every member with N seeds"));
        }
    }
    faults
}
