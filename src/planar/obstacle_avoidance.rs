//! Section 4.1: four goals are taught, all beyond an obstacle that is passed on its right; new goals lie beyond the taught ones.
//!
//! The further left a goal lies, the more a movement towards it must bend. CPDMP learns how the forcing term changes with the goal.
//! LWR-DMP is given the new goal, but its forcing term is the mean of all demonstrations: the whole path leans to the left, and hits the
//! obstacle.

use super::reproduction::{SAMPLES, judged, model_report, path_of, shown};
use super::{
    COLUMNS, Case, Ellipse, Guidance, HandPath, HandSettings, Ideal, LearnedSkill, Method, PlanarOutcome, Side, demonstrated_forcing,
    forcing_curve,
};
use crate::demonstration::{Dataset, ParameterSource, Parameters};
use crate::learning::phmm::PhmmSettings;
use crate::learning::{LearningError, LearningSettings, MayGoOn, SettingFault, ShapingKind, Skill, go_on, learn_while};

/// The task and how it is taught and learned.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleAvoidanceSettings {
    /// Half width of the obstacle, along x (m, 0.05 to 10). Default 1.
    pub obstacle_half_width_m: f64,
    /// Half depth of the obstacle, along y (m, 0.05 to 10). Default 0.5.
    pub obstacle_half_depth_m: f64,
    /// Where movements start (m, -100 to 100 each). Default (0, -4).
    pub start_m: [f64; 2],
    /// Where goals lie along y (m, -100 to 100). Default 4.
    pub goal_y_m: f64,
    /// Taught goals along x (m, -100 to 100; at least two that differ). Default 1, 2, 3, 4.
    pub taught_goals_x_m: Vec<f64>,
    /// New goals along x (m, -100 to 100). Default three to the left of the taught ones at their spacing, one between, one to the right.
    pub new_goals_x_m: Vec<f64>,
    /// Distance at which the person passes the obstacle's right edge (m, 0.01 to 10). Default 1.
    pub clearance_m: f64,
    /// When they pass it, as a fraction of the duration (-, 0.1 to 0.9). Default 0.5.
    pub pass_fraction: f64,
    /// How the movements are shown.
    pub hand: HandSettings,
    /// How both methods learn; `shaping` is not used. Default the room's own with 16 states, but a ridge of 0.01, since 0.1 pulls
    /// movements far beyond the data back to the mean (worst clearance of 40 seeds three spacings beyond: 0.41 m against a collision), and
    /// no start by k-means, since time slices were likelier with each of 20 seeds.
    pub learning: LearningSettings,
}

impl Default for ObstacleAvoidanceSettings {
    fn default() -> Self {
        Self {
            obstacle_half_width_m: 1.0,
            obstacle_half_depth_m: 0.5,
            start_m: [0.0, -4.0],
            goal_y_m: 4.0,
            taught_goals_x_m: vec![1.0, 2.0, 3.0, 4.0],
            new_goals_x_m: vec![-2.0, -1.0, 0.0, 2.5, 5.0],
            clearance_m: 1.0,
            pass_fraction: 0.5,
            hand: HandSettings::default(),
            learning: LearningSettings {
                motion: PhmmSettings { ridge: 0.01, kmeans_starts: 0, ..PhmmSettings::default() },
                ..LearningSettings::default()
            },
        }
    }
}

impl ObstacleAvoidanceSettings {
    /// Checks every range; those of `learning` are checked where it is used.
    ///
    /// # Errors
    /// All settings outside their ranges at once.
    pub fn check(&self) -> Result<(), LearningError> {
        let mut faults: Vec<SettingFault> = Vec::new();
        let mut check = |name: &str, value: f64, from: f64, to: f64, unit: &str| {
            faults.extend(SettingFault::outside(name, value, from, to, unit));
        };
        check("obstacle_half_width_m", self.obstacle_half_width_m, 0.05, 10.0, "m");
        check("obstacle_half_depth_m", self.obstacle_half_depth_m, 0.05, 10.0, "m");
        check("goal_y_m", self.goal_y_m, -100.0, 100.0, "m");
        check("clearance_m", self.clearance_m, 0.01, 10.0, "m");
        check("pass_fraction", self.pass_fraction, 0.1, 0.9, "of the duration");
        for (name, values) in
            [("start_m", self.start_m.as_slice()), ("taught_goals_x_m", &self.taught_goals_x_m), ("new_goals_x_m", &self.new_goals_x_m)]
        {
            values.iter().for_each(|value| check(name, *value, -100.0, 100.0, "m"));
        }
        let distinct = self.taught_goals_x_m.iter().any(|x| *x != self.taught_goals_x_m[0]);
        check("number of different taught_goals_x_m", if distinct { 2.0 } else { self.taught_goals_x_m.len().min(1) as f64 }, 2.0, 1e3, "");
        faults.extend(self.hand.faults());
        if faults.is_empty() {
            let obstacle = self.obstacle();
            faults.extend(self.taught_goals_x_m.iter().chain(&self.new_goals_x_m).filter_map(|x| {
                let clearance = obstacle.clearance(&self.path_to(*x).sampled(SAMPLES));
                SettingFault::outside(&format!("the person's own clearance on the way to goal_x_m = {x}"), clearance, 1e-3, 1e3, "m")
            }));
        }
        if faults.is_empty() { Ok(()) } else { Err(LearningError::Settings(faults)) }
    }

    /// The obstacle.
    #[must_use]
    pub fn obstacle(&self) -> Ellipse {
        Ellipse { centre_m: [0.0; 2], half_axes_m: [self.obstacle_half_width_m, self.obstacle_half_depth_m] }
    }

    /// The person's path to a goal at `goal_x_m`, without variation.
    #[must_use]
    pub fn path_to(&self, goal_x_m: f64) -> HandPath {
        HandPath {
            start_m: self.start_m,
            via_m: [self.obstacle_half_width_m + self.clearance_m, 0.0],
            via_fraction: self.pass_fraction,
            goal_m: [goal_x_m, self.goal_y_m],
        }
    }

    /// All demonstrations, every taught goal as often as the hand repeats; the same for the same seed.
    ///
    /// # Errors
    /// When settings make no usable trajectory.
    pub fn dataset(&self, seed: u64) -> Result<Dataset, LearningError> {
        let goals = self.taught_goals_x_m.iter().flat_map(|x| std::iter::repeat_n(*x, self.hand.repetitions));
        let demonstrations = goals.enumerate().map(|(i, x)| self.path_to(x).demonstrated(&self.hand, theta(x), seed, i));
        Ok(Dataset {
            motion: COLUMNS.map(str::to_owned).to_vec(),
            wrench: Vec::new(),
            parameter_source: ParameterSource::Given,
            demonstrations: demonstrations.collect::<Result<_, _>>()?,
        })
    }
}

fn theta(goal_x_m: f64) -> Parameters {
    vec![("goal_x_m".to_owned(), goal_x_m)]
}

/// The experiment: the same settings and seed give the same outcome. `may_go_on` is asked before each model and each of its iterations, and before each situation.
///
/// # Errors
/// When settings are outside their ranges or make a dataset that cannot be learned from, or it may not go on.
pub fn obstacle_avoidance(settings: &ObstacleAvoidanceSettings, seed: u64, may_go_on: MayGoOn) -> Result<PlanarOutcome, LearningError> {
    settings.check()?;
    let dataset = settings.dataset(seed)?;
    let with = |shaping: ShapingKind| LearningSettings { shaping, ..settings.learning.clone() };
    let learned = |method: Method, shaping: ShapingKind| {
        go_on(may_go_on, || format!("{} was learned", method.title()))?;
        learn_while(&dataset, &with(shaping), seed, may_go_on)
    };
    let (cpdmp, lwr) = rayon::join(|| learned(Method::Cpdmp, ShapingKind::Phmm), || learned(Method::LwrDmp, ShapingKind::Lwr));
    let (cpdmp, lwr) = (cpdmp?, lwr?);
    let skills = [(Method::Cpdmp, &cpdmp.skill), (Method::LwrDmp, &lwr.skill)];
    let mut forcing = demonstrated_forcing(&dataset, &settings.learning, Guidance::OneSide)?;
    let mut cases = Vec::new();
    let taught = settings.taught_goals_x_m.iter().map(|x| (*x, true));
    for (x, taught) in taught.chain(settings.new_goals_x_m.iter().map(|x| (*x, false))) {
        go_on(may_go_on, || format!("goal_x_m = {x} was tried"))?;
        cases.push(case(settings, x, taught, &skills)?);
        for (method, skill) in skills {
            forcing.push(forcing_curve((method, Guidance::OneSide, None), skill, &theta(x), taught)?);
        }
    }
    let skills = skills.map(|(method, skill)| LearnedSkill { method, guidance: Guidance::OneSide, skill: skill.clone() }).to_vec();
    let obstacles = vec![settings.obstacle(); dataset.demonstrations.len()];
    let reports = [(Method::Cpdmp, &cpdmp.report), (Method::LwrDmp, &lwr.report)];
    Ok(PlanarOutcome {
        demonstrations: shown(&dataset, &obstacles)?,
        models: reports.map(|(method, report)| model_report(method, Guidance::OneSide, report, settings.learning.lwr_basis)).to_vec(),
        skills,
        cases,
        forcing,
        transitions: None,
    })
}

fn case(settings: &ObstacleAvoidanceSettings, x: f64, taught: bool, skills: &[(Method, &Skill); 2]) -> Result<Case, LearningError> {
    let (obstacle, goal) = (settings.obstacle(), [x, settings.goal_y_m]);
    let path_m = settings.path_to(x).sampled(SAMPLES);
    let ideals = vec![Ideal { side: Side::Right, clearance_m: obstacle.clearance(&path_m), path_m }];
    let movements = skills.iter().map(|(method, skill)| {
        let path = path_of(skill, &theta(x), settings.start_m, goal)?;
        Ok(judged(*method, None, path, &obstacle, &ideals, goal))
    });
    let mut case = Case {
        name: format!("goal_x_m = {x}"),
        guidance: Guidance::OneSide,
        theta: theta(x),
        taught,
        extrapolation: skills[0].1.extrapolation(&theta(x))?,
        obstacle,
        goal_m: goal,
        movements: movements.collect::<Result<_, LearningError>>()?,
        ideals,
        winner: None,
    };
    case.decide();
    Ok(case)
}
