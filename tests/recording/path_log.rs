//! Contract: the path log gives back every bit of every path, under documented columns.

use std::fs::File;

use cpdmp::recording::{LoggedPath, PATH_COLUMNS, write_path_log};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

#[test]
fn every_point_comes_back_to_the_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("paths.parquet");
    let [first, second] = [[[1.0 / 3.0, -0.0], [1e-300, 2.0], [3.0, f64::MAX]], [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]]];
    let paths = [("CPDMP", "goal_1", &first), ("LWR-DMP", "goal_1", &second)].map(|(method, setting, points)| LoggedPath {
        method,
        setting,

        points_m: points,
    });
    write_path_log(&path, &paths).expect("written");

    let reader = SerializedFileReader::new(File::open(&path).expect("there")).expect("Parquet");
    let keys = reader.metadata().file_metadata().key_value_metadata().expect("keys").clone();
    for (name, meaning) in PATH_COLUMNS {
        let key = format!("column.{name}");
        assert!(keys.iter().any(|entry| entry.key == key && entry.value.as_deref() == Some(meaning)), "{name}");
    }
    let rows: Vec<_> = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row")).collect();
    let expected =
        paths.iter().flat_map(|path| [0.0, 0.5, 1.0].into_iter().zip(path.points_m).map(move |(time, point)| (path, time, point)));
    assert_eq!(rows.len(), 6);
    for (row, (path, time, point)) in rows.iter().zip(expected) {
        assert_eq!((row.get_string(0).expect("text").as_str(), row.get_string(1).expect("text").as_str()), (path.method, path.setting));
        let bits = [2, 3, 4].map(|column| row.get_double(column).expect("a number").to_bits());
        assert_eq!(bits, [time, point[0], point[1]].map(f64::to_bits));
    }
}
