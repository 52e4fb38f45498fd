//! `sweep` and `merge` on the real binary: one table whatever happens on the way, and every slip told before the first run.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;

use super::program::names;
use super::{Folder, GOOD};

/// A planar experiment of a tenth of a second with a small sweep.
pub(super) const SHORT: &str = r#"
schema_version = 1
name = "short"

[planar]
kind = "obstacle_avoidance"
new_goals_x_m = [2.5]

[planar.hand]
repetitions = 1
rate_hz = 25

[learning]
rate_hz = 25

[learning.motion]
states = 5
kmeans_starts = 0
max_iterations = 10

[[criterion]]
name = "clear"
kind = "planar_clearance"
method = "cpdmp"
settings = "taught"
min_m = 0.5
"#;

pub(super) const SWEPT: &str = r#"
[[sweep]]
kind = "grid"
key = "planar.clearance_m"
values = [0.4, 1.0]

[[sweep]]
kind = "latin_hypercube"
count = 3
ranges.planar.hand.noise_m = [0.001, 0.004]
ranges."planar.hand.shape_spread_m" = [0.0, 0.1]

[[sweep]]
kind = "repeat"
count = 2
"#;

fn folder() -> Folder {
    Folder::with(&[("a.toml", format!("{SHORT}{SWEPT}").as_bytes()), ("bare.toml", SHORT.as_bytes())])
}

/// Column names and rows of a table.
fn table(path: &Path) -> (Vec<String>, Vec<Vec<Field>>) {
    let reader = SerializedFileReader::new(File::open(path).expect("a file")).expect("Parquet");
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let names = schema.columns().iter().map(|column| column.name().to_owned()).collect();
    let fields = |row: parquet::record::Row| row.get_column_iter().map(|(_, field)| field.clone()).collect();
    (names, reader.into_iter().map(|row| fields(row.expect("a row"))).collect())
}

fn bytes(folder: &Folder, path: &str) -> Vec<u8> {
    fs::read(folder.path().join(path)).expect("a table")
}

#[test]
fn every_member_is_one_row_in_order_and_its_command_repeats_it() {
    let folder = folder();
    let said = folder.call(&["sweep", "a.toml", "--jobs", "2", "--format", "json"]);
    assert_eq!(said.code, Some(10), "a clearance of 0.4 m is less than 0.5 m: {}", said.stderr);
    let told: Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert_eq!((told["members"].as_u64(), told["summary"]["runs"].as_u64()), (Some(12), Some(12)));
    assert_eq!(names(&folder.path().join("sweeps/short")), ["rows.jsonl", "sweep.json", "sweep.parquet"]);
    let (columns, rows) = table(&folder.path().join("sweeps/short/sweep.parquet"));
    let column = |name: &str| columns.iter().position(|column| column == name).unwrap_or_else(|| panic!("no {name} in {columns:?}"));
    let text = |row: &[Field], name: &str| if let Field::Str(text) = &row[column(name)] { Some(text.clone()) } else { None };
    let number = |row: &[Field], name: &str| if let Field::Double(x) = row[column(name)] { Some(x) } else { None };
    for (index, row) in rows.iter().enumerate() {
        let seed = index as i64 % 2;
        assert_eq!((&row[column("index")], &row[column("seed")]), (&Field::Long(index as i64), &Field::Long(seed)));
        assert_eq!(number(row, "planar.clearance_m"), Some(if index < 6 { 0.4 } else { 1.0 }));
        assert!((0.001..0.004).contains(&number(row, "planar.hand.noise_m").expect("drawn")));
        let passed = Field::Bool(text(row, "outcome").as_deref() == Some("passed"));
        assert_eq!((&row[column("criterion.clear.passed")], text(row, "failure_reason").is_none()), (&passed, passed == Field::Bool(true)));
    }
    for row in [&rows[1], &rows[11]] {
        let command = text(row, "command").expect("a command");
        let words: Vec<&str> = command.split(' ').skip(1).chain(["--format", "json", "-q"]).collect();
        let alone = folder.call(&words);
        let report: Value = serde_json::from_str(&alone.stdout).expect("JSON");
        assert_eq!(report["state_hash"].as_str(), text(row, "state_hash").as_deref(), "{command}");
        assert_eq!(report["criteria"][0]["value"].as_f64(), number(row, "criterion.clear.value"));
        assert_eq!(alone.code, if let Field::Long(code) = row[column("exit_code")] { Some(code as i32) } else { None });
    }
}

/// Contract: killed at any moment and gone on with, again and again, a sweep ends in the very bytes of one that was left alone.
#[test]
fn a_sweep_that_is_killed_again_and_again_ends_in_the_same_table() {
    let folder = folder();
    folder.call(&["sweep", "a.toml", "--grid", "planar.pass_fraction=0.4,0.5", "--out", "whole", "--jobs", "1"]);
    let mut killed = 0;
    for round in 0..40 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_cpdmp"))
            .current_dir(folder.path())
            .args(["sweep", "a.toml", "--grid", "planar.pass_fraction=0.4,0.5", "--out", "killed", "--resume", "--jobs", "2", "-q"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        // Longer with every round, so that a busy machine comes to an end too; dense enough to hit every stage.
        std::thread::sleep(Duration::from_millis(20).mul_f64(1.3_f64.powi(round)));
        if let Some(status) = child.try_wait().expect("it is there") {
            assert_eq!(status.code(), Some(10));
            break;
        }
        child.kill().expect("killed");
        child.wait().expect("it ends");
        killed += 1;
    }
    assert!(killed >= 2, "it was killed {killed} times");
    assert!(bytes(&folder, "killed/sweep.parquet") == bytes(&folder, "whole/sweep.parquet"), "killed {killed} times");
}

#[test]
fn shards_merge_to_the_whole_and_nothing_else_does() {
    let folder = folder();
    let sweep = |shard: &str, out: &str| folder.call(&["sweep", "a.toml", "--shard", shard, "--out", out]).code.expect("an exit code");
    let whole = sweep("1/1", "whole");
    assert_eq!(sweep("1/2", "one").max(sweep("2/2", "two")), whole);
    assert_eq!(whole, 10, "some of these runs do not pass");
    let merge = |tables: &[&str]| folder.call(&[&["merge"], tables, &["--out", "merged.parquet"]].concat());
    let said = merge(&["two/sweep.parquet", "one"]);
    assert_eq!(said.code, Some(whole), "as the sweep of the whole: {}", said.stderr);
    assert!(said.stdout.contains("merged.parquet: 12 rows, ") && said.stdout.contains("did not pass"), "{}", said.stdout);
    assert!(bytes(&folder, "merged.parquet") == bytes(&folder, "whole/sweep.parquet"));
    folder.call(&["sweep", "bare.toml", "--repeat", "2", "--out", "other"]);
    for (tables, told) in [
        (&["one"][..], "member 1 of 12 is in none of them"),
        (&["one", "two", "two"], "in another table"),
        (&["one", "other"], "other/sweep.parquet is of `short`, 2 members"),
        (&["a.toml"], "is not a table of a sweep"),
        (&["one", "merged.parquet"], "cannot be where the whole goes"),
        (&["absent.parquet"], "cannot be read"),
    ] {
        let said = merge(tables);
        assert_eq!(said.code, Some(3), "{tables:?}: {}", said.stderr);
        assert!(said.stderr.contains(told), "{tables:?}: {}", said.stderr);
    }
    assert_eq!(folder.call(&["merge", "one"]).code, Some(2), "without --out");
    assert_eq!(folder.call(&["merge", "one", "two", "--out", "a.toml"]).code, Some(20), "a scenario is not overwritten");
}

#[test]
fn a_faulty_member_is_told_where_it_was_typed_before_anything_is_written() {
    let folder = folder();
    let faulty = [
        ("values = [0.4, 1.0]", "values = [0.4, 100.0]", "member 6 (planar.clearance_m=100.0", "expected 0.01 … 10 m"),
        ("values = [0.4, 1.0]", "value = [0.4]", "unknown key", "did you mean `values`?"),
        ("kind = \"repeat\"", "kind = \"repeated\"", "cannot be `repeated`", "did you mean `repeat`?"),
        ("[0.001, 0.004]", "[0.004, 0.001]", "begins at 0.004 and ends at 0.001", "[min, max]"),
        ("key = \"planar.clearance_m\"", "key = \"planar.clearance\"", "unknown key `planar.clearance`", "did you mean `clearance_m`?"),
        ("key = \"planar.clearance_m\"", "key = \"planar.hand.noise_m\"", "`planar.hand.noise_m` varies twice", "one entry"),
        ("key = \"planar.clearance_m\"", "key = \"name\"", "`name` cannot vary", ""),
    ];
    for (old, new, told, expected) in faulty {
        let text = format!("{SHORT}{SWEPT}");
        assert_eq!(text.matches(old).count(), 1);
        fs::write(folder.path().join("b.toml"), text.replace(old, new)).expect("written");
        let said = folder.call(&["sweep", "b.toml"]);
        assert_eq!(said.code, Some(3), "{new}: {}", said.stderr);
        assert!(said.stderr.contains(told) && said.stderr.contains(expected) && said.stderr.contains("b.toml:"), "{new}: {}", said.stderr);
    }
    for (flags, told) in [
        (&["--set", "planar.clearance_m=1"][..], "a flag gives it one value"),
        (&["--set", " planar . clearance_m =1"], "a flag gives it one value"),
        (&["--grid", "criterion.clear.min_m=0.1,0.2", "--set", "criterion.0.min_m=50"], "a flag gives it one value"),
        (&["--grid", "criterion.clear.min_m=0.1,0.2", "--set", "criterion.clear={min_m = 50}"], "a flag gives it one value"),
        (&["--grid", "criterion.clear.min_m=0.1,0.2", "--grid", "criterion.0.min_m=3,4"], "varies twice"),
        (&["--grid", "planar.start_m.0=0,1", "--grid", "planar.start_m=[0,-4],[1,-4]"], "varies twice"),
        (&["--grid", "planar. clearance_m=1,2", "--grid", "planar.clearance_m=3"], "varies twice"),
        (&["--grid", "planar.hand.rate_hz=25,50,25"], "this value of `planar.hand.rate_hz` is listed twice"),
    ] {
        let said = folder.call(&[&["sweep", "a.toml"], flags].concat());
        assert!(said.code == Some(3) && said.stderr.contains(told), "{flags:?}: {}", said.stderr);
    }
    let said = folder.call(&["sweep", "bare.toml", "--grid", "seed=1,2", "--seed", "3"]);
    assert!(said.code == Some(3) && said.stderr.contains("`seed` varies, but a flag gives it one value"), "{}", said.stderr);
    assert_eq!(folder.names(), ["a.toml", "b.toml", "bare.toml"], "nothing was written");
}

#[test]
fn a_sweep_of_nothing_or_of_too_much_is_refused() {
    let folder = folder();
    for (arguments, code, told) in [
        (&["bare.toml"][..], 5, "has no members"),
        (&["bare.toml", "--grid", "planar.clearance_m="], 5, "has no members"),
        (&["a.toml", "--max-runs", "11"], 3, "12 members, more than 11"),
        (&["bare.toml", "--shard", "3/2"], 2, "1/4"),
        (&["bare.toml", "--grid", "planar.clearance_m"], 3, "no key and `=`"),
    ] {
        let said = folder.call(&[&["sweep"], arguments].concat());
        assert_eq!(said.code, Some(code), "{arguments:?}: {}", said.stderr);
        assert!(said.stderr.contains(told), "{arguments:?}: {}", said.stderr);
    }
    let said = folder.call(&["sweep", "bare.toml", "--repeat", "2", "--shard", "3/3", "--out", "empty"]);
    assert!(said.code == Some(0) && said.stderr.contains("shard 3/3 of 2 members has none"), "{}", said.stderr);
    fs::remove_dir_all(folder.path().join("empty")).expect("a table without rows, for merge");
    let said = folder.call(&["sweep", "a.toml", "--dry-run"]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(0), "short: 12 members, all can be run\n"));
    assert_eq!(folder.names(), ["a.toml", "bare.toml"], "nothing was written");
}

#[test]
fn a_folder_goes_on_with_its_own_sweep_only() {
    let folder = folder();
    let sweep = |more: &[&str]| folder.call(&[&["sweep", "bare.toml", "--out", "s", "-q"], more].concat());
    assert_eq!(sweep(&["--repeat", "2"]).code, Some(0));
    let before = bytes(&folder, "s/sweep.parquet");
    let again = sweep(&["--repeat", "2"]);
    assert!(again.code == Some(20) && again.stderr.contains("--resume"), "{}", again.stderr);
    let timed = &["--repeat", "2", "--timeout", "60"];
    for more in [&["--repeat", "3"][..], &["--repeat", "2", "--seed", "1"], &["--repeat", "2", "--shard", "1/2"], timed] {
        let said = sweep(&[&["--resume"], more].concat());
        assert!(said.code == Some(3) && said.stderr.contains("holds another sweep"), "{more:?}: {}", said.stderr);
    }
    assert_eq!(sweep(&["--repeat", "2", "--resume"]).code, Some(0), "a finished one is told again");
    assert!(bytes(&folder, "s/sweep.parquet") == before);
    fs::create_dir(folder.path().join("mine")).expect("a folder");
    fs::write(folder.path().join("mine/thesis.tex"), "years of work").expect("written");
    assert_eq!(folder.call(&["sweep", "bare.toml", "--repeat", "2", "--out", "mine"]).code, Some(20));
}

/// A key of one kind may vary over kinds: what a layer below says of another kind is left behind, as with `--set`.
#[test]
fn words_and_seeds_vary_too() {
    let folder = folder();
    let said = folder.call(&["sweep", "bare.toml", "--grid", "seed=3,5", "--grid", "learning.motion.topology=left_to_right,ergodic"]);
    assert!(said.code.is_some_and(|code| code == 0 || code == 10), "{}", said.stderr);
    let (columns, rows) = table(&folder.path().join("sweeps/short/sweep.parquet"));
    assert!(columns.contains(&"learning.motion.topology".to_owned()));
    let seeds: Vec<&Field> = rows.iter().map(|row| &row[1]).collect();
    assert_eq!(seeds, [&Field::Long(3), &Field::Long(3), &Field::Long(5), &Field::Long(5)]);
    assert_eq!(rows[1][2], Field::Str("ergodic".to_owned()));
}

/// Contract: a table that varies as a whole stands in the sweep's table, as TOML.
#[test]
fn tables_vary_too() {
    let folder = folder();
    let values = "{kmeans_starts=0, states=3},{states=4}";
    let said = folder.call(&["sweep", "bare.toml", "--grid", &format!("learning.motion={values}")]);
    assert!(said.code.is_some_and(|code| code == 0 || code == 10), "{}", said.stderr);
    let (columns, rows) = table(&folder.path().join("sweeps/short/sweep.parquet"));
    let of = |name: &str| columns.iter().position(|column| column == name).expect("a column");
    let told: Vec<String> = rows.iter().map(|row| row[of("learning.motion")].to_string()).collect();
    assert_eq!(told, ["\"{ kmeans_starts = 0, states = 3 }\"", "\"{ states = 4 }\""]);
    assert!(rows[1][of("command")].to_string().contains("learning.motion={ states = 4 }"), "{:?}", rows[1]);

    // A path in a table is seen from the file in the file, and from here in the command that repeats a member.
    std::fs::create_dir(folder.path().join("sub")).expect("made");
    let robots = "\n[[sweep]]\nkind = \"grid\"\nkey = \"robot\"\nvalues = [{ urdf = \"a.urdf\" }, { urdf = \"b.urdf\" }]\n";
    std::fs::write(folder.path().join("sub/t.toml"), format!("{GOOD}{robots}")).expect("written");
    for name in ["a", "b"] {
        std::fs::write(folder.path().join("sub").join(format!("{name}.urdf")), include_str!("../../assets/baxter/baxter.urdf"))
            .expect("written");
    }
    let said = folder.call(&["sweep", "sub/t.toml", "--out", "robots"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let (columns, rows) = table(&folder.path().join("robots/sweep.parquet"));
    let command = columns.iter().position(|column| column == "command").expect("a column");
    for (row, name) in rows.iter().zip(["a", "b"]) {
        assert!(row[command].to_string().contains(&format!("\"sub/{name}.urdf\"")), "{}", row[command]);
    }
}

/// Contract: with `--deny-warnings` what `run` would refuse is refused of every member before the first run, and a run that warns of something is one
/// that is not as expected, as its command says.
#[test]
fn denied_warnings_are_faults_of_members_and_of_their_runs() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let sweep = |more: &[&str]| folder.call(&[&["sweep", "a.toml", "--format", "json", "-q"], more].concat());
    let beyond = ["--grid", "parameters.block_height_m=0.2,0.4"];
    assert_eq!(sweep(&[&beyond[..], &["--dry-run"]].concat()).code, Some(0));
    let said = sweep(&[&beyond[..], &["--deny-warnings"]].concat());
    assert_eq!(said.code, Some(3), "{}{}", said.stdout, said.stderr);
    assert!(said.stdout.contains("member 1") && said.stdout.contains("untaught") && !said.stdout.contains("member 0"), "{}", said.stdout);
    assert_eq!(folder.names(), ["a.toml"], "nothing was run");
    let alone = ["--set", "teaching.grid.block_height_m=[0.2]", "--set", "learning.theta_m=[]", "--repeat", "1", "--out", "s"];
    let said = sweep(&[&alone[..], &["--deny-warnings"]].concat());
    assert_eq!(said.code, Some(10), "{}{}", said.stdout, said.stderr);
    let rows = fs::read_to_string(folder.path().join("s/rows.jsonl")).expect("rows");
    assert!(rows.contains("--deny-warnings: ") && rows.contains("one demonstration"), "the reason: {rows}");
    assert!(rows.contains(" --deny-warnings\""), "the command: {rows}");
    let said = sweep(&[&alone[..], &["--resume"]].concat());
    assert!(said.code == Some(3) && said.stdout.contains("holds another sweep"), "{}{}", said.stdout, said.stderr);
}
