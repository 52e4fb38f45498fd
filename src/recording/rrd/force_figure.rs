//! What is felt and what is done about it: forces as arrows and over time, the coupling's displacement, compliance and gripper.

use nalgebra::{Point3, Vector3};
use rerun::{Arrows3D, Color, EntityPath, Scalars, TextDocument};

use super::arrow::{Arrow, SMALLEST_N};
use super::camera::Camera;
use super::convert;
use super::entity_path::{
    ACTIVATION, BETA, COUPLING, EXPECTED, EXPECTED_ARROW, EXTERNAL, Entity, FORCE_COLORS, GRIPPER_COMMAND, GRIPPER_OPENING, PERSON,
    PERSON_ARROW, PERSON_FORCE, PERSON_POWER, TORQUE, WRENCH, WRENCH_ARROW,
};
use super::lanes::holds;
use super::palette;
use super::paths::{AXES, style};
use super::recorder::{Fault, Recorder};
use crate::simulation::StepRecord;

/// The person's arrow starts this far from the point where the force acts (m): at the surface of the arm, in which it could not be seen.
const ARM_RADIUS_M: f64 = 0.07;

/// Colours of the three axes, as rerun and most robot tools draw them.
const AXIS_COLORS: [Color; 3] = [palette::EXECUTED, palette::STIFF, palette::PLANNED];

/// Which colour is which force.
const MEASURED_COLOR: &str = "blue: measured, smoothed";
const MODEL_COLORS: &str = "\nyellow: expected\nwhite: unexpected";
const PERSON_COLOR: &str = "\nvermilion: person";

/// Which forces there are besides the measured one.
#[derive(Clone, Copy)]
pub(super) struct Told {
    /// Whether the skill knows what force to expect.
    pub expected: bool,
    /// Whether a person may help.
    pub person: bool,
}

/// Logs all forces and what answers them, as a camera sees them.
pub(super) fn log_forces(recorder: &Recorder, records: &[StepRecord], told: Told, camera: &Camera) -> Result<(), Fault> {
    let arrow = Arrow::seen_by(camera);
    let tool = |r: &StepRecord| Point3::from(r.tool.translation.vector);
    let measured = |r: &StepRecord| Vector3::from(r.wrench.fixed_rows::<3>(0));
    let arrows = Arrows { recorder, records, arrow };
    arrows.log(&WRENCH_ARROW, palette::MEASURED, |r| (arrow.beside(&tool(r), 1, &r.expected_force), measured(r)))?;
    if told.expected {
        arrows.log(&EXPECTED_ARROW, palette::EXPECTED, |r| (arrow.beside(&tool(r), 2, &r.expected_force), r.expected_force))?;
    }
    arrows.log(&PERSON_ARROW, palette::PERSON, |r| (r.human.point + to_surface(&r.human.force), r.human.force))?;
    let colors = [(MEASURED_COLOR, true), (MODEL_COLORS, told.expected), (PERSON_COLOR, told.person)];
    let colors: String = colors.into_iter().filter_map(|(color, there)| there.then_some(color)).collect();
    recorder.always(FORCE_COLORS.path(), &TextDocument::new(colors))?;
    let plot = Plot { recorder, records };
    for (i, axis) in AXES.iter().enumerate() {
        plot.log(WRENCH.of(&[axis]), "measured", palette::MEASURED, |r| r.wrench[i])?;
        if told.expected {
            plot.log(EXPECTED.of(&[axis]), "expected", palette::EXPECTED, |r| r.expected_force[i])?;
            plot.log(EXTERNAL.of(&[axis]), "unexpected", palette::TOUCH, |r| r.wrench[i] - r.expected_force[i])?;
        }
        if told.person {
            plot.log(PERSON.of(&[axis]), "person", palette::PERSON, |r| r.human.force[i])?;
        }
        plot.log(TORQUE.of(&[axis]), axis, AXIS_COLORS[i], |r| r.wrench[3 + i])?;
        plot.log(COUPLING.of(&[axis]), axis, AXIS_COLORS[i], |r| r.coupling_displacement[i])?;
    }
    plot.log(PERSON_FORCE.path(), "force (N)", palette::PERSON, |r| r.human.force.norm())?;
    log_power(&plot)?;
    plot.log(BETA.path(), "beta", palette::COMPLIES, |r| r.beta)?;
    plot.log(ACTIVATION.path(), "activation", palette::EXECUTED, |r| r.activation)?;
    plot.log(GRIPPER_COMMAND.path(), "commanded", palette::PLANNED, |r| r.gripper_command)?;
    plot.log(GRIPPER_OPENING.path(), "measured", palette::EXECUTED, |r| r.gripper_opening)
}

/// Power of the person: force times velocity of the point where it acts, by differences of neighbouring records.
fn log_power(plot: &Plot) -> Result<(), Fault> {
    let entity = PERSON_POWER.path();
    plot.recorder.always(entity.clone(), &style("power (W)", palette::EXECUTED, 1.5))?;
    let of_pair = |pair: &[StepRecord]| {
        let (before, after) = (&pair[0], &pair[1]);
        let way = after.human.point - before.human.point;
        if holds(before) && holds(after) { after.human.force.dot(&way) / (after.time_s - before.time_s) } else { 0.0 }
    };
    // The first record has none before it: its pair is that of the second.
    let pairs: Vec<f64> = plot.records.windows(2).map(of_pair).collect();
    let first = plot.records.first().map(|_| pairs.first().copied().unwrap_or(0.0));
    let values: Vec<f64> = first.into_iter().chain(pairs).collect();
    plot.recorder.every_step(entity, Scalars::new(values).columns_of_unit_batches()?)
}

/// From the point where a force acts to the surface of the arm, in the direction of the force (m).
pub(super) fn to_surface(force: &Vector3<f64>) -> Vector3<f64> {
    force.try_normalize(0.0).unwrap_or_default() * ARM_RADIUS_M
}

struct Plot<'a> {
    recorder: &'a Recorder,
    records: &'a [StepRecord],
}

impl Plot<'_> {
    fn log(&self, entity: EntityPath, name: &str, color: Color, value: impl Fn(&StepRecord) -> f64) -> Result<(), Fault> {
        self.recorder.always(entity.clone(), &style(name, color, 1.5))?;
        let values: Vec<f64> = self.records.iter().map(value).collect();
        self.recorder.every_step(entity, Scalars::new(values).columns_of_unit_batches()?)
    }
}

struct Arrows<'a> {
    recorder: &'a Recorder,
    records: &'a [StepRecord],
    arrow: Arrow,
}

impl Arrows<'_> {
    /// One arrow per record, none where the force is too small to see.
    fn log(&self, entity: &Entity, color: Color, force: impl Fn(&StepRecord) -> (Point3<f64>, Vector3<f64>)) -> Result<(), Fault> {
        let forces: Vec<_> = self.records.iter().map(force).collect();
        let visible = |(_, force): &(Point3<f64>, Vector3<f64>)| force.norm() >= SMALLEST_N;
        let drawn = || forces.iter().filter(|arrow| visible(arrow));
        let arrows = Arrows3D::update_fields()
            .with_vectors(drawn().map(|(_, force)| convert::vector(&self.arrow.of(force))))
            .with_origins(drawn().map(|(point, _)| convert::vector(&point.coords)));
        let lengths: Vec<usize> = forces.iter().map(|arrow| usize::from(visible(arrow))).collect();
        self.recorder.always(entity.path(), &self.arrow.look(color))?;
        self.recorder.every_step(entity.path(), arrows.columns(lengths)?)
    }
}
