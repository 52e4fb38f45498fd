//! The viewer is a program of its own: these tests put a small script in its place that writes down what it was asked.
#![cfg(all(unix, feature = "rerun"))]

use std::fs;
use std::io::Read;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::time::{Duration, Instant};

use super::{Folder, GOOD};

/// A folder with a viewer that notes its arguments and then does what `then` says.
fn with_viewer(then: &str) -> Folder {
    let script = format!("#!/bin/sh\necho \"$@\" >> asked\n{then}\n");
    let folder = Folder::with(&[("viewer", script.as_bytes()), ("a.toml", GOOD.as_bytes()), ("run/recording.rrd", b"RRF2")]);
    let viewer = folder.path().join("viewer");
    fs::set_permissions(&viewer, fs::Permissions::from_mode(0o755)).expect("executable");
    folder
}

/// What the viewer was asked, line by line; waits until it was asked so often.
fn asked(folder: &Folder, times: usize) -> Vec<String> {
    let started = Instant::now();
    loop {
        let text = fs::read_to_string(folder.path().join("asked")).unwrap_or_default();
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        if lines.len() >= times && text.ends_with('\n') {
            return lines;
        }
        assert!(started.elapsed() < Duration::from_secs(20), "the viewer was asked for {lines:?}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A port at which nobody listens.
fn free_port() -> String {
    let address = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
    address.expect("a free port").port().to_string()
}

#[test]
fn a_run_is_shown_by_folder_or_by_file() {
    for place in ["run", "run/recording.rrd"] {
        let folder = with_viewer("exit 0");
        let said = folder.call(&["view", place, "--viewer-program", "./viewer"]);
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        assert_eq!(asked(&folder, 1), ["run/recording.rrd --port 9876"]);
    }
}

/// Contract: what is served in a browser is served to this machine alone, and where is told.
#[test]
fn a_run_is_served_to_a_browser_until_it_is_ended() {
    let folder = with_viewer("sleep 3");
    let started = Instant::now();
    let said = folder.call(&["view", "run", "--web", "--web-port", "9191", "--viewer-port", "9877", "--viewer-program", "./viewer"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(started.elapsed() >= Duration::from_secs(3), "it stays as long as its viewer");
    assert_eq!(asked(&folder, 1), ["run/recording.rrd --web-viewer --bind 127.0.0.1 --web-viewer-port 9191 --port 9877"]);
    assert!(said.stderr.contains("http://127.0.0.1:9191?url=rerun%2Bhttp%3A%2F%2F127.0.0.1%3A9877%2Fproxy"), "{}", said.stderr);
}

#[test]
fn what_cannot_be_shown_is_told() {
    let folder = with_viewer("exit 1");
    for (arguments, code, words) in [
        (["view", "nothing", "--viewer-program", "./viewer"], 3, "recording.rrd = false"),
        (["view", "run", "--viewer-program", "no-such-viewer"], 20, "pip install rerun-sdk"),
        (["view", "run", "--viewer-program", "./viewer"], 20, "is there a display"),
        (["view", "run", "--web", "--viewer-program=./viewer"], 20, "are the ports 9090 and 9876 free"),
    ] {
        let said = folder.call(&arguments);
        assert_eq!(said.code, Some(code), "{}", said.stderr);
        assert!(said.stderr.contains(words), "{}", said.stderr);
    }
}

/// Contract: a viewer that hangs, is missing or cannot stay neither delays nor fails a run.
#[test]
fn a_run_does_not_depend_on_its_viewer() {
    let folder = with_viewer("sleep 30; touch closed");
    let port = free_port();
    let run = |viewer: &str| folder.call(&["run", "a.toml", "--viewer", "--viewer-program", viewer, "--viewer-port", &port]);
    let said = run("./viewer");
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert_eq!(asked(&folder, 2), [format!("--port {port}"), format!("runs/good-0/recording.rrd --port {port}")]);
    assert!(!folder.path().join("closed").exists(), "the run waited for its viewer");
    let said = run("no-such-viewer");
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stderr.contains("pip install rerun-sdk"), "{}", said.stderr);
    let folder = with_viewer("exit 1");
    let said = folder.call(&["run", "a.toml", "--viewer", "--viewer-program", "./viewer", "--viewer-port", &port]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stderr.contains("cpdmp view"), "{}", said.stderr);
}

/// Contract: a viewer that takes the connection up and never says a word keeps a run waiting for two seconds at most.
#[test]
fn a_viewer_that_never_answers_does_not_delay_a_run() {
    let folder = with_viewer("exit 0");
    let silent = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = silent.local_addr().expect("its address").port().to_string();
    // The quickest of three says what it takes when the machine does little else.
    let quickest = |flags: &[&str]| {
        let runs = (0..3).map(|_| {
            let started = Instant::now();
            let said = folder.call(&[&["run", "a.toml"], flags].concat());
            assert_eq!(said.code, Some(0), "{}", said.stderr);
            (started.elapsed(), said.stdout.lines().last().map(str::to_string))
        });
        runs.min().expect("three")
    };
    let (alone, hash) = quickest(&[]);
    let (watched, same) = quickest(&["--viewer", "--viewer-program", "./viewer", "--viewer-port", &port]);
    let longer = watched.saturating_sub(alone);
    // As long again, for a machine that was busier the second time.
    assert!(longer < Duration::from_secs(2) + alone, "{longer:?} longer than {alone:?}");
    assert_eq!(hash, same, "the same state hash");
}

/// Contract: a viewer that goes away while it is sent a run changes nothing about the run.
#[test]
fn a_viewer_that_is_closed_in_the_middle_does_not_change_a_run() {
    let folder = with_viewer("exit 0");
    let alone = folder.call(&["run", "a.toml"]);
    let viewer = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = viewer.local_addr().expect("its address").port().to_string();
    // It hears the beginning of the first conversation, hangs up, and is gone. Those who only look whether it is there say nothing.
    viewer.set_nonblocking(true).expect("it need not wait");
    let started = Instant::now();
    let closed = std::thread::spawn(move || {
        while started.elapsed() < Duration::from_secs(120) {
            let Ok((mut connection, _)) = viewer.accept() else {
                std::thread::sleep(Duration::from_millis(5));
                continue;
            };
            connection.set_nonblocking(false).expect("it waits");
            if connection.read_exact(&mut [0; 64]).is_ok() {
                return true;
            }
        }
        false
    });
    let watched = folder.call(&["run", "a.toml", "--viewer", "--viewer-program", "./viewer", "--viewer-port", &port]);
    assert!(closed.join().expect("it ends"), "the run was sent to the viewer");
    assert_eq!((alone.code, watched.code), (Some(0), Some(0)), "{}", watched.stderr);
    assert_eq!(alone.stdout.lines().last(), watched.stdout.lines().last(), "the same state hash");
    assert!(folder.path().join("runs/good-0/recording.rrd").is_file());
}

/// Contract: with the page in the program, `--web` needs no viewer: page and recording are served, and nothing else.
#[cfg(feature = "web-viewer")]
#[test]
fn the_program_serves_the_page_itself() {
    let folder = with_viewer("exit 1");
    let port = free_port();
    let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_cpdmp"));
    let mut child = program.current_dir(folder.path()).args(["view", "run", "--web", "--web-port", &port]).spawn().expect("it starts");
    let started = Instant::now();
    let get = |path: &str| {
        let mut connection = loop {
            if let Ok(connection) = std::net::TcpStream::connect(format!("127.0.0.1:{port}")) {
                break connection;
            }
            assert!(started.elapsed() < Duration::from_secs(60), "nobody listens");
            std::thread::sleep(Duration::from_millis(20));
        };
        std::io::Write::write_all(&mut connection, format!("GET {path} HTTP/1.0\r\n\r\n").as_bytes()).expect("asked");
        let mut answer = Vec::new();
        connection.read_to_end(&mut answer).expect("answered");
        answer
    };
    let holds = |answer: &[u8], words: &str| answer.windows(words.len()).any(|window| window == words.as_bytes());
    assert!(holds(&get("/?url=x"), "re_viewer.js"), "the page asks for its program");
    assert!(get("/re_viewer_bg.wasm").len() > 1_000_000);
    assert!(get("/recording.rrd").ends_with(b"\r\n\r\nRRF2"), "the recording, to the byte");
    assert!(holds(&get("/a.toml"), " 404 "), "no other file");
    child.kill().and_then(|()| child.wait()).expect("it is ended");
}
