//! The terminal: arguments, progress, results, exit codes. One file per command.
//!
//! Results go to stdout, progress and complaints to stderr. What a command finds ends in an [`Outcome`], which is its exit code. A closed
//! pipe is no error, and a panic is a bug that is reported as one.

mod args;
mod beginning;
mod beside;
mod changed_scene;
mod check;
mod check_motion;
mod check_run;
mod check_target;
mod completions;
mod examples;
mod explain;
mod failure;
mod figure_files;
mod figures;
mod files;
mod generate;
mod generate_request;
mod global_args;
mod global_flags;
mod inspect;
mod judged_run;
mod learn;
mod learning_args;
mod list;
mod load;
mod located;
mod man;
mod merge;
mod migrate;
mod outside;
mod planar_files;
mod progress;
mod recorded_run;
mod repetition;
mod replay;
mod replay_report;
mod room;
mod run;
mod schema;
mod select;
mod sweep;
mod sweep_args;
mod sweep_progress;
mod sweep_report;
mod sweep_text;
mod teach;
mod terminal;
mod validate;
mod view;
mod viewer;
#[cfg(feature = "rerun")]
mod watched;
#[cfg(feature = "web-viewer")]
mod web_page;

use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::FromArgMatches;

use self::args::{Cli, Command};
use self::failure::Failure;
use self::terminal::Terminal;
use crate::report::Outcome;

/// The whole program: reads the command line, does what it says, and returns the exit code.
pub fn main() -> ExitCode {
    std::panic::set_hook(Box::new(report_bug));
    let outcome = std::panic::catch_unwind(|| match typed() {
        Ok((cli, without_effect)) => dispatch(&cli, without_effect),
        Err(error) => told_by_clap(&error),
    });
    if let Ok(Outcome::Usage) = outcome {
        check::withdraw_verdict(std::env::args_os().skip(1));
    }
    ExitCode::from(outcome.unwrap_or(Outcome::InternalError).exit_code())
}

/// The command line, and what was typed in vain.
fn typed() -> Result<(Cli, Vec<String>), clap::Error> {
    let matches = global_flags::command().try_get_matches()?;
    let cli = Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut global_flags::command()))?;
    Ok((cli, global_flags::without_effect(&matches)))
}

fn dispatch(cli: &Cli, without_effect: Vec<String>) -> Outcome {
    let terminal = Terminal::new(&cli.global);
    if !without_effect.is_empty() {
        return Failure::new(Outcome::Usage, without_effect).tell(&terminal);
    }
    if cli.global.format.is_for_verdicts() && !matches!(cli.command, Command::Check(_)) {
        terminal.error("error: --format junit and --format github are for cpdmp check: this command prints human or json\n");
        return Outcome::Usage;
    }
    if let Some(jobs) = cli.global.jobs {
        // Fails only when the pool is there already, and then nobody has asked for another size.
        _ = rayon::ThreadPoolBuilder::new().num_threads(jobs).build_global();
    }
    let outcome = match &cli.command {
        Command::Run(arguments) => run::run(arguments, &cli.global, &terminal),
        Command::Check(arguments) => check::check(arguments, &cli.global, &terminal),
        Command::Validate(arguments) => validate::validate(&arguments.paths, &cli.global, &terminal),
        Command::Learn(arguments) => learn::learn(arguments, &cli.global, &terminal),
        Command::Generate(arguments) => generate::generate(arguments, &cli.global, &terminal),
        Command::Inspect(arguments) => inspect::inspect(&arguments.path, &terminal),
        Command::View(arguments) => view::view(arguments, &terminal),
        Command::Migrate(arguments) => migrate::migrate(&arguments.files, arguments.dry_run, &terminal),
        Command::Sweep(arguments) => sweep::sweep(arguments, &cli.global, &terminal),
        Command::Teach(arguments) => teach::teach(arguments, &cli.global, &terminal),
        Command::Replay(arguments) => replay::replay(arguments, &cli.global, &terminal),
        Command::Merge(arguments) => merge::merge(arguments, &cli.global, &terminal),
        Command::Figures(arguments) => figures::figures(&arguments.folder, &cli.global, &terminal),
        Command::List(arguments) => list::list(&arguments.paths, &cli.global, &terminal),
        Command::Explain(arguments) => explain::explain(arguments.code.as_deref(), &cli.global, &terminal),
        Command::Schema(arguments) => schema::schema(arguments.name, &terminal),
        Command::Completions(arguments) => completions::completions(arguments.shell, &terminal),
        Command::Man => man::man(cli.global.out.as_deref(), &terminal),
    };
    outcome.max(terminal.outcome())
}

/// Help and version are results; everything else is a command line that makes no sense.
fn told_by_clap(error: &clap::Error) -> Outcome {
    let printed = error.print().and_then(|()| std::io::stdout().flush());
    match printed {
        _ if error.use_stderr() => Outcome::Usage,
        // A closed pipe is no error here either.
        Err(lost) if lost.kind() != ErrorKind::BrokenPipe => {
            terminal::complain(&format!("error: the standard output cannot be written: {lost}\n"));
            Outcome::OutputFailed
        }
        _ => Outcome::Passed,
    }
}

/// Told once, even when several threads meet the same bug.
fn report_bug(panic: &std::panic::PanicHookInfo<'_>) {
    static TOLD: AtomicBool = AtomicBool::new(false);
    if TOLD.swap(true, Ordering::Relaxed) {
        return;
    }
    let what = panic.payload_as_str().unwrap_or("no message");
    let place = panic.location().map_or(String::new(), |location| format!(" ({}:{})", location.file(), location.line()));
    terminal::complain(&format!(
        "cpdmp {}: internal error: {what}{place}\nThis is a bug in the program. Please report it with the command and the scenario.\n",
        env!("CARGO_PKG_VERSION")
    ));
}
