//! `cpdmp sweep`: many runs of one scenario, one row per run.

use std::path::{Path, PathBuf};

use super::args::{Format, Global};
use super::failure::Failure;
use super::judged_run::judged_run;
use super::load::options;
use super::progress::Clock;
use super::sweep_args::SweepArguments;
use super::sweep_progress::SweepProgress;
use super::sweep_report::SweepReport;
use super::sweep_text;
use super::terminal::Terminal;
use super::validate::beyond_the_file;
use crate::batch::{BatchError, NotReady, Plan, Row, Runner, Shard, Summary, SweepFolder, Terms, execute};
use crate::report::{Outcome, RunReport};
use crate::scenario::{Member, Scenario, Sweep, SweepOptions};

/// Checks every member, then runs those that have no row yet. The worst outcome counts.
pub(super) fn sweep(arguments: &SweepArguments, global: &Global, terminal: &Terminal) -> Outcome {
    let plan = match checked(arguments, global, terminal) {
        Ok(plan) => plan,
        Err(outcome) => return outcome,
    };
    if arguments.dry_run {
        return tell_plan(&plan, arguments.shard, terminal);
    }
    if arguments.shard.size(plan.members) == 0 {
        let (shard, many) = (arguments.shard, plan.members);
        terminal.note(&format!("shard {shard} of {many} members has none: there is nothing to run, and its table has no rows\n"));
    }
    match run(&plan, arguments, global, terminal) {
        Ok((table, summary)) => {
            tell(&plan, arguments.shard, &table, &summary, terminal);
            summary.worst
        }
        Err(error) => Failure::new(error.outcome(), [error.to_string()]).tell(terminal),
    }
}

/// The sweep, every member of which can be run.
fn checked(arguments: &SweepArguments, global: &Global, terminal: &Terminal) -> Result<Plan, Outcome> {
    let stop = |outcome, text: String| Failure::new(outcome, [text]);
    let path = arguments.path.display();
    let asked = SweepOptions { grid: arguments.grid.clone(), repeat: arguments.repeat };
    let sweep = match Sweep::load(&arguments.path, &options(global), &asked) {
        Ok(sweep) => sweep,
        Err(invalid) => {
            let failure = stop(Outcome::InvalidInput, format!("{path}: the sweep cannot be used, nothing was run"));
            return Err(failure.because(invalid.0).tell(terminal));
        }
    };
    match sweep.members() {
        0 => {
            let help = "give the file a [[sweep]] with values, or use --grid KEY=a,b,c or --repeat N";
            Err(stop(Outcome::NothingSelected, format!("the sweep of {path} has no members: {help}")).tell(terminal))
        }
        many if many > arguments.max_runs => {
            let (most, help) = (arguments.max_runs, "make its grids smaller, or allow it with --max-runs");
            Err(stop(Outcome::InvalidInput, format!("the sweep of {path} has {many} members, more than {most}: {help}")).tell(terminal))
        }
        many => {
            terminal.note(&format!("checking {many} members of {path}\n"));
            let ready = |scenario: &Scenario| match beyond_the_file(scenario) {
                Err((_, located)) => Err(located.text()),
                Ok(odd) if global.deny_warnings && !odd.lines().is_empty() => Err(format!("--deny-warnings: {}", odd.lines().join("\n"))),
                Ok(_) => Ok(()),
            };
            let terms = Terms { limit: global.timeout, deny_warnings: global.deny_warnings };
            let plan = Plan::check(sweep, &terms, &ready).map_err(|not_ready| tell_not_ready(&arguments.path, &not_ready, terminal))?;
            // What is odd about the file is so in all members: it is told of the first.
            plan.member(0).iter().for_each(|member| terminal.faults(&member.scenario.warnings));
            Ok(plan)
        }
    }
}

/// Runs what is missing and writes the table.
fn run(plan: &Plan, arguments: &SweepArguments, global: &Global, terminal: &Terminal) -> Result<(PathBuf, Summary), BatchError> {
    let place = global.out.clone().unwrap_or_else(|| default_folder(plan, arguments.shard));
    let mut folder = SweepFolder::open(&place, plan, arguments.shard, arguments.resume, std::env::args().collect())?;
    if folder.log.damaged > 0 {
        terminal.error(&format!("warning: {} damaged rows in {}: these runs are made again\n", folder.log.damaged, place.display()));
    }
    let runner =
        Runner { run: &|scenario| judged(scenario, global), command: &|member| command(member, &plan.scenario, &arguments.path, global) };
    let threads = global.jobs.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let progress = SweepProgress::new(terminal, folder.log.rows, arguments.shard.size(plan.members));
    let mut told = |row: &Row, pace| progress.row(row, pace, global.verbose > 0);
    let done = execute(plan, arguments.shard, &mut folder, &runner, threads, &mut told);
    drop(progress);
    done?;
    folder.finish(plan, arguments.shard)
}

fn judged(scenario: &Scenario, global: &Global) -> RunReport {
    let mut report = judged_run(scenario, &Clock::with_limit(global.timeout)).report;
    if global.deny_warnings {
        report.deny_warnings();
    }
    report
}

fn default_folder(plan: &Plan, shard: Shard) -> PathBuf {
    let part = if shard.is_whole() { String::new() } else { format!("-{}", shard.in_name()) };
    Path::new("sweeps").join(format!("{}{part}", plan.scenario))
}

/// The command that runs one member alone, for a shell.
fn command(member: &Member, name: &str, path: &Path, global: &Global) -> String {
    let mut words = vec!["cpdmp".to_owned(), "run".to_owned(), path.display().to_string()];
    let mut flag = |name: &str, value: &str| words.extend([name.to_owned(), value.to_owned()]);
    global.set.iter().chain(&member.overrides).for_each(|typed| flag("--set", typed));
    global.robot.iter().for_each(|robot| flag("--robot", robot));
    global.asset_root.iter().for_each(|folder| flag("--asset-root", &folder.display().to_string()));
    global.timeout.iter().for_each(|limit| flag("--timeout", &limit.as_secs_f64().to_string()));
    flag("--seed", &member.scenario.work.seed().to_string());
    flag("--out", &format!("runs/{name}-sweep/{}", member.index));
    words.extend(global.lenient.then(|| "--lenient".to_owned()));
    words.extend(global.deny_warnings.then(|| "--deny-warnings".to_owned()));
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

/// The word as a shell takes it.
pub(super) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./:=,+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

fn tell_not_ready(path: &Path, not_ready: &NotReady, terminal: &Terminal) -> Outcome {
    let outcome = Outcome::InvalidInput;
    let told = not_ready.refused.iter().map(|(index, reason)| format!("member {index}: {reason}"));
    let mut lines: Vec<String> = told.collect();
    if terminal.format == Format::Human {
        for member in &not_ready.invalid {
            terminal.error(&format!("member {} ({}):\n", member.index, member.settings));
            terminal.faults(&member.invalid.0);
        }
    } else {
        lines.extend(not_ready.invalid.iter().map(ToString::to_string));
    }
    lines.push(format!("{}: {} members of the sweep cannot be run, nothing was run", path.display(), not_ready.faulty));
    Failure::new(outcome, lines).tell(terminal)
}

fn tell(plan: &Plan, shard: Shard, table: &Path, summary: &Summary, terminal: &Terminal) {
    match terminal.format {
        Format::Human => {
            terminal.result(&sweep_text::text(&plan.scenario, summary));
            terminal.note(&format!("written to {}\n", table.display()));
        }
        Format::Json => terminal.json(&SweepReport::of(plan, shard).done(table, summary)),
    }
}

fn tell_plan(plan: &Plan, shard: Shard, terminal: &Terminal) -> Outcome {
    let of = if shard.is_whole() { String::new() } else { format!(", {} of them in shard {shard}", shard.size(plan.members)) };
    match terminal.format {
        Format::Human => terminal.result(&format!("{}: {} members{of}, all can be run\n", plan.scenario, plan.members)),
        Format::Json => terminal.json(&SweepReport::of(plan, shard)),
    }
    Outcome::Passed
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn a_shell_gets_the_word_that_was_meant() {
        for word in ["plain", "a=0.5", "two words", "it's", "", "a=\"b\"", "$HOME;*", "[1, 2]"] {
            let output = std::process::Command::new("sh").arg("-c").arg(format!("printf %s {}", quoted(word))).output().expect("a shell");
            assert_eq!(String::from_utf8_lossy(&output.stdout), word);
        }
        assert_eq!(quoted("a=0.5"), "a=0.5");
    }
}
