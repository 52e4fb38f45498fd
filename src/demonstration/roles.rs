//! Which columns the two models learn: as listed, or by their names.

use super::list::List;
use super::notes::Notes;
use super::{Demonstration, Fault, GRIPPER_COLUMN, QUATERNION_COLUMNS};

/// The columns of the motion model and of the force model. Without a list, force and torque are known by their names and everything
/// else moves; then all demonstrations must have the columns of the first.
pub(super) fn columns(
    list: &List,
    demonstrations: &[Demonstration],
    notes: &mut Notes,
    faults: &mut Vec<Fault>,
) -> (Vec<String>, Vec<String>) {
    let wrench = list.wrench.clone();
    if let Some(motion) = &list.motion {
        return (motion.clone(), wrench.unwrap_or_default());
    }
    let all = demonstrations.first().map_or(&[][..], |demonstration| demonstration.trajectory.columns());
    let wrench = wrench.unwrap_or_else(|| all.iter().filter(|name| is_wrench(name)).cloned().collect());
    let other = |name: &str| QUATERNION_COLUMNS.contains(&name) || name == GRIPPER_COLUMN || is_wrench(name);
    let motion: Vec<String> = all.iter().filter(|name| !other(name) && !wrench.contains(name)).cloned().collect();
    notes.add("", format!("columns by their names: motion [{}], wrench [{}]", motion.join(", "), wrench.join(", ")));
    for demonstration in demonstrations.iter().skip(1) {
        let extra = demonstration.trajectory.columns().iter().filter(|name| !all.contains(name));
        let fault = |name: &String| {
            let found = format!("a column that {} does not have", demonstrations[0].name);
            Fault::new(&demonstration.name, found, "the same columns in all files, or a list `motion` in dataset.toml").in_column(name)
        };
        faults.extend(extra.map(fault));
    }
    (motion, wrench)
}

/// `fx_n` … and `tx_nm` …: force and torque by their names.
fn is_wrench(name: &str) -> bool {
    let bytes = name.as_bytes();
    (bytes.len() == 4 && bytes[0] == b'f' && name.ends_with("_n")) || (bytes.len() == 5 && bytes[0] == b't' && name.ends_with("_nm"))
}
