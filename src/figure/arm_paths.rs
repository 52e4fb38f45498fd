//! The tool's paths in space, from above and from the side, with the ellipses of the states, and how far they are beside the arc of a door (the
//! paper's Fig. 6b).

use nalgebra::{Matrix2, Point3};

use super::arc::Arc;
use super::arm_run::{ArmRun, Curve, DEVIATIONS, EXECUTED_PT, OTHERS_PT, PLANNED_PT, kind_of};
use super::chart::{Axis, Chart, Figure};
use super::mark::{Mark, Symbol};
use crate::learning::TaskSpaceState;
use crate::math::covariance_outline;
use crate::palette::BLACK;
use crate::palette::meaning::{EXECUTED, PLANNED, TAUGHT};
use crate::simulation::StepRecord;

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [340.0, 330.0];
/// What is seen: the axes to the right and upwards.
const VIEWS: [(&str, [usize; 2]); 3] = [("From above", [0, 1]), ("From the robot's front", [1, 2]), ("From the robot's right", [0, 2])];
const AXES: [&str; 3] = ["x", "y", "z"];
/// What the legend calls the way of a handle.
const ARC: &str = "arc of the handle about its hinge";
/// A coordinate in which everything stays within this (m) is seen as a line: views in which less moves than in others are left out.
const MOVES_M: f64 = 0.01;

/// One panel per view of the taught, planned and executed paths, then one per arc of a door; none when the skill does not move all three
/// coordinates. Plans of what stands beside the run are dashed.
#[must_use]
pub fn arm_paths(run: &ArmRun) -> Option<Figure> {
    let columns = AXES.map(|axis| format!("{axis}_m"));
    let [Some(x), Some(y), Some(z)] = columns.each_ref().map(|column| run.planned(column)) else { return None };
    let paths = Paths { run, taught: columns.each_ref().map(|column| run.taught(column)), planned: [x, y, z] };
    let moves = paths.moves();
    let moving = |axes: &[usize; 2]| axes.iter().filter(|axis| moves[**axis]).count();
    let most = VIEWS.iter().map(|(_, axes)| moving(axes)).max();
    let views = VIEWS.iter().filter(|(_, axes)| Some(moving(axes)) == most);
    let mut panels: Vec<Chart> = views.map(|(title, axes)| paths.view(title, *axes)).collect();
    panels.extend(run.arcs.iter().map(|arc| paths.beside_arc(arc)));
    let columns = panels.len().min(2);
    Some(Figure { title: format!("Paths of the tool: {}", run.name), panels, columns, panel_size_pt: PANEL_PT })
}

/// Taught and planned coordinates over time.
struct Paths<'a> {
    run: &'a ArmRun<'a>,
    taught: [Vec<Curve>; 3],
    planned: [Curve; 3],
}

impl Paths<'_> {
    /// Which coordinates change.
    fn moves(&self) -> [bool; 3] {
        [0, 1, 2].map(|axis| {
            let known = self.taught[axis].iter().chain([&self.planned[axis]]).flatten().map(|[_, value]| *value);
            let all = known.chain(self.run.steps.iter().map(|step| step.tool.translation.vector[axis]));
            let [low, high] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
            high - low > MOVES_M
        })
    }

    fn view(&self, title: &str, axes: [usize; 2]) -> Chart {
        let run = self.run;
        let mut chart = Chart::map(title, axes.map(|axis| Axis::new(&format!("{} (m)", AXES[axis]))));
        let pairs = self.taught[axes[0]].iter().zip(&self.taught[axes[1]]);
        chart.marks.extend(pairs.map(|(a, b)| Mark::line("taught", TAUGHT, 0.6, across(a, b))));
        chart.marks.extend(self.states(axes));
        chart.marks.push(Mark::line("planned", PLANNED, PLANNED_PT, across(&self.planned[axes[0]], &self.planned[axes[1]])));
        let path = |steps: &[StepRecord]| steps.iter().map(|step| axes.map(|axis| step.tool.translation.vector[axis])).collect::<Curve>();
        chart.marks.extend(run.others(OTHERS_PT, |steps| Some(path(steps))));
        chart.marks.extend(run.other_plans().map(|(name, color, plan)| {
            Mark::dashes(&name, color, EXECUTED_PT, plan.iter().map(|(_, place)| axes.map(|axis| place[axis])).collect())
        }));
        let executed = path(run.steps);
        let start = executed.first().copied();
        chart.marks.push(Mark::line("executed", EXECUTED, EXECUTED_PT, executed));
        let arcs = run.arcs.iter().map(|arc| arc.points.iter().map(|place| axes.map(|axis| place[axis])).collect());
        chart.marks.extend(arcs.map(|arc| Mark::dashes(ARC, BLACK, 0.8, arc)));
        chart.marks.push(Mark::symbols("start", BLACK, Symbol::Ring, 3.0, start.into_iter().collect()));
        chart
    }

    /// The ellipses of the states, as far as the skill moves both coordinates.
    fn states(&self, axes: [usize; 2]) -> Vec<Mark> {
        let place = |axis: usize| self.run.skill.motion.columns.iter().position(|known| *known == format!("{}_m", AXES[axis]));
        let [Some(a), Some(b)] = axes.map(place) else { return Vec::new() };
        let ellipse = |state: &TaskSpaceState| {
            let spread = Matrix2::from_fn(|i, j| state.between[([a, b][i], [a, b][j])]);
            let (color, legend) = kind_of(state.beta);
            Mark::area(legend, color, 0.15, covariance_outline([state.position[a], state.position[b]], &spread, DEVIATIONS))
        };
        self.run.states.iter().map(ellipse).collect()
    }

    /// How far everything is outside of the arc over time. Lessons are not drawn: most of them followed the arcs of other handles.
    fn beside_arc(&self, arc: &Arc) -> Chart {
        let run = self.run;
        let outside_mm = |place: &Point3<f64>| arc.outside_m(place) * 1e3;
        let of_steps = |steps: &[StepRecord]| -> Curve {
            steps.iter().map(|step| [step.time_s, outside_mm(&Point3::from(step.tool.translation.vector))]).collect()
        };
        let mut chart = Chart::plot("Beside the arc", [Axis::new("time (s)"), Axis::new("distance from the arc, outwards (mm)")]);
        chart.marks.extend(run.stretches());
        let [x, y, z] = &self.planned;
        let planned = x.iter().zip(y).zip(z).map(|((x, y), z)| [x[0], outside_mm(&Point3::new(x[1], y[1], z[1]))]).collect();
        chart.marks.push(Mark::line("planned", PLANNED, PLANNED_PT, planned));
        chart.marks.extend(run.others(OTHERS_PT, |steps| Some(of_steps(steps))));
        chart.marks.extend(run.other_plans().map(|(name, color, plan)| {
            Mark::dashes(&name, color, EXECUTED_PT, plan.iter().map(|(time_s, place)| [*time_s, outside_mm(place)]).collect())
        }));
        chart.marks.push(Mark::line("executed", EXECUTED, EXECUTED_PT, of_steps(run.steps)));
        let end_s = run.steps.last().map_or(run.duration_s, |step| step.time_s);
        chart.marks.push(Mark::dashes(ARC, BLACK, 0.8, vec![[0.0, 0.0], [end_s, 0.0]]));
        chart
    }
}

/// Two curves over one time as a path.
fn across(right: &Curve, up: &Curve) -> Curve {
    right.iter().zip(up).map(|(a, b)| [a[1], b[1]]).collect()
}
