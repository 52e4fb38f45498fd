//! The paths of a method in the plane, where they hit, and where its movements are at each phase.

use std::cmp::Reverse;

use rerun::{Color, LineStrips2D, Points2D, Radius};

use super::palette;
use super::planar_entity::{COLLISIONS, PLACES, TAUGHT, UNSEEN};
use super::planar_recorder::PlanarRecorder;
use super::planar_shapes::{ON_TOP, point, points, strips};
use super::recorder::Fault;
use crate::planar::{Case, Guidance, Method, Movement, Obstacle, PlanarOutcome, rank};

/// How paths of a kind are drawn. Thinner lines lie on wider ones: paths that are the same are all seen.
#[derive(Clone, Copy)]
struct Look {
    /// Width on the screen (pt) of a path past the narrowest obstacle. Much thinner lines break into dots.
    narrowest_pt: f32,
    /// How much wider the path past the next wider obstacle is (pt).
    wider_pt: f32,
    /// What has more lies on top (-); other lines have 20, but what has no order lies below all that has one.
    order: f32,
}

const TAUGHT_LOOK: Look = Look { narrowest_pt: 1.3, wider_pt: 0.9, order: 22.0 };
const UNSEEN_LOOK: Look = Look { narrowest_pt: 2.4, wider_pt: 1.2, order: 21.0 };

impl Look {
    /// The width (pt) of a path past the obstacle of a rank.
    fn width_pt(self, rank: usize) -> f32 {
        self.narrowest_pt + self.wider_pt * rank as f32
    }
}

/// One method that is told one thing.
pub(super) struct Drawn<'a> {
    pub recorder: &'a PlanarRecorder,
    pub outcome: &'a PlanarOutcome,
    pub obstacles: &'a [Obstacle],
    pub guidance: Guidance,
    pub method: Method,
}

impl<'a> Drawn<'a> {
    /// Logs its paths, its collisions and where its movements are.
    pub fn log(&self) -> Result<(), Fault> {
        let names = [self.guidance.key(), self.method.key()];
        for (entity, taught, look) in [(TAUGHT, true, TAUGHT_LOOK), (UNSEEN, false, UNSEEN_LOOK)] {
            self.recorder.always(entity.of(&names), &self.paths(taught, look))?;
        }
        let hits = self.movements().filter(|(_, movement)| movement.collides).filter_map(|(case, movement)| deepest(case, movement));
        let hits = Points2D::new(points(&hits.collect::<Vec<_>>()))
            .with_colors([palette::PERSON])
            .with_radii([Radius::new_ui_points(6.0)])
            .with_draw_order(ON_TOP + 1.0);
        self.recorder.always(COLLISIONS.of(&names), &hits)?;
        self.places(&names)
    }

    /// The paths of taught situations or of new ones. Those past the widest obstacles come first, so that the thinner ones lie on them.
    fn paths(&self, taught: bool, look: Look) -> LineStrips2D {
        let mut of_kind: Vec<_> = self.movements().filter(|(case, _)| case.taught == taught).collect();
        let rank = |case: &Case| rank(self.obstacles, &case.obstacle);
        of_kind.sort_by_key(|(case, _)| Reverse(rank(case)));
        let paths = of_kind.iter().map(|(_, movement)| points(&movement.path_m)).collect();
        strips(paths, palette::IDLE, look.narrowest_pt)
            .with_radii(of_kind.iter().map(|(case, _)| Radius::new_ui_points(look.width_pt(rank(case)) / 2.0)))
            .with_colors(of_kind.iter().map(|(case, _)| self.color(case)))
            .with_labels(of_kind.iter().map(|(case, _)| case.name.clone()))
            .with_show_labels(false)
            .with_draw_order(look.order)
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
            .with_radii([Radius::new_ui_points(4.0)])
            .with_draw_order(ON_TOP);
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

/// The point of a path that is deepest inside the obstacle (m).
fn deepest(case: &Case, movement: &Movement) -> Option<[f64; 2]> {
    let depth = |point: &&[f64; 2]| case.obstacle.signed_distance(**point);
    movement.path_m.iter().min_by(|a, b| depth(a).total_cmp(&depth(b))).copied()
}
