//! The page of a layout that shows the execution.

use rerun::blueprint::{ContainerLike, Horizontal, StateTimelineView, Tabs, TextDocumentView, Vertical, View};

use super::beside;
use super::entity_path::{BESIDE_COLORS, BESIDE_PATH, ERROR_COLORS, EVENTS_SO_FAR, EXECUTED_PATH, Entity, FORCE_COLORS, RESULT, SCENE_KEY};
use super::layout::{Shown, axes};
use super::paths::AXES;
use super::recorder::Fault;
use super::views::Views;
use crate::simulation::Beside;

/// Titles stand where a legend would cover what is drawn.
const PATHS: &str = "Taught grey, planned blue, executed orange";
const PATHS_OF_BASELINE: &str = "Taught grey, planned by the LWR-DMP blue, executed orange";
const WITHOUT_STATES: &str = "; without states, stiff throughout";
const BASELINE: &str = ", LWR-DMP's plan lime";

/// The scene with the events at the left; motion, forces, compliance and lanes at the right.
pub(super) fn execution(views: &mut Views, shown: &Shown<'_>) -> Result<Horizontal, Fault> {
    let others = beside::for_title(shown.beside);
    // Only the baseline has no states.
    let paths = if shown.states.is_some() { PATHS } else { PATHS_OF_BASELINE };
    let states = shown.states.as_ref().filter(|states| !states.is_empty()).map(|states| format!("; {states}")).unwrap_or_default();
    let parts = [(paths, true), (&others, true), (BASELINE, shown.baseline), (&states, true), (WITHOUT_STATES, shown.states.is_none())];
    let title: String = parts.into_iter().filter_map(|(part, told)| told.then_some(part)).collect();
    let growing = std::iter::once(EXECUTED_PATH.path()).chain(shown.beside.iter().map(|one| BESIDE_PATH.of(&[&one.name])));
    let scene = views.scene(&title, "/world", growing, shown)?;
    let axes = axes(&shown.way_m);
    let [first, second] = [views.motion(axes[0], &others)?, views.motion(axes[1], &others)?];
    let mut right: Vec<ContainerLike> = vec![first.into(), second.into(), Tabs::new(more(views, axes, shown)?).into()];
    let mut shares = vec![1.0, 1.0, 1.55];
    if shown.states.is_some() {
        let unit = shown.spread_unit;
        let title = format!("How far demonstrations disagree in the active state (orange), threshold sigma (white); {unit}");
        right.push(views.bounded_plot(&title, "plots/spread")?.into());
        shares.push(0.7);
    }
    // Each lane has its name; which there are is not known while the arm is taught.
    right.push(StateTimelineView::new("Compliance, and who does what").with_origin("/lanes").into());
    shares.push(1.5);
    let left = Vertical::new([scene.into(), below_the_scene(views)?.into()]).with_row_shares(vec![2.95, 1.0]);
    Ok(Horizontal::new([left.into(), Vertical::new(right).with_row_shares(shares).into()]).with_column_shares(vec![1.25, 1.0]))
}

/// How the run ended, what the colours in the scene mean, and what has happened.
fn below_the_scene(views: &mut Views) -> Result<Horizontal, Fault> {
    let page = |name: &str, origin: &Entity| TextDocumentView::new(name).with_origin(origin.pattern);
    let events: [ContainerLike; 2] = [page("Events until now", &EVENTS_SO_FAR).into(), views.events()?.into()];
    let parts: [ContainerLike; 3] = [page("Result", &RESULT).into(), page("Key", &SCENE_KEY).into(), Tabs::new(events).into()];
    Ok(Horizontal::new(parts).with_column_shares(vec![1.1, 1.0, 1.25]))
}

/// What is looked at in its turn.
fn more(views: &mut Views, [first, second, third]: [&str; 3], shown: &Shown<'_>) -> Result<Vec<ContainerLike>, Fault> {
    let mut side_by_side = |name: &str, plots: &[(&str, &str)]| -> Result<Horizontal, Fault> {
        let plots: Result<Vec<View>, Fault> = plots.iter().map(|(title, origin)| views.high_plot(title, origin)).collect();
        Ok(Horizontal::new(plots?.into_iter().map(Into::into)).with_name(name))
    };
    let forces = side_by_side("", &[("x (N)", "plots/force/x"), ("y (N)", "plots/force/y"), ("z (N)", "plots/force/z")])?;
    let colors = TextDocumentView::new("Key").with_origin(FORCE_COLORS.pattern);
    let force = Horizontal::new([forces.into(), colors.into()]).with_name("Force").with_column_shares(vec![4.6, 1.0]);
    let person = side_by_side("Person", &[("Force (N)", "plots/person/force"), ("Power (W)", "plots/person/power")])?;
    let forcing = [first, second].map(|axis| (format!("Forcing {axis} (m)"), format!("plots/forcing/{axis}")));
    let forcing = side_by_side("Forcing", &forcing.each_ref().map(|(title, origin)| (title.as_str(), origin.as_str())))?;
    let coupling = side_by_side("Coupling", &[("Displacement (m): x orange, y green, z blue", "plots/coupling")])?;
    let motion = views.motion(third, &beside::for_title(shown.beside))?;
    let motion = Horizontal::new([motion.into()]).with_name(format!("Motion {third}"));
    let gripper = views.fraction_plot("0 closed, 1 open: commanded blue, measured orange", "plots/gripper")?;
    let gripper = Horizontal::new([gripper.into()]).with_name("Gripper");
    let mut tabs: Vec<ContainerLike> = vec![force.into(), forcing.into(), coupling.into(), gripper.into(), motion.into()];
    if shown.person {
        tabs.insert(1, person.into());
    }
    if !shown.beside.is_empty() {
        // The comparison is what such a scenario is about.
        tabs.splice(0..0, compared(views, shown.beside)?);
    }
    Ok(tabs)
}

/// Forces of the run and of everything beside it: how far they are from what was expected, if something beside it expects any, and as they were
/// measured.
fn compared(views: &mut Views, beside: &[Beside]) -> Result<Vec<ContainerLike>, Fault> {
    let mut page = |name: &str, key: &Entity, origin: &str| -> Result<ContainerLike, Fault> {
        let plot = |axis: &&str| Ok(views.high_plot(&format!("{axis} (N)"), &format!("plots/beside/{origin}/{axis}"))?.into());
        let plots: Vec<ContainerLike> = AXES.iter().map(plot).collect::<Result<_, Fault>>()?;
        let key = TextDocumentView::new("Key").with_origin(key.pattern);
        Ok(Horizontal::new([Horizontal::new(plots).into(), key.into()]).with_name(name).with_column_shares(vec![4.6, 1.0]).into())
    };
    let mut pages = vec![page("Forces compared", &BESIDE_COLORS, "force")?];
    if beside.iter().any(|one| one.outcome.skill.force.is_some()) {
        pages.insert(0, page("Force errors", &ERROR_COLORS, "force_error")?);
    }
    Ok(pages)
}
