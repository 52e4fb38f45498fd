//! The columns of a step log: one table that gives the schema, the values and the documentation.

use nalgebra::{Isometry3, Vector3};

use crate::simulation::StepRecord;

/// A column of a step log.
pub struct StepColumn {
    /// Its name, which ends in the unit (SI); without one it is a pure number.
    pub name: String,
    /// What it holds.
    pub meaning: String,
    pub(super) value: StepValue,
}

/// How a column gets its value from a record.
pub(super) enum StepValue {
    /// A whole number.
    Integer(fn(&StepRecord) -> i64),
    /// A real number.
    Real(Box<dyn Fn(&StepRecord) -> f64>),
    /// A real number that a force model expects: none without one.
    Expected(fn(&StepRecord) -> f64),
}

/// The columns of the step log of an arm with `joints` joints in a scene of these objects, in the order of the file.
///
/// World frame, SI; quaternions are scalar last. An object whose name would repeat a column's gets `object_` in front.
#[must_use]
pub fn step_columns(joints: usize, objects: &[&str]) -> Vec<StepColumn> {
    let mut table = Table(Vec::new());
    table.integer("step", "number of the engine step", |r| r.step as i64);
    table.real("time_s", "simulated time", |r| r.time_s);
    table.joints(joints, "q", "_rad", "angle", |r| &r.joint_position);
    table.joints(joints, "v", "_rad_per_s", "velocity", |r| &r.joint_velocity);
    table.joints(joints, "effort", "_nm", "measured effort of the drive", |r| &r.joint_effort);
    table.pose("tool", "tool frame (grasp centre)", |r| Some(r.tool));
    table.pose("reference", "pose that the controller wants the tool to have", |r| Some(r.reference));
    table.vector("force", "_n", "force of the environment on the tool, as the controller estimates it", |r| {
        r.wrench.fixed_rows::<3>(0).into()
    });
    table.vector("torque", "_nm", "torque of the environment about the tool, as the controller estimates it", |r| {
        r.wrench.fixed_rows::<3>(3).into()
    });
    table.expected("x", |r| r.expected_force.x);
    table.expected("y", |r| r.expected_force.y);
    table.expected("z", |r| r.expected_force.z);
    table.vector("coupling", "_m", "displacement zeta/K that the coupling term asks for", |r| r.coupling_displacement);
    table.vector("deviation", "_m", "how far forces have moved the reference from the plan", |r| r.deviation);
    table.real("phase", "phase s of the canonical system, from 1 towards 0", |r| r.phase);
    table.real("time_fraction", "elapsed fraction u of the skill's duration", |r| r.time_fraction);
    table.integer("state", "active HMM state, from 0", |r| r.state as i64);
    table.real("beta", "its beta: 0 stiff, -1 complies, +1 minimises the force error", |r| r.beta);
    table.real("activation", "how far the coupling is switched on, 0 to 1", |r| r.activation);
    table.real("gripper_command", "commanded opening of the gripper, 0 closed to 1 open", |r| r.gripper_command);
    table.real("gripper_opening", "measured opening of the gripper, 0 closed to 1 open", |r| r.gripper_opening);
    table.vector("tool_force", "_n", "force of the objects on fingers and tool, as the engine solved it", |r| r.tool_force);
    table.vector("tool_impulse", "_ns", "integral of that force over every engine step since the start", |r| r.tool_impulse);
    table.vector("human_force", "_n", "force of the person on the arm", |r| r.human.force);
    table.vector("human_point", "_m", "where the person's force acts", |r| r.human.point.coords);
    for (index, object) in objects.iter().enumerate() {
        table.object(index, object);
    }
    table.real("kinetic_energy_j", "kinetic energy of the robot and the objects", |r| r.kinetic_energy_j);
    table.0
}

struct Table(Vec<StepColumn>);

impl Table {
    fn integer(&mut self, name: &str, meaning: &str, value: fn(&StepRecord) -> i64) {
        self.0.push(StepColumn { name: name.into(), meaning: meaning.into(), value: StepValue::Integer(value) });
    }

    fn real(&mut self, name: &str, meaning: &str, value: impl Fn(&StepRecord) -> f64 + 'static) {
        self.0.push(StepColumn { name: name.into(), meaning: meaning.into(), value: StepValue::Real(Box::new(value)) });
    }

    /// `expected_force_x_n` and so on.
    fn expected(&mut self, axis: &str, value: fn(&StepRecord) -> f64) {
        let meaning = format!("force that the force model expects, {axis}; null for a skill without one");
        self.0.push(StepColumn { name: format!("expected_force_{axis}_n"), meaning, value: StepValue::Expected(value) });
    }

    /// `q1_rad`, `q2_rad` …
    fn joints(&mut self, joints: usize, prefix: &str, unit: &str, meaning: &str, values: fn(&StepRecord) -> &Vec<f64>) {
        for joint in 0..joints {
            let number = joint + 1;
            let meaning = format!("{meaning} of joint {number} of the working arm, from the shoulder");
            self.real(&format!("{prefix}{number}{unit}"), &meaning, move |r| values(r).get(joint).copied().unwrap_or(f64::NAN));
        }
    }

    /// `force_x_n`, `force_y_n`, `force_z_n`.
    fn vector(&mut self, prefix: &str, unit: &str, meaning: &str, value: impl Fn(&StepRecord) -> Vector3<f64> + Copy + 'static) {
        for (i, axis) in ["x", "y", "z"].iter().enumerate() {
            self.real(&format!("{prefix}_{axis}{unit}"), &format!("{meaning}, {axis}"), move |r| value(r)[i]);
        }
    }

    /// `tool_x_m` … `tool_qw`; NaN where a record has no such pose.
    fn pose(&mut self, prefix: &str, meaning: &str, value: impl Fn(&StepRecord) -> Option<Isometry3<f64>> + Copy + 'static) {
        let place = move |r: &StepRecord| value(r).map_or_else(|| Vector3::repeat(f64::NAN), |pose| pose.translation.vector);
        self.vector(prefix, "_m", &format!("{meaning}: position"), place);
        for (i, axis) in ["qx", "qy", "qz", "qw"].iter().enumerate() {
            let turn = move |r: &StepRecord| value(r).map_or(f64::NAN, |pose| pose.rotation.coords[i]);
            self.real(&format!("{prefix}_{axis}"), &format!("{meaning}: orientation quaternion, {axis}"), turn);
        }
    }

    fn object(&mut self, index: usize, name: &str) {
        let taken = self.0.iter().any(|column| column.name == format!("{name}_x_m"));
        let prefix = if taken { format!("object_{name}") } else { name.to_owned() };
        self.pose(&prefix, &format!("object `{name}`"), move |r| r.objects.get(index).copied());
    }
}
