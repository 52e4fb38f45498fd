//! Damaged and hostile files: whatever the bytes, a dataset is read or refused with a fault; nothing panics, hangs or yields NaN.

use std::path::Path;
use std::sync::Arc;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::demonstration::{Dataset, DemonstrationError, FileFormat};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, FloatType, Int32Type, Int64Type};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use proptest::prelude::*;

/// Reads one file of a dataset in a folder of its own; true when it is accepted. Accepted data are finite.
fn accepted(name: &str, bytes: &[u8], list: Option<&str>) -> bool {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    if let Some(list) = list {
        std::fs::write(folder.path().join("dataset.toml"), list).unwrap();
    }
    match Dataset::read(folder.path()) {
        Ok(dataset) => {
            let finite = |d: &cpdmp::demonstration::Demonstration| d.trajectory.values().iter().all(|x| x.is_finite());
            assert!(!dataset.demonstrations.is_empty() && dataset.demonstrations.iter().all(finite));
            true
        }
        Err(error) => {
            assert!(!error.faults().is_empty(), "refused without a fault: {error}");
            assert!(error.to_string().len() < 100_000, "a fault longer than a book");
            false
        }
    }
}

fn sample_file(format: FileFormat) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let dataset = PickAndPlace { duration_s: 2.0, ..Default::default() }.dataset(1);
    let target = folder.path().join("set");
    dataset.write_as(&target, format).unwrap();
    std::fs::read(target.join(format!("{}.{}", dataset.demonstrations[0].name, format.extension()))).unwrap()
}

/// The Parquet library is known to panic on damaged files; the reader contains it.
#[test]
fn damaged_parquet_is_refused_and_never_panics() {
    let whole = sample_file(FileFormat::Parquet);
    assert!(accepted("a.parquet", &whole, None));
    for cut in (0..whole.len()).step_by((whole.len() / 200).max(1)) {
        assert!(!accepted("a.parquet", &whole[..cut], None), "cut at {cut}");
        // The mark at the end restored: what follows the mark is then believed.
        let _ = accepted("a.parquet", &[&whole[..cut], b"PAR1"].concat(), None);
    }
    // The footer decides about lengths and counts: every bit of it. Of the data: every 37th byte.
    let footer = u32::from_le_bytes(whole[whole.len() - 8..whole.len() - 4].try_into().unwrap()) as usize + 8;
    let data = (4..whole.len() - footer).step_by(37).map(|at| (at, 1 << (at % 8)));
    let flips = (whole.len() - footer..whole.len()).flat_map(|at| [(at, 1u8 << (at % 8)), (at, 0xff)]).chain(data);
    let refused = flips.filter(|(at, mask)| {
        let mut bytes = whole.clone();
        bytes[*at] ^= mask;
        !accepted("a.parquet", &bytes, None)
    });
    assert!(refused.count() > 100, "flips are noticed");
}

#[test]
fn parquet_of_other_programs_is_read_and_nulls_are_faults() {
    let write = |path: &Path, present: &[i16]| {
        let schema = "message m { required int64 time_ms; optional float x_m; required int32 demo; required boolean gripper; required binary note (UTF8); }";
        let schema = Arc::new(parse_message_type(schema).unwrap());
        let mut writer = SerializedFileWriter::new(std::fs::File::create(path).unwrap(), schema, Default::default()).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let values: Vec<f32> = present.iter().enumerate().filter(|(_, level)| **level == 1).map(|(i, _)| i as f32 + 0.5).collect();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int64Type>().write_batch(&[0, 500, 0, 500], None, None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<FloatType>().write_batch(&values, Some(present), None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int32Type>().write_batch(&[1, 1, 2, 2], None, None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<BoolType>().write_batch(&[false, true, false, true], None, None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        let notes: Vec<ByteArray> = ["a", "b", "c", "d"].map(ByteArray::from).to_vec();
        column.typed::<ByteArrayType>().write_batch(&notes, None, None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
        writer.close().unwrap();
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    write(&path, &[1, 1, 1, 1]);
    let dataset = Dataset::read(&path).unwrap();
    let second = &dataset.demonstrations[1];
    assert_eq!((second.name.as_str(), second.trajectory.times_s()), ("a_2", &[0.0, 0.5][..]));
    assert_eq!((second.trajectory.columns().join(","), second.trajectory.values()[(1, 0)]), ("x_m,gripper".to_owned(), 3.5));
    let list = "schema_version = 1\nmotion = [\"x_m\"]\n";
    std::fs::write(folder.path().join("dataset.toml"), list).unwrap();
    write(&path, &[1, 1, 0, 1]);
    let Err(DemonstrationError::Invalid(faults)) = Dataset::read(folder.path()) else { panic!("a null is no number") };
    assert_eq!(faults[0].to_string(), "a.parquet, row 3, column x_m: found an empty cell, expected a number with a decimal point");
}

#[test]
fn paths_that_leave_the_folder_and_things_that_are_no_files_are_refused() {
    for file in ["../a.csv", "/etc/passwd.csv", "a/../../b.csv", "", "..", "a.exe"] {
        let list = format!("schema_version = 1\nmotion = [\"x_m\"]\n[[demonstration]]\nfile = \"{file}\"\n");
        assert!(!accepted("a.csv", b"time_s,x_m\n0,1\n1,2\n", Some(&list)), "{file}");
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("a.csv")).unwrap();
    assert!(Dataset::read(folder.path()).unwrap_err().to_string().contains("no regular file"));
    let huge = std::fs::File::create(folder.path().join("b.csv")).unwrap();
    huge.set_len(1 << 40).unwrap();
    assert!(Dataset::read(&folder.path().join("b.csv")).unwrap_err().to_string().contains("1048576 MiB"), "told before reading");
    assert!(matches!(Dataset::read(Path::new("/nowhere")), Err(DemonstrationError::Io { .. })));
}

#[test]
fn a_file_of_nothing_but_faults_is_bounded() {
    let text = format!("time_s,x_m,y_m\n{}", "0,oops,\n".repeat(200_000));
    let error = {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.csv"), text).unwrap();
        std::fs::write(folder.path().join("dataset.toml"), "schema_version = 1\nmotion = [\"x_m\", \"y_m\"]\n").unwrap();
        Dataset::read(folder.path()).unwrap_err()
    };
    assert!((1000..=10_000).contains(&error.faults().len()), "{}", error.faults().len());
}

const CSV: &str = "demo,time_s,x_m,qx,qy,qz,qw,gripper\n1,0,1.5,0,0,0,1,0\n1,0.5,2.5,0,0,0,1,1\n2,0,1e-3,0,0,1,0,0.5\n2,1,-2,0,1,0,0,0\n";
const LIST: &str = "schema_version = 1\nmotion = [\"x_m\"]\nfile = \"a.csv\"\nsequence = \"demo\"\ndelimiter = \",\"\nheader = true\nrate_hz = 5\n\
    theta_f = [\"qx\"]\n[columns]\nx_m = { from = \"x_m\", unit = \"mm\" }\n[[demonstration]]\nsequence = 1\ntheta_m = { h_m = 0.5 }\n";

/// A text with some bytes replaced, removed, doubled.
fn mutated(text: &'static [u8]) -> impl Strategy<Value = Vec<u8>> {
    let pieces = prop_oneof![
        any::<u8>().prop_map(|byte| vec![byte]),
        prop::sample::select(vec![
            "nan",
            "inf",
            "1e999",
            "-",
            ",",
            ";",
            "\"",
            "\n",
            "\r",
            "#",
            "=",
            "[",
            "]]",
            "{",
            "\u{feff}",
            "99999999999999999999"
        ])
        .prop_map(|word| word.as_bytes().to_vec()),
    ];
    let edit = (0..text.len(), 0_usize..6, pieces);
    prop::collection::vec(edit, 1..6).prop_map(|edits| {
        let mut bytes = text.to_vec();
        for (at, removed, new) in edits {
            let at = at.min(bytes.len());
            let end = (at + removed).min(bytes.len());
            bytes.splice(at..end, new);
        }
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn mutated_text_is_read_or_refused(bytes in mutated(CSV.as_bytes())) {
        accepted("a.csv", &bytes, None);
        accepted("a.csv", &bytes, Some("schema_version = 1\nmotion = [\"x_m\"]\n"));
    }

    #[test]
    fn mutated_lists_are_read_or_refused(bytes in mutated(LIST.as_bytes())) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("dataset.toml"), &bytes).unwrap();
        std::fs::write(folder.path().join("a.csv"), CSV).unwrap();
        if let Err(error) = Dataset::read(folder.path()) {
            prop_assert!(!error.faults().is_empty(), "{}", error);
        }
    }

    #[test]
    fn random_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        accepted("a.csv", &bytes, None);
        accepted("a.parquet", &bytes, None);
        accepted("a.parquet", &[b"PAR1", &bytes[..], b"PAR1"].concat(), None);
    }
}
