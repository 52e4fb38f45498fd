//! Which obstacle is which: where there are several, each has a colour of its own, and so has what passes it.

use super::{Case, Ellipse, Novelty};
use crate::palette::{BLUE, BROWN, GREEN, ORANGE, PINK, Rgb, SKY_BLUE};

/// Colours of obstacles, in order; with more obstacles they come again. Vermilion is left to collisions.
const COLORS: [(Rgb, &str); 6] =
    [(BLUE, "blue"), (GREEN, "green"), (ORANGE, "orange"), (PINK, "pink"), (SKY_BLUE, "sky blue"), (BROWN, "brown")];

/// An obstacle of an experiment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Obstacle {
    /// Where it is.
    pub ellipse: Ellipse,
    /// Whether it was demonstrated how to pass it, or else what it is beside those that were.
    pub novelty: Novelty,
    /// Its colour with the colour's name; none when it is the only one, which needs none.
    pub look: Option<(Rgb, &'static str)>,
}

impl Obstacle {
    /// Its colour among others.
    #[must_use]
    pub fn color(&self) -> Option<Rgb> {
        self.look.map(|(color, _)| color)
    }

    /// Half its width (m).
    #[must_use]
    pub fn half_width_m(&self) -> f64 {
        self.ellipse.half_axes_m[0]
    }

    /// Whether it was demonstrated how to pass it.
    #[must_use]
    pub fn is_taught(&self) -> bool {
        self.novelty == Novelty::Taught
    }

    /// What it is called among others: `half width 1.5 m, new`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("half width {} m, {}", self.half_width_m(), self.novelty.name())
    }
}

/// How many of the obstacles that are taught as this one is, or not as it is, are narrower.
#[must_use]
pub fn rank(obstacles: &[Obstacle], ellipse: &Ellipse) -> usize {
    let taught = obstacles.iter().find(|one| one.ellipse == *ellipse).map(Obstacle::is_taught);
    let narrower = |one: &&Obstacle| Some(one.is_taught()) == taught && one.ellipse.half_axes_m[0] < ellipse.half_axes_m[0];
    obstacles.iter().filter(narrower).count()
}

/// The obstacles of some situations, each once, from the narrowest to the widest.
#[must_use]
pub fn obstacles<'a>(cases: impl IntoIterator<Item = &'a Case>) -> Vec<Obstacle> {
    let mut all: Vec<Obstacle> = Vec::new();
    for case in cases {
        if all.iter().all(|known| known.ellipse != case.obstacle) {
            all.push(Obstacle { ellipse: case.obstacle, novelty: case.novelty(), look: None });
        }
    }
    all.sort_by(|a, b| a.ellipse.half_axes_m[0].total_cmp(&b.ellipse.half_axes_m[0]));
    if all.len() > 1 {
        all.iter_mut().zip(COLORS.iter().cycle()).for_each(|(obstacle, look)| obstacle.look = Some(*look));
    }
    all
}
