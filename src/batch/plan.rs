//! A sweep that can be run: every member was checked before the first one begins.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Duration;

use rayon::prelude::*;
use twox_hash::XxHash3_64;

use super::{Cell, CellKind};
use crate::report::hash_file;
use crate::scenario::{InvalidMember, Member, Scenario, Sweep};

/// Members that are checked before what they have in common is kept: so much is in memory at a time.
const CHUNK: u64 = 1024;

/// Faulty members that are told in full.
const TOLD: usize = 10;

/// A sweep that can be run.
#[derive(Debug)]
pub struct Plan {
    sweep: Sweep,
    /// Name of the scenario.
    pub scenario: String,
    /// How many members there are.
    pub members: u64,
    /// The keys that vary, with what their values are.
    pub keys: Vec<(String, CellKind)>,
    /// Names of the scenario's criteria.
    pub criteria: Vec<String>,
    /// Which sweep it is: over the program's version, the terms, every member's resolved scenario and the files that decide them, in
    /// hexadecimal.
    pub hash: String,
}

/// What is asked of every run besides its scenario.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Terms {
    /// How long it may take.
    pub limit: Option<Duration>,
    /// Whether one that warns of something is one that is not as expected.
    pub deny_warnings: bool,
}

/// Why a sweep cannot be run.
#[derive(Clone, Debug, PartialEq)]
pub struct NotReady {
    /// How many members are faulty.
    pub faulty: u64,
    /// The first of them, none with the same faults as an earlier one.
    pub invalid: Vec<InvalidMember>,
    /// The first of those whose scenario is good but whose robot, dataset or scene is not: number and what is wrong.
    pub refused: Vec<(u64, String)>,
}

/// What is kept of one member.
struct Checked {
    hash: u64,
    name: String,
    kinds: Vec<Option<CellKind>>,
    criteria: Vec<String>,
    inputs: Vec<PathBuf>,
}

/// Why one member cannot be run.
enum Fault {
    Invalid(Box<InvalidMember>),
    Refused(u64, String),
}

impl Plan {
    /// Checks every member of `sweep`, each of which is run under `terms`, on all threads; `ready` looks at what is beyond the scenario's text,
    /// and says what is wrong with it.
    ///
    /// # Errors
    /// What is wrong with which members.
    pub fn check(sweep: Sweep, terms: &Terms, ready: &(dyn Fn(&Scenario) -> Result<(), String> + Sync)) -> Result<Self, Box<NotReady>> {
        let members = sweep.members();
        let mut sum = Sum { not_ready: NotReady { faulty: 0, invalid: Vec::new(), refused: Vec::new() }, ..Sum::default() };
        for start in (0..members).step_by(CHUNK as usize) {
            let chunk = start..members.min(start + CHUNK);
            let checked: Vec<Result<Checked, Fault>> = chunk.into_par_iter().map(|index| check(&sweep, index, ready)).collect();
            for (index, checked) in (start..).zip(checked) {
                sum.add(index, checked);
            }
        }
        if sum.not_ready.faulty > 0 {
            return Err(Box::new(sum.not_ready));
        }
        let keys = sweep.keys().into_iter().map(str::to_owned);
        let keys = keys.zip(&sum.kinds).map(|(key, kind)| (key, kind.unwrap_or(CellKind::Text))).collect();
        let hash = sum.hash(terms);
        Ok(Self { sweep, scenario: sum.name, members, keys, criteria: sum.criteria, hash })
    }

    /// Member number `index`.
    ///
    /// # Errors
    /// When a file that it names has gone since it was checked.
    pub fn member(&self, index: u64) -> Result<Member, Box<InvalidMember>> {
        self.sweep.member(index)
    }
}

fn check(sweep: &Sweep, index: u64, ready: &(dyn Fn(&Scenario) -> Result<(), String> + Sync)) -> Result<Checked, Fault> {
    let member = sweep.member(index).map_err(Fault::Invalid)?;
    ready(&member.scenario).map_err(|reason| Fault::Refused(index, reason))?;
    Ok(Checked {
        hash: XxHash3_64::oneshot(member.scenario.resolved.as_bytes()),
        name: member.scenario.work.name().to_owned(),
        kinds: member.settings.iter().map(|(_, setting)| Cell::from(setting).kind()).collect(),
        criteria: member.scenario.criteria.iter().map(|criterion| criterion.name.clone()).collect(),
        inputs: member.scenario.work.inputs(),
    })
}

/// What all members have in common.
struct Sum {
    not_ready: NotReady,
    name: String,
    members: XxHash3_64,
    kinds: Vec<Option<CellKind>>,
    criteria: Vec<String>,
    inputs: BTreeSet<PathBuf>,
}

impl Default for Sum {
    fn default() -> Self {
        let not_ready = NotReady { faulty: 0, invalid: Vec::new(), refused: Vec::new() };
        let members = XxHash3_64::with_seed(0);
        Self { not_ready, name: String::new(), members, kinds: Vec::new(), criteria: Vec::new(), inputs: BTreeSet::new() }
    }
}

impl Sum {
    fn add(&mut self, index: u64, checked: Result<Checked, Fault>) {
        match checked {
            Err(fault) => self.refuse(fault),
            Ok(member) if self.kinds.is_empty() && self.name.is_empty() => self.begin(member),
            Ok(member) if member.criteria != self.criteria => {
                let what = "its criteria have other names than those of the members before it: a table needs the same columns in every row";
                self.refuse(Fault::Refused(index, what.to_owned()));
            }
            Ok(member) => self.go_on(member),
        }
    }

    fn begin(&mut self, first: Checked) {
        self.name = first.name.clone();
        self.kinds = vec![None; first.kinds.len()];
        self.criteria = first.criteria.clone();
        self.go_on(first);
    }

    fn go_on(&mut self, member: Checked) {
        std::hash::Hasher::write_u64(&mut self.members, member.hash);
        for (kind, found) in self.kinds.iter_mut().zip(member.kinds) {
            *kind = match (*kind, found) {
                (Some(kind), Some(found)) => Some(kind.with(found)),
                (kind, found) => kind.or(found),
            };
        }
        self.inputs.extend(member.inputs);
    }

    fn refuse(&mut self, fault: Fault) {
        let told = &mut self.not_ready;
        told.faulty += 1;
        match fault {
            Fault::Invalid(member) if told.invalid.len() < TOLD && !told.invalid.iter().any(|other| other.invalid == member.invalid) => {
                told.invalid.push(*member);
            }
            Fault::Refused(index, reason) if told.refused.len() < TOLD && !told.refused.iter().any(|(_, other)| *other == reason) => {
                told.refused.push((index, reason));
            }
            _ => {}
        }
    }

    /// Which sweep it is.
    fn hash(&self, terms: &Terms) -> String {
        let files: Vec<String> = self.inputs.iter().map(|path| format!("{:?}", hash_file(path).xxh3_64)).collect();
        let members = std::hash::Hasher::finish(&self.members);
        let limit = terms.limit.map_or_else(String::new, |limit| format!(" within {limit:?}"));
        let warnings = if terms.deny_warnings { " without warnings" } else { "" };
        let all = format!("{} {members:016x} {}{limit}{warnings}", env!("CARGO_PKG_VERSION"), files.join(" "));
        format!("{:016x}", XxHash3_64::oneshot(all.as_bytes()))
    }
}
