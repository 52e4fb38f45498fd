//! Data that did not come from this program: layouts of other projects, units, quaternion orders, repetitions in one file, parameters
//! read off the data.

use std::path::Path;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::demonstration::{
    Dataset, DemonstrationError, FileFormat, Import, ParameterSource, Trajectory, read_trajectory, write_trajectory,
};
use nalgebra::DMatrix;

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn import(files: &[(&str, &str)]) -> Import {
    Dataset::import(folder(files).path()).unwrap_or_else(|error| panic!("{error}"))
}

fn faults(files: &[(&str, &str)]) -> Vec<String> {
    match Dataset::read(folder(files).path()) {
        Err(DemonstrationError::Invalid(faults)) => faults.iter().map(ToString::to_string).collect(),
        other => panic!("{other:?}"),
    }
}

/// Asserts that one fault has all the parts.
fn assert_fault(faults: &[String], parts: &[&str]) {
    assert!(faults.iter().any(|fault| parts.iter().all(|part| fault.contains(part))), "no fault with {parts:?} in {faults:#?}");
}

fn names(import: &Import) -> Vec<&str> {
    import.dataset.demonstrations.iter().map(|demonstration| demonstration.name.as_str()).collect()
}

fn column(import: &Import, demonstration: usize, name: &str) -> Vec<f64> {
    import.dataset.demonstrations[demonstration].trajectory.column(name).unwrap().iter().copied().collect()
}

#[test]
fn a_folder_of_tables_needs_no_list() {
    let text = "time_s,x_m,gripper,qx,qy,qz,qw,fx_n,tz_nm,note\n0,1,0,0,0,0,1,5,6,begin\n1,2,1,0,0,0,-1,5,6,end\n";
    let import = import(&[("b.csv", text), ("a.csv", text), ("readme.md", "not data")]);
    assert_eq!(names(&import), ["a", "b"]);
    assert_eq!((import.dataset.motion.join(","), import.dataset.wrench.join(",")), ("x_m".to_owned(), "fx_n,tz_nm".to_owned()));
    for part in ["columns note", "changes sign 1 times", "motion [x_m]"] {
        assert!(import.notes.iter().any(|note| note.contains(part)), "nothing about {part}: {:#?}", import.notes);
    }
    assert_fault(&faults(&[("readme.md", "not data")]), &["0 CSV or Parquet files"]);
}

#[test]
fn one_file_holds_repetitions_by_column_or_by_time() {
    let by_column = "demo,time_s,x_m\n7,0,1\n7,1,2\n3,0,3\n7,2,4\n3,1,5\n";
    let by_time = "time_s,x_m\n0,1\n1,2\n2,4\n0,3\n1,5\n";
    for (text, expected) in [(by_column, ["all_7", "all_3"]), (by_time, ["all_1", "all_2"])] {
        let folder = folder(&[("all.csv", text)]);
        let [by_folder, by_file] = [folder.path().to_owned(), folder.path().join("all.csv")].map(|path| Dataset::import(&path).unwrap());
        assert_eq!((names(&by_folder), &by_folder.dataset), (expected.to_vec(), &by_file.dataset));
        assert_eq!((column(&by_file, 0, "x_m"), column(&by_file, 1, "x_m")), (vec![1.0, 2.0, 4.0], vec![3.0, 5.0]));
        assert!(by_file.notes.iter().any(|note| note.contains("2 repetitions, told apart by")), "{:?}", by_file.notes);
    }
}

#[test]
fn the_list_chooses_sequences_and_gives_them_parameters() {
    let list = "schema_version = 1\nmotion = [\"x_m\"]\nfile = \"all.csv\"\nsequence = \"who\"\n\
        [[demonstration]]\nsequence = \"b\"\ntheta_m = { h_m = 1 }\n[[demonstration]]\nsequence = 2\ntheta_m = { h_m = 2.5 }\n";
    let text = "who,time_s,x_m\na,0,1\na,1,2\nb,0,3\nb,1,4\n2.0,0,5\n2.0,1,6\n";
    let import = import(&[("dataset.toml", list), ("all.csv", text)]);
    assert_eq!(names(&import), ["all_b", "all_2"]);
    assert_eq!(import.dataset.demonstrations[1].theta_m, [("h_m".to_owned(), 2.5)]);
    let found = faults(&[("dataset.toml", &list.replace("\"b\"", "\"z\"")), ("all.csv", text)]);
    assert_fault(&found, &["sequence z", "one of [a, b, 2]"]);
    assert_fault(&faults(&[("dataset.toml", &list.replace("\"who\"", "\"nobody\"")), ("all.csv", text)]), &["column nobody"]);
}

#[test]
fn parameters_stand_in_columns_and_are_constant() {
    let list = "schema_version = 1\ntheta_m = [\"h_m\"]\ntheta_f = [\"m_kg\"]\n";
    let text = "trial,time_s,x_m,h_m,m_kg\n1,0,1,0.1,2\n1,1,2,0.1,2\n2,0,3,0.2,2\n2,1,4,0.2,2\n";
    let import = import(&[("dataset.toml", list), ("a.csv", text)]);
    let theta = |i: usize| import.dataset.demonstrations[i].theta_m[0].1;
    assert_eq!((theta(0), theta(1), import.dataset.motion.len()), (0.1, 0.2, 1));
    assert_eq!(import.dataset.demonstrations[0].theta_f, [("m_kg".to_owned(), 2.0)]);
    let found = faults(&[("dataset.toml", list), ("a.csv", &text.replace("4,0.2", "4,0.3"))]);
    assert_fault(&found, &["a.csv", "row 5", "column h_m", "0.3", "0.2"]);
}

#[test]
fn other_names_units_and_quaternion_orders_are_brought_to_si() {
    let list = "schema_version = 1\n[columns]\ntime_s = { from = \"stamp\", unit = \"ms\" }\nx_m = { from = \"px\", unit = \"mm\" }\n\
        q1_rad = { from = \"j1\", unit = \"deg\" }\ny_m = \"py\"\nquaternion = { from = [\"a\", \"b\", \"c\", \"d\"], order = \"wxyz\" }\n";
    let text = "stamp;px;py;j1;a;b;c;d\n0;1500;2;180;1;0;0;0\n250;-20;3;90;0;0;1;0\n";
    let import = import(&[("dataset.toml", list), ("a.csv", text)]);
    let trajectory = &import.dataset.demonstrations[0].trajectory;
    assert_eq!((trajectory.times_s(), column(&import, 0, "y_m")), (&[0.0, 0.25][..], vec![2.0, 3.0]));
    let close = |name: &str, expected: [f64; 2]| {
        column(&import, 0, name).iter().zip(expected).for_each(|(x, y)| assert!((x - y).abs() < 1e-15 * y.abs().max(1.0), "{name}: {x}"));
    };
    close("x_m", [1.5, -0.02]);
    close("q1_rad", [std::f64::consts::PI, std::f64::consts::FRAC_PI_2]);
    let orientations = trajectory.orientations().unwrap();
    assert_eq!((orientations[0].w, orientations[1].j), (1.0, 1.0));
    assert_eq!(import.dataset.motion, ["q1_rad", "x_m", "y_m"]);
    assert!(import.notes.iter().any(|note| note.contains("x_m from `px` in mm (times 0.001)")), "{:#?}", import.notes);
}

#[test]
fn every_fault_of_a_mapping_is_named() {
    let list = "schema_version = 1\ndelimiter = \"|\"\nheader = 1\nrate_hz = -1\ntheta = \"middle\"\n[columns]\nx_m = { from = \"px\", unit = \"deg\" }\n\
        y_m = { from = \"py\", unit = \"furlong\" }\nz_m = { form = \"pz\" }\nquaternion = { from = [\"a\"], order = \"wxyz\" }\n";
    let found = faults(&[("dataset.toml", list), ("a.csv", "time_s,px,py\n0,1,1\n1,1,1\n")]);
    for part in ["delimiter", "header", "rate_hz", "theta", "columns.x_m", "columns.y_m", "columns.z_m", "columns.quaternion"] {
        assert_fault(&found, &[&format!("dataset.toml, {part}")]);
    }
    let list = "schema_version = 1\n[columns]\nx_m = \"px\"\n";
    assert_fault(&faults(&[("dataset.toml", list), ("a.csv", "time_s,x\n0,1\n1,1\n")]), &["column x_m", "`px`", "time_s, x"]);
    assert_fault(&faults(&[("dataset.toml", list), ("a.csv", "time_s,px,x_m\n0,1,1\n1,1,1\n")]), &["column x_m", "mapped"]);
    let twice = "schema_version = 1\nmotion = [\"x_m\"]\ntheta = \"start\"\n[[demonstration]]\nfile = \"a.csv\"\ntheta_m = { h_m = 1 }\n";
    assert_fault(&faults(&[("dataset.toml", twice), ("a.csv", "time_s,x_m\n0,1\n1,1\n")]), &["several places"]);
}

/// dmpbbo writes `t y1..yN yd1.. ydd1..` in blanks without a header.
#[test]
fn the_layout_of_dmpbbo_is_read() {
    let text: String = (0..20).map(|i| format!("{:.4} {} {}  0.1 0.2 0 0\n", f64::from(i) * 0.01, i, 2 * i)).collect();
    let list = "schema_version = 1\nheader = false\ndelimiter = \"whitespace\"\n[columns]\ntime_s = 0\nx_m = 1\ny_m = { from = 2, unit = \"cm\" }\n";
    let import = import(&[("dataset.toml", list), ("trajectory.txt", &text)]);
    assert_eq!((names(&import), import.dataset.motion.len()), (vec!["trajectory"], 2));
    assert_eq!((column(&import, 0, "x_m")[19], column(&import, 0, "y_m")[19]), (19.0, 0.38));
    assert!(import.notes.iter().any(|note| note.contains("columns 3, 4, 5, 6") && note.contains("left out")), "{:#?}", import.notes);
    assert_fault(&faults(&[("trajectory.txt", &text)]), &["row 1", "header"]);
    assert_fault(&faults(&[("dataset.toml", &list.replace("x_m = 1", "x_m = 9")), ("trajectory.txt", &text)]), &["column x_m", "9"]);
}

/// The authors' files: t, 7 joints, one skipped, position, quaternion (scalar last), wrench, twist, joint velocities.
#[test]
fn the_layout_of_the_authors_is_read() {
    let row = |t: usize| {
        (0..35).map(move |i| if i == 0 { t } else { usize::from(i == 15) + 2 * usize::from(i == 9) * t + usize::from(i == 17) * 7 })
    };
    let text: String = (0..5).map(|t| row(t).map(|x| x.to_string()).collect::<Vec<_>>().join(",") + "\n").collect();
    let list = "schema_version = 1\nwrench = [\"fy_n\"]\n[columns]\ntime_s = 0\nx_m = 9\ny_m = 10\nz_m = 11\n\
        quaternion = { from = [12, 13, 14, 15], order = \"xyzw\" }\nfy_n = 17\n";
    let import = import(&[("dataset.toml", list), ("demo.csv", &text)]);
    assert_eq!((column(&import, 0, "x_m"), column(&import, 0, "fy_n")), (vec![0.0, 2.0, 4.0, 6.0, 8.0], vec![7.0; 5]));
    assert_eq!((import.dataset.motion.join(","), column(&import, 0, "qw")), ("x_m,y_m,z_m".to_owned(), vec![1.0; 5]));
}

#[test]
fn samples_without_time_need_a_rate() {
    let text = "episode,x_m\n0,1\n0,2\n1,3\n1,4\n1,5\n";
    let import = import(&[("dataset.toml", "schema_version = 1\nrate_hz = 50\n"), ("a.csv", text)]);
    assert_eq!(import.dataset.demonstrations[1].trajectory.times_s(), [0.0, 0.02, 0.04]);
    assert_fault(&faults(&[("a.csv", text)]), &["time_s", "rate_hz"]);
}

#[test]
fn decimal_commas_tabs_comments_and_binary_files() {
    assert_fault(&faults(&[("a.csv", "time_s;x_m\n0,0;1,5\n1,0;2,5\n")]), &["row 2", "decimal comma"]);
    assert_fault(&faults(&[("a.csv", "time_s,x_m\n0,0,1,5\n1,0,2,5\n")]), &["row 2", "decimal comma"]);
    let import = import(&[("a.tsv", "# recorded today\n\ntime_s\tx_m\n0\t1\n# pause\n1\t2\n")]);
    assert_eq!(column(&import, 0, "x_m"), [1.0, 2.0]);
    assert_fault(&faults(&[("a.tsv", "# one\n\ntime_s\tx_m\n0\t1\n# pause\n1\to\n2\t3\n")]), &["row 6", "column x_m", "`o`"]);
    assert_fault(&faults(&[("a.csv", "time_s,x_m\n0,1\n1,\u{0}\n")]), &["row 3", "zero byte"]);
    assert_fault(&faults(&[("a.csv", "time_s,x_m,x_m\n0,1,1\n1,1,1\n")]), &["column x_m", "twice"]);
    assert_fault(&faults(&[("a.csv", "time_s,x_mm\n0,1\n1,1\n")]), &["x_mm", "unit = \"mm\""]);
    let bytes = tempfile::tempdir().unwrap();
    std::fs::write(bytes.path().join("a.csv"), b"time_s,x_m\n0,1\n1,\xff\n").unwrap();
    assert!(Dataset::read(bytes.path()).unwrap_err().to_string().contains("row 3: found bytes that are not UTF-8"));
}

#[test]
fn demonstrations_with_other_columns_are_named() {
    let (one, two) = ("time_s,x_m,y_m\n0,1,1\n1,1,1\n", "time_s,x_m,z_m\n0,1,1\n1,1,1\n");
    assert_fault(&faults(&[("a.csv", one), ("b.csv", two)]), &["b, column z_m", "a does not have"]);
}

#[test]
fn parameters_follow_start_and_goal() {
    let (a, b) = ("time_s,y_m,x_m\n0,1,2\n1,4,8\n", "time_s,y_m,x_m\n0,0,0.5\n1,4,8\n");
    let read = |theta: &str| {
        import(&[("dataset.toml", &format!("schema_version = 1\ntheta = \"{theta}\"\n")), ("a.csv", a), ("b.csv", b)]).dataset
    };
    let theta = |dataset: &Dataset, i: usize| format!("{:?}", dataset.demonstrations[i].theta_m);
    let start = read("start");
    assert_eq!(theta(&start, 0), "[(\"start_x_m\", 2.0), (\"start_y_m\", 1.0)]");
    assert_eq!(theta(&read("goal"), 1), "[(\"goal_x_m\", 8.0), (\"goal_y_m\", 4.0)]");
    let relative = read("start_relative_to_goal");
    assert_eq!(theta(&relative, 1), "[(\"relative_start_x_m\", -7.5), (\"relative_start_y_m\", -4.0)]");
    assert_eq!(start.clone().with_parameter_source(ParameterSource::StartRelativeToGoal), relative);
    for format in [FileFormat::Csv, FileFormat::Parquet] {
        let folder = tempfile::tempdir().unwrap();
        start.write_as(&folder.path().join("set"), format).unwrap();
        assert_eq!(Dataset::read(&folder.path().join("set")).unwrap(), start);
        assert_eq!(Dataset::read(&folder.path().join("set/dataset.toml")).unwrap(), start);
    }
}

#[test]
fn both_formats_keep_every_bit() {
    let folder = tempfile::tempdir().unwrap();
    let extreme = [f64::MIN_POSITIVE, -0.0, 5e-324, f64::MAX, 0.1 + 0.2, -1.0 / 3.0];
    let columns = ["x_m", "a,b"].map(str::to_owned).to_vec();
    let trajectory = Trajectory::new(vec![-1.0, 0.1, 1e300], columns, DMatrix::from_row_slice(3, 2, &extreme)).unwrap();
    for name in ["a.csv", "a.parquet"] {
        let path = folder.path().join(name);
        write_trajectory(&path, &trajectory).unwrap();
        write_trajectory(&path, &trajectory).unwrap();
        let back = read_trajectory(&path).unwrap();
        let bits = |t: &Trajectory| t.values().iter().chain(t.times_s()).map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!((back.columns(), bits(&back)), (trajectory.columns(), bits(&trajectory)), "{name}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is left beside");
    assert!(write_trajectory(&folder.path().join("a.xls"), &trajectory).is_err());
    assert!(write_trajectory(Path::new("/nowhere/a.csv"), &trajectory).is_err());
    let dataset = PickAndPlace { duration_s: 2.0, ..Default::default() }.dataset(3);
    dataset.write_as(&folder.path().join("set"), FileFormat::Parquet).unwrap();
    assert!(Dataset::read(&folder.path().join("set")).unwrap() == dataset);
}

#[test]
fn the_summary_tells_rates_gaps_and_ranges() {
    let import = import(&[("a.csv", "time_s,x_m\n0,3\n0.5,-1\n2.5,2\n")]);
    let summary = &import.dataset.summary().demonstrations[0];
    assert_eq!((summary.samples, summary.duration_s, summary.rate_hz, summary.largest_gap_s), (3, 2.5, [0.5, 2.0], 2.0));
    let x = &summary.columns[0];
    assert_eq!((x.start, x.end, x.min, x.max), (3.0, 2.0, -1.0, 3.0));
}
