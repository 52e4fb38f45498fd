//! A sweep: one scenario, run again and again with other values of some of its keys.
//!
//! What varies is said by `[[sweep]]` in the file and by flags. Every entry is a direction of its own; a member of the sweep is one point in
//! each of them, counted with the last direction varying fastest. A member is the scenario with the values of its points put over the file,
//! so it is read, checked and explained exactly as a scenario with `--set` is.

use std::path::Path;

use super::conform::Conform;
use super::diagnostic::{InvalidScenario, diagnose, in_order};
use super::fault::{Fault, Place, Severity, deny_warnings, tolerate_unknown_keys};
use super::key::{Key, Kind, Shape};
use super::load::{LoadOptions, Scenario, fill, layered};
use super::overrides::{self, steps};
use super::roots::Roots;
use super::schema_sweep::SWEEP;
use super::source::{Origin, Sources};
use super::sweep_axis::{Axis, Draw};
use super::sweep_checks::{contradictions, is_decided};
use super::sweep_flags;
use super::sweep_member::{InvalidMember, Member, Setting, override_of};
use super::tree::{Node, Value};

/// The part of a scenario that says what varies.
const ONLY_SWEEP: Shape = Shape::plain(&[Key::new("sweep", Kind::List(SWEEP), "what varies from run to run").or_empty()]);

/// What the user says about a sweep besides the file; a key that the file varies too varies as it is said here.
#[derive(Clone, Debug, Default)]
pub struct SweepOptions {
    /// `KEY=a,b,c` each.
    pub grid: Vec<String>,
    /// How many seeds, from the scenario's seed on.
    pub repeat: Option<u64>,
}

/// A scenario and what varies in it.
#[derive(Debug)]
pub struct Sweep {
    tree: Node,
    sources: Sources,
    roots: Roots,
    pub(super) axes: Vec<Axis>,
    lenient: bool,
    deny_warnings: bool,
}

impl Sweep {
    /// Reads a scenario file and what varies in it. Members are checked one by one, by [`Sweep::member`].
    ///
    /// # Errors
    /// Every fault of the file's text, of the overrides, and of what says how the scenario varies.
    pub fn load(path: &Path, options: &LoadOptions, sweep: &SweepOptions) -> Result<Self, InvalidScenario> {
        Self::read(path, options, sweep, false)
    }

    /// What still varies in a file when flags may decide what varies in it.
    pub(super) fn load_decided(path: &Path, options: &LoadOptions) -> Result<Self, InvalidScenario> {
        Self::read(path, options, &SweepOptions::default(), true)
    }

    fn read(path: &Path, options: &LoadOptions, sweep: &SweepOptions, may_decide: bool) -> Result<Self, InvalidScenario> {
        let mut sources = Sources::default();
        let mut faults = Vec::new();
        let Some((mut tree, roots)) = layered(path, options, &mut sources, &mut faults) else {
            return Err(InvalidScenario(diagnose(faults, &sources)));
        };
        let seed = base_seed(&tree);
        let mut axes = typed_axes(&mut tree, seed, &mut sources, &roots, &mut faults);
        let flags: Vec<Axis> = sweep.grid.iter().filter_map(|typed| sweep_flags::grid(typed, &mut sources, &mut faults)).collect();
        let repeat = sweep.repeat.map(|count| sweep_flags::repeat(count, seed, &mut sources));
        for axis in flags.into_iter().chain(repeat) {
            add(&mut axes, axis, &tree, &sources);
        }
        if may_decide {
            axes.iter_mut().for_each(|axis| axis.keys.retain(|key| !is_decided(key, &tree, options)));
            axes.retain(|axis| !axis.keys.is_empty());
        }
        faults.extend(contradictions(&axes, &tree, options));
        if options.lenient {
            tolerate_unknown_keys(&mut faults);
        }
        if options.deny_warnings {
            deny_warnings(&mut faults);
        }
        let refused: Vec<Place> = faults.iter().map(|fault| fault.place.clone()).collect();
        let diagnostics = diagnose(faults, &sources);
        let mut sweep = Self { tree, sources, roots, axes, lenient: options.lenient, deny_warnings: options.deny_warnings };
        if diagnostics.iter().all(|found| found.severity == Severity::Warning) {
            return Ok(sweep);
        }
        // What is wrong with the other directions and with the file is told in the same pass.
        sweep.axes.retain(|axis| !axis.keys.iter().any(|key| refused.contains(&Place::Text(key.origin))));
        Err(InvalidScenario(in_order(diagnostics.into_iter().chain(sweep.faults()).collect())))
    }

    /// How many members there are; 0 when nothing varies.
    pub fn members(&self) -> u64 {
        if self.axes.is_empty() {
            return 0;
        }
        self.axes.iter().fold(1, |count: u64, axis| count.saturating_mul(axis.points))
    }

    /// The keys that vary, besides the seed, in the order in which they were typed.
    pub fn keys(&self) -> Vec<&str> {
        self.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.name.as_str()).filter(|key| *key != "seed").collect()
    }

    /// Member number `index`, checked.
    ///
    /// # Errors
    /// Every fault of the scenario that its values make, at the place where they were typed.
    pub fn member(&self, index: u64) -> Result<Member, Box<InvalidMember>> {
        self.member_at(index, &self.points(index))
    }

    /// The member with these points of the directions.
    pub(super) fn member_at(&self, index: u64, points: &[u64]) -> Result<Member, Box<InvalidMember>> {
        let values = self.values(points);
        let mut tree = self.tree.clone();
        let mut faults = Vec::new();
        for (key, origin, value) in &values {
            faults.extend(overrides::put(&mut tree, key, *origin, value.clone()).err());
        }
        let filled = fill(tree, &self.sources, &self.roots, &mut faults);
        if self.lenient {
            tolerate_unknown_keys(&mut faults);
        }
        if self.deny_warnings {
            deny_warnings(&mut faults);
        }
        let varied = || values.iter().filter(|(key, ..)| *key != "seed");
        let overrides = varied().map(|(key, _, node)| override_of(key, node, &filled)).collect();
        match Scenario::of(Some(filled), faults, &self.sources) {
            Ok(scenario) => {
                let settings = varied().map(|(key, _, node)| ((*key).to_owned(), Setting::of(node))).collect();
                Ok(Member { index, settings, overrides, scenario })
            }
            Err(invalid) => {
                let told = |(key, _, node): &(&str, Origin, Node)| format!("{key}={}", super::resolved::literal(node));
                let settings = values.iter().map(told).collect::<Vec<_>>().join(", ");
                Err(Box::new(InvalidMember { index, settings, invalid }))
            }
        }
    }

    /// The point of member number `index` in every direction.
    fn points(&self, index: u64) -> Vec<u64> {
        let mut rest = index;
        let mut points = vec![0; self.axes.len()];
        for (point, axis) in points.iter_mut().zip(&self.axes).rev() {
            *point = rest % axis.points;
            rest /= axis.points;
        }
        points
    }

    /// The value of every key at these points of the directions; a direction without points has none.
    fn values(&self, points: &[u64]) -> Vec<(&str, Origin, Node)> {
        let both = self.axes.iter().zip(points).filter(|(axis, point)| **point < axis.points);
        both.flat_map(|(axis, point)| axis.keys.iter().map(move |key| (key.name.as_str(), key.origin, key.value(*point)))).collect()
    }
}

/// The seed from which draws and repetitions start. One that makes no sense is told when the members are checked.
fn base_seed(tree: &Node) -> u64 {
    match tree.get("seed").map(|node| &node.value) {
        Some(Value::Integer(seed)) => u64::try_from(*seed).unwrap_or(0),
        _ => 0,
    }
}

/// Takes `[[sweep]]` out of the tree and reads it.
fn typed_axes(tree: &mut Node, seed: u64, sources: &mut Sources, roots: &Roots, faults: &mut Vec<Fault>) -> Vec<Axis> {
    let Some(mut entry) = tree.take("sweep") else { return Vec::new() };
    lift(&mut entry.node, sources);
    let alone = Node::new(Value::Table(vec![entry]), tree.origin);
    let filled = Conform { sources, roots, faults }.table(alone, &ONLY_SWEEP, "");
    let axis = |(number, table): (usize, &Node)| {
        let drawn = |draw| Axis::drawn(draw, &table.section("ranges"), table.count("count"), seed, number as u64);
        match table.text("kind") {
            "grid" => table.get("key").map(|key| Axis::listed(table.text("key"), key.origin, table.section("values").items().to_vec())),
            "uniform" => Some(drawn(Draw::Uniform)),
            "latin_hypercube" => Some(drawn(Draw::LatinHypercube)),
            "repeat" => table.get("count").map(|count| Axis::seeds(seed, table.count("count"), count.origin)),
            _ => None,
        }
    };
    filled.tables("sweep").iter().enumerate().filter_map(axis).collect()
}

/// Moves a table to the layer of what a sweep varies.
fn lift(node: &mut Node, sources: &mut Sources) {
    node.origin = sources.swept(node.origin);
    match &mut node.value {
        Value::List(items) => items.iter_mut().for_each(|item| lift(item, sources)),
        Value::Table(entries) => entries.iter_mut().for_each(|entry| {
            entry.origin = sources.swept(entry.origin);
            lift(&mut entry.node, sources);
        }),
        _ => {}
    }
}

/// Adds a direction of the command line. The file says no more about its keys.
fn add(axes: &mut Vec<Axis>, axis: Axis, tree: &Node, sources: &Sources) {
    let told: Vec<Vec<String>> = axis.keys.iter().map(|key| steps(tree, &key.name)).collect();
    for typed in axes.iter_mut() {
        let told = |name: &str| told.contains(&steps(tree, name));
        typed.keys.retain(|key| sources.is_override(key.origin) || !told(&key.name));
    }
    axes.retain(|typed| !typed.keys.is_empty());
    axes.push(axis);
}
