//! A pipe in the place of a file: nobody writes into it, so whoever opened it would wait for ever.

use super::Folder;

/// Contract: every command that reads a file refuses a pipe by name, with the code of input that cannot be used, instead of waiting.
#[cfg(unix)]
#[test]
fn a_pipe_is_refused_instead_of_waited_for() {
    let folder = Folder::with(&[]);
    for name in ["f.toml", "f.csv", "f.json"] {
        let made = std::process::Command::new("mkfifo").arg(folder.path().join(name)).status().expect("mkfifo is there");
        assert!(made.success());
    }
    let calls: [&[&str]; 7] = [
        &["validate", "f.toml"],
        &["migrate", "f.toml"],
        &["migrate", "f.json"],
        &["inspect", "f.csv"],
        &["merge", "f.csv", "--out", "out.parquet"],
        &["generate", "f.csv"],
        &["generate", "f.json"],
    ];
    for call in calls {
        let said = folder.call(call);
        assert_eq!(said.code, Some(3), "{call:?}: {}{}", said.stdout, said.stderr);
        assert!(said.stderr.contains("no regular file") && said.stderr.contains(call[1]), "{call:?}: {}", said.stderr);
    }
}
