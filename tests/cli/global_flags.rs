//! Flags that are the same for many commands, where a command has no use for them.

use super::{Folder, GOOD, cpdmp};

/// Contract: a flag that would do nothing is an error that names the flag and the command, not silently left aside.
#[test]
fn a_flag_that_does_nothing_for_a_command_is_refused() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("d.csv", b"time_s,x_m\n0,0\n1,1\n")]);
    for (arguments, flags) in [
        (
            &["generate", "s.json", "--theta", "h=.2", "--set", "motion.states=3", "--robot", "nosuch.urdf", "--timeout", "1e-9"][..],
            &["--set", "--robot", "--timeout"][..],
        ),
        (&["inspect", "d.csv", "--out", "x.json"], &["--out"]),
        (&["--seed", "3", "inspect", "d.csv"], &["--seed"]),
        (&["learn", "d.csv", "--deny-warnings"], &["--deny-warnings"]),
        (&["list", ".", "--set", "seed=1", "--out", "here"], &["--set", "--out"]),
        (&["figures", "runs/a-0", "--seed", "1"], &["--seed"]),
        (&["validate", "a.toml", "--timeout", "1"], &["--timeout"]),
        (&["schema", "scenario", "--out", "s.json"], &["--out"]),
        (&["explain", "--lenient"], &["--lenient"]),
    ] {
        let said = folder.call(arguments);
        assert_eq!((said.code, said.stdout.as_str()), (Some(2), ""), "{arguments:?}: {}", said.stderr);
        assert_eq!(said.stderr.matches("does nothing for cpdmp").count(), flags.len(), "{}", said.stderr);
        let command = if arguments[0].starts_with('-') { arguments[2] } else { arguments[0] };
        for flag in flags {
            let told = format!("error: {flag} does nothing for cpdmp {command}: leave it out (it is for ");
            assert!(said.stderr.contains(&told), "{told}: {}", said.stderr);
        }
    }
    assert_eq!(folder.names(), ["a.toml", "d.csv"], "nothing is written");
    let said = folder.call(&["inspect", "d.csv", "--seed", "1", "--format", "json"]);
    let told: serde_json::Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert!(told["exit_code"] == 2 && told["error"].as_str().is_some_and(|error| error.starts_with("--seed does nothing")), "{told}");
}

/// Contract: flags about output work everywhere, and the environment, which is for all commands of a shell, is refused by none.
#[test]
fn flags_about_output_and_the_environment_are_fine_everywhere() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let said = folder.call(&["list", ".", "--jobs", "1", "--color", "never", "--format", "json", "-q", "--no-progress"]);
    assert!(said.code == Some(0) && said.stdout.contains("\"name\":\"good\""), "{}", said.stderr);
    let mut command = cpdmp();
    let environment = [("CPDMP_SEED", "7"), ("CPDMP_TIMEOUT", "60"), ("CPDMP_OUT", "nowhere"), ("CPDMP_ROBOT", "builtin:baxter")];
    let output = command.current_dir(folder.path()).envs(environment).args(["list", "."]).output().expect("it starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn the_help_of_a_command_is_about_the_flags_that_it_takes() {
    let help = |command: &str| Folder::with(&[]).call(&[command, "--help"]).stdout;
    for (command, taken, left_out) in [
        ("inspect", &["--format"][..], &["--set", "--seed", "--robot", "--out", "--timeout", "--deny-warnings"][..]),
        ("generate", &["--out", "--theta"], &["--set", "--seed", "--robot", "--timeout"]),
        ("learn", &["--set", "--seed", "--out"], &["--robot", "--timeout", "--asset-root"]),
        ("run", &["--set", "--seed", "--robot", "--out", "--timeout", "--deny-warnings"], &[]),
    ] {
        let help = help(command);
        let words: Vec<&str> = help.split_whitespace().collect();
        for flag in taken {
            assert!(words.contains(flag), "{command} {flag}: {help}");
        }
        let options = |flag: &str| help.lines().any(|line| line.trim_start().starts_with(&format!("{flag} ")));
        assert!(!left_out.iter().any(|flag| options(flag)), "{command}: {help}");
    }
}
