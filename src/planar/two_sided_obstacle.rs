//! Section 4.2: an obstacle of several widths is passed on either side.
//!
//! Told the side, every method has one movement to learn per situation. Not told, a model holds both sides at once: regression over all of
//! it averages them and hits the obstacle, while the chains of a hidden Markov model keep them apart.

use nalgebra::DVector;

use super::forcing::HALF_WIDTH;
use super::reproduction::{SAMPLES, judged, model_report, path_of, shown};
use super::rival::Rival;
use super::two_sided_settings::TwoSidedObstacleSettings;
use super::{
    Case, Ellipse, ForcingCurve, Guidance, Ideal, LearnedSkill, Method, ModelReport, Movement, PlanarOutcome, Side, Transitions,
    demonstrated_forcing, forcing_curve,
};
use crate::demonstration::Parameters;
use crate::learning::cpdmp::{Compliance, Shaping};
use crate::learning::phmm::{Phmm, StateChain, TransitionGraph};
use crate::learning::{LearningError, MayGoOn, Skill, go_on, learn_while};

/// What was learned from one way of telling the task.
struct Learned {
    guidance: Guidance,
    /// Method, chain and skill.
    skills: Vec<(Method, Option<usize>, Skill)>,
    rival: Rival,
    models: Vec<ModelReport>,
    transitions: Option<Transitions>,
}

impl Learned {
    /// The skills that are not a part of another one.
    fn whole_skills(&self) -> impl Iterator<Item = LearnedSkill> {
        let whole = self.skills.iter().filter(|(_, chain, _)| chain.is_none());
        whole.map(|(method, _, skill)| LearnedSkill { method: *method, guidance: self.guidance, skill: skill.clone() })
    }
}

/// The experiment: the same settings and seed give the same outcome. `may_go_on` is asked before each model and each of its iterations, and before each situation.
///
/// # Errors
/// When settings are outside their ranges or make a dataset that cannot be learned from, or it may not go on.
pub fn two_sided_obstacle(settings: &TwoSidedObstacleSettings, seed: u64, may_go_on: MayGoOn) -> Result<PlanarOutcome, LearningError> {
    settings.check()?;
    let (with, without) = rayon::join(|| with_side(settings, seed, may_go_on), || without_side(settings, seed, may_go_on));
    let (with, without) = (with?, without?);
    let dataset = settings.dataset(Method::Cpdmp, Guidance::WithSide, seed)?;
    let mut forcing = demonstrated_forcing(&dataset, &settings.learning, Guidance::WithSide)?;
    let mut cases = Vec::new();
    for (half_width, taught) in settings.half_widths() {
        for side in [Side::Left, Side::Right] {
            go_on(may_go_on, || tried(half_width))?;
            cases.push(case(settings, &with, half_width, taught, &[side])?);
            forcing.extend(curves(&with, half_width, taught, Some(side))?);
        }
    }
    for (half_width, taught) in settings.half_widths() {
        go_on(may_go_on, || tried(half_width))?;
        cases.push(case(settings, &without, half_width, taught, &[Side::Left, Side::Right])?);
        forcing.extend(curves(&without, half_width, taught, None)?);
    }
    let skills = [&with, &without].into_iter().flat_map(Learned::whole_skills).collect();
    let obstacles: Vec<Ellipse> = settings.shown_situations().iter().map(|(half_width, _)| settings.obstacle(*half_width)).collect();
    Ok(PlanarOutcome {
        demonstrations: shown(&dataset, &obstacles)?,
        models: with.models.into_iter().chain(without.models).collect(),
        skills,
        cases,
        forcing,
        transitions: without.transitions,
    })
}

fn tried(half_width_m: f64) -> String {
    format!("an obstacle of half width {half_width_m} m was tried")
}

fn may_learn(method: Method, may_go_on: MayGoOn) -> Result<(), LearningError> {
    go_on(may_go_on, || format!("{} was learned", method.title()))
}

fn with_side(settings: &TwoSidedObstacleSettings, seed: u64, may_go_on: MayGoOn) -> Result<Learned, LearningError> {
    let (mut skills, mut models) = (Vec::new(), Vec::new());
    for method in [Method::Cpdmp, Method::CpdmpProduct] {
        may_learn(method, may_go_on)?;
        let learned = learn_while(&settings.dataset(method, Guidance::WithSide, seed)?, &settings.learning, seed, may_go_on)?;
        models.push(model_report(method, Guidance::WithSide, &learned.report, 0));
        skills.push((method, None, learned.skill));
    }
    may_learn(Method::TpGmm, may_go_on)?;
    let (rival, report) = Rival::learned(settings, Guidance::WithSide, seed, may_go_on)?;
    models.push(report);
    Ok(Learned { guidance: Guidance::WithSide, skills, rival, models, transitions: None })
}

fn without_side(settings: &TwoSidedObstacleSettings, seed: u64, may_go_on: MayGoOn) -> Result<Learned, LearningError> {
    let guidance = Guidance::WithoutSide;
    may_learn(Method::Cpdmp, may_go_on)?;
    let learned = learn_while(&settings.dataset(Method::Cpdmp, guidance, seed)?, &settings.learning_without_side, seed, may_go_on)?;
    let mut models = vec![model_report(Method::Cpdmp, guidance, &learned.report, 0)];
    let mut skills = vec![(Method::Cpdmp, None, learned.skill.clone())];
    let mut transitions = None;
    if let Some(phmm) = learned.skill.motion.phmm() {
        let found = transitions_of(phmm, &mean_theta(&learned.skill));
        let alone = |(index, chain)| (Method::CpdmpChain, Some(index), skill_of(&learned.skill, phmm, chain));
        skills.extend(found.chains.iter().enumerate().map(alone));
        transitions = Some(found);
    }
    may_learn(Method::TpGmm, may_go_on)?;
    let (rival, report) = Rival::learned(settings, guidance, seed, may_go_on)?;
    models.push(report);
    Ok(Learned { guidance, skills, rival, models, transitions })
}

/// The middle of the demonstrated parameters.
fn mean_theta(skill: &Skill) -> DVector<f64> {
    let ranges = &skill.motion.parameters.ranges;
    DVector::from_iterator(ranges.len(), ranges.iter().map(|[from, to]| 0.5 * (from + to)))
}

fn transitions_of(phmm: &Phmm, theta: &DVector<f64>) -> Transitions {
    let graph = TransitionGraph::of(phmm, theta);
    let matrix = phmm.transition.row_iter().map(|row| row.iter().copied().collect()).collect();
    Transitions { matrix, chains: graph.chains(), graph }
}

/// The skill of one chain: regression over its states alone.
fn skill_of(skill: &Skill, phmm: &Phmm, chain: &StateChain) -> Skill {
    let mut alone = skill.clone();
    alone.compliance = Compliance::stiff(chain.states.len(), skill.motion.columns.len());
    alone.motion.shaping = Shaping::Phmm(phmm.restricted(chain));
    alone
}

fn case(
    settings: &TwoSidedObstacleSettings,
    learned: &Learned,
    half_width: f64,
    taught: bool,
    sides: &[Side],
) -> Result<Case, LearningError> {
    let (obstacle, goal) = (settings.obstacle(half_width), settings.goal_m);
    let ideal = |side: &Side| {
        let path_m = settings.path_on(half_width, *side).sampled(SAMPLES);
        Ideal { side: *side, clearance_m: obstacle.clearance(&path_m), path_m }
    };
    let ideals: Vec<Ideal> = sides.iter().map(ideal).collect();
    let told = match sides {
        [side] => Some(*side),
        _ => None,
    };
    let mut movements: Vec<Movement> = Vec::new();
    for (method, chain, skill) in &learned.skills {
        let path = path_of(skill, &theta_of(*method, half_width, told), settings.start_m, goal)?;
        movements.push(judged(*method, *chain, path, &obstacle, &ideals, goal));
    }
    let path = learned.rival.path(settings, half_width, told)?;
    movements.push(judged(Method::TpGmm, None, path, &obstacle, &ideals, goal));
    let theta = theta_of(Method::Cpdmp, half_width, told);
    let mut case = Case {
        name: told.map_or_else(|| format!("half_width_m = {half_width}"), |side| format!("half_width_m = {half_width}, {}", side.key())),
        guidance: learned.guidance,
        extrapolation: learned.skills[0].2.extrapolation(&theta)?,
        theta,
        taught,
        obstacle,
        goal_m: goal,
        ideals,
        movements,
        winner: None,
    };
    case.decide();
    Ok(case)
}

/// The parameters of a situation as a method is told them.
pub(super) fn theta_of(method: Method, half_width: f64, side: Option<Side>) -> Parameters {
    let mut theta = vec![(HALF_WIDTH.to_owned(), half_width)];
    if let Some(side) = side {
        theta.push(("side".to_owned(), side.sign()));
        if method == Method::CpdmpProduct {
            theta.push(("side_half_width_m".to_owned(), side.sign() * half_width));
        }
    }
    theta
}

fn curves(learned: &Learned, half_width: f64, taught: bool, side: Option<Side>) -> Result<Vec<ForcingCurve>, LearningError> {
    let curve = |(method, chain, skill): &(Method, Option<usize>, Skill)| {
        forcing_curve((*method, learned.guidance, *chain), skill, &theta_of(*method, half_width, side), taught)
    };
    learned.skills.iter().map(curve).collect()
}
