//! Columns that are probably not what they are taken for: orientations and forces under names that are not known for them.

use super::{Dataset, QUATERNION_COLUMNS};

/// What to think of the columns of the first demonstration, a sentence each.
pub(super) fn lookalikes(dataset: &Dataset) -> Vec<String> {
    let columns = dataset.demonstrations.first().map_or(&[][..], |demonstration| demonstration.trajectory.columns());
    let taken = |name: &String| if dataset.motion.contains(name) { "learned as motion" } else { "left out" };
    let mut told: Vec<String> = Vec::new();
    for name in columns.iter().filter(|name| !dataset.wrench.contains(name)) {
        if let Some(four) = quaternion(name, columns) {
            told.push(format!(
                "{} look like a quaternion, and are {}: orientations are known as {}, or by `quaternion` under [columns] of dataset.toml",
                four.join(", "),
                taken(name),
                QUATERNION_COLUMNS.join(", ")
            ));
        } else if name.ends_with("_n") || name.ends_with("_nm") {
            told.push(format!(
                "{name} looks like a force or torque, and is {}: name it in `wrench` of dataset.toml, or fx_n … tz_nm",
                taken(name)
            ));
        }
    }
    told
}

/// The four columns of a quaternion under other names, when this is their `w`: equal but for the letter.
fn quaternion(w: &str, columns: &[String]) -> Option<[String; 4]> {
    let stem = w.strip_suffix(['w', 'W'])?;
    let component = |letter: &str| {
        let is_it = |name: &&String| name.strip_prefix(stem).is_some_and(|last| last.eq_ignore_ascii_case(letter));
        columns.iter().find(is_it).filter(|name| !QUATERNION_COLUMNS.contains(&name.as_str())).cloned()
    };
    Some([component("x")?, component("y")?, component("z")?, component("w")?])
}
