//! The plane: obstacles, demonstrations, and the paths of every method (the paper's Figs. 1 to 3).

use rerun::{Color, LineStrips2D, Points2D, Radius, Transform3D};

use super::palette;
use super::planar_entity::{COLLISIONS, DEMONSTRATIONS, GOALS, GRID, GRID_NUMBERS, MAP, OBSTACLES, PLACES, TAUGHT, UNSEEN};
use super::planar_recorder::PlanarRecorder;
use super::recorder::Fault;
use crate::math::ellipse_outline;
use crate::planar::{Case, Guidance, Method, Movement, Obstacle, PlanarOutcome, obstacles};

/// Lines at whole metres, on white, behind everything.
const GRID_COLOR: Color = palette::rgb(crate::palette::Rgb::new(205, 205, 205));
/// Widths of lines on the screen (pt): of the grid, of what was taught and of what was not. Thinner ones break into dots.
const GRID_PT: f32 = 1.2;
const TAUGHT_PT: f32 = 1.3;
const UNSEEN_PT: f32 = 2.4;
/// So many metres at most are written along an axis.
const MOST_NUMBERS: usize = 5;

/// Logs everything in the plane.
pub(super) fn log_map(recorder: &PlanarRecorder, outcome: &PlanarOutcome) -> Result<(), Fault> {
    let up = Transform3D::from_mat3x3([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]);
    recorder.always(MAP.path(), &up)?;
    recorder.always(GRID.path(), &strips(grid(bounds(outcome)), GRID_COLOR, GRID_PT))?;
    numbers(recorder, bounds(outcome))?;
    let obstacles = obstacles(&outcome.cases);
    let outline = |one: &Obstacle| closed(ellipse_outline(one.ellipse.centre_m, one.ellipse.half_axes_m));
    let outlines = strips(obstacles.iter().map(outline).collect(), palette::IDLE, 1.5);
    let colors = obstacles.iter().map(|one| one.color().map_or(palette::IDLE, palette::rgb));
    recorder.always(
        OBSTACLES.path(),
        &outlines.with_colors(colors).with_labels(obstacles.iter().map(Obstacle::name)).with_show_labels(false),
    )?;
    let shown = outcome.demonstrations.iter().map(|shown| points(&shown.path_m)).collect();
    recorder.always(DEMONSTRATIONS.path(), &strips(shown, palette::TAUGHT, TAUGHT_PT))?;
    goals(recorder, outcome)?;
    for guidance in outcome.guidances() {
        for method in outcome.methods_with(guidance) {
            Drawn { recorder, outcome, obstacles: &obstacles, guidance, method }.log()?;
        }
    }
    Ok(())
}

/// The least and the greatest coordinate on each axis (m) of anything that moves, with a little space around.
pub(super) fn bounds(outcome: &PlanarOutcome) -> [[f64; 2]; 2] {
    let shown = outcome.demonstrations.iter().flat_map(|shown| &shown.path_m);
    let moved = outcome.cases.iter().flat_map(|case| &case.movements).flat_map(|movement| &movement.path_m);
    let places: Vec<&[f64; 2]> = shown.chain(moved).collect();
    [0, 1].map(|axis| {
        let values = places.iter().map(|place| place[axis]).filter(|value| value.is_finite());
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        let space = 0.05 * (high - low).max(1.0);
        [low - space, high + space]
    })
}

/// One method that is told one thing.
struct Drawn<'a> {
    recorder: &'a PlanarRecorder,
    outcome: &'a PlanarOutcome,
    obstacles: &'a [Obstacle],
    guidance: Guidance,
    method: Method,
}

impl<'a> Drawn<'a> {
    fn log(&self) -> Result<(), Fault> {
        let names = [self.guidance.key(), self.method.key()];
        for (entity, taught, width) in [(TAUGHT, true, TAUGHT_PT), (UNSEEN, false, UNSEEN_PT)] {
            let of_kind: Vec<_> = self.movements().filter(|(case, _)| case.taught == taught).collect();
            let labels = of_kind.iter().map(|(case, _)| case.name.clone());
            let paths = strips(of_kind.iter().map(|(_, movement)| points(&movement.path_m)).collect(), palette::IDLE, width);
            let colors = of_kind.iter().map(|(case, _)| self.color(case));
            self.recorder.always(entity.of(&names), &paths.with_colors(colors).with_labels(labels).with_show_labels(false))?;
        }
        let hits = self.movements().filter(|(_, movement)| movement.collides).filter_map(|(case, movement)| deepest(case, movement));
        let hits = Points2D::new(points(&hits.collect::<Vec<_>>())).with_colors([palette::PERSON]).with_radii([Radius::new_ui_points(6.0)]);
        self.recorder.always(COLLISIONS.of(&names), &hits)?;
        self.places(&names)
    }

    /// Of several obstacles each has a colour, and so has what passes it; else it is the method's.
    fn color(&self, case: &Case) -> Color {
        let of_obstacle = self.obstacles.iter().find(|one| one.ellipse == case.obstacle).and_then(Obstacle::color);
        palette::rgb(of_obstacle.unwrap_or(self.method.color()))
    }

    /// Where the movements are at each phase.
    fn places(&self, names: &[&str]) -> Result<(), Fault> {
        let entity = PLACES.of(names);
        let paths: Vec<&[[f64; 2]]> = self.movements().map(|(_, movement)| movement.path_m.as_slice()).collect();
        let samples = paths.iter().map(|path| path.len()).min().unwrap_or(0);
        let inputs: Vec<f64> = (0..samples).map(|t| self.input_at(t as f64 / (samples.max(2) - 1) as f64)).collect();
        let rows = (0..samples).flat_map(|t| paths.iter().map(move |path| point(&path[t])));
        let columns = Points2D::update_fields().with_positions(rows).columns(std::iter::repeat_n(paths.len(), samples))?;
        let look = Points2D::update_fields()
            .with_colors(self.movements().map(|(case, _)| self.color(case)))
            .with_radii([Radius::new_ui_points(4.0)]);
        self.recorder.always(entity.clone(), &look)?;
        self.recorder.over_phase(entity, &inputs, columns)
    }

    fn movements(&self) -> impl Iterator<Item = (&'a Case, &'a Movement)> {
        let (outcome, method) = (self.outcome, self.method);
        outcome.cases_with(self.guidance).flat_map(move |case| case.of(method).map(move |movement| (case, movement)))
    }

    /// The models' phase input at the time fraction `u`: curves are sampled at equal fractions.
    fn input_at(&self, u: f64) -> f64 {
        let Some(curve) = self.outcome.forcing.iter().find(|curve| curve.method.is_some() && curve.phase.len() > 1) else { return u };
        let at = u * (curve.phase.len() - 1) as f64;
        let before = (at as usize).min(curve.phase.len() - 2);
        curve.phase[before] + (curve.phase[before + 1] - curve.phase[before]) * (at - before as f64)
    }
}

fn goals(recorder: &PlanarRecorder, outcome: &PlanarOutcome) -> Result<(), Fault> {
    let mut goals: Vec<([f64; 2], bool)> = Vec::new();
    for case in &outcome.cases {
        if goals.iter().all(|(goal, _)| *goal != case.goal_m) {
            goals.push((case.goal_m, case.taught));
        }
    }
    let colors = goals.iter().map(|(_, taught)| if *taught { palette::IDLE } else { palette::rgb(crate::palette::YELLOW) });
    let places: Vec<[f64; 2]> = goals.iter().map(|(goal, _)| *goal).collect();
    recorder.always(GOALS.path(), &Points2D::new(points(&places)).with_colors(colors).with_radii([Radius::new_ui_points(4.0)]))
}

/// Whole metres within bounds (m).
fn whole([low, high]: [f64; 2]) -> std::ops::RangeInclusive<i64> {
    low.ceil() as i64..=high.floor() as i64
}

/// What is seen of a plane with these bounds (m): at the left and below there is room for numbers, which would lie on paths.
pub(super) fn with_numbers([x, y]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let lower = |[low, high]: [f64; 2], share: f64| [low - share * (high - low), high];
    [lower(x, 0.14), lower(y, 0.06)]
}

/// Some of the whole metres within bounds (m), as numbers at the left and below.
fn numbers(recorder: &PlanarRecorder, [x, y]: [[f64; 2]; 2]) -> Result<(), Fault> {
    let few = |bounds: [f64; 2]| {
        let of = |step: i64| whole(bounds).filter(move |at| at % step == 0).collect::<Vec<_>>();
        [1, 2, 5, 10, 20, 50].map(of).into_iter().find(|some| some.len() <= MOST_NUMBERS).unwrap_or_default()
    };
    let [[left, _], _] = with_numbers([x, y]);
    let beside = few(y).into_iter().map(|at| ([(left + x[0]) / 2.0, at as f64], at));
    // The viewer writes below the place.
    let below = few(x).into_iter().map(|at| ([at as f64, y[0]], at));
    let (places, metres): (Vec<[f64; 2]>, Vec<i64>) = below.chain(beside).unzip();
    let labels = Points2D::new(points(&places))
        .with_labels(metres.iter().map(|at| format!("{at} m")))
        .with_colors([palette::IDLE])
        .with_radii([Radius::new_ui_points(0.0)])
        .with_show_labels(true);
    recorder.always(GRID_NUMBERS.path(), &labels)
}

/// Lines at whole metres within bounds (m).
fn grid([x, y]: [[f64; 2]; 2]) -> Vec<Vec<[f32; 2]>> {
    let upright = whole(x).map(|at| vec![point(&[at as f64, y[0]]), point(&[at as f64, y[1]])]);
    let level = whole(y).map(|at| vec![point(&[x[0], at as f64]), point(&[x[1], at as f64])]);
    upright.chain(level).collect()
}

/// The point of a path that is deepest inside the obstacle (m).
fn deepest(case: &Case, movement: &Movement) -> Option<[f64; 2]> {
    let depth = |point: &&[f64; 2]| case.obstacle.signed_distance(**point);
    movement.path_m.iter().min_by(|a, b| depth(a).total_cmp(&depth(b))).copied()
}

fn closed(mut outline: Vec<[f64; 2]>) -> Vec<[f32; 2]> {
    outline.extend(outline.first().copied());
    points(&outline)
}

fn points(path: &[[f64; 2]]) -> Vec<[f32; 2]> {
    path.iter().map(point).collect()
}

fn point(place: &[f64; 2]) -> [f32; 2] {
    place.map(|coordinate| coordinate as f32)
}

/// Lines of one colour, `width` points wide on the screen.
fn strips(lines: Vec<Vec<[f32; 2]>>, color: Color, width: f32) -> LineStrips2D {
    LineStrips2D::new(lines).with_colors([color]).with_radii([Radius::new_ui_points(width / 2.0)])
}
