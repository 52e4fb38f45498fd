//! The pages of a layout that show what came before the execution.

use rerun::blueprint::{ContainerLike, Horizontal, StateTimelineView, TextDocumentView, Vertical};

use super::entity_path::{REPLAY_NAME, REPLAY_TIME, TEACHING_NAME, TEACHING_PATH, TEACHING_TIME, Timeline};
use super::layout::{Shown, axes};
use super::recorder::Fault;
use super::views::Views;

/// The lessons: the scene at the left; motion, person and gripper at the right.
pub(super) fn teaching(views: &mut Views, shown: &Shown<'_>) -> Result<Horizontal, Fault> {
    let title = format!("A person (vermilion) leads the weightless arm. {}", choose(TEACHING_TIME));
    let scene = views.scene(&title, "/teaching", [TEACHING_PATH.path()], shown)?;
    let [first, second, _] = axes(&shown.way_m);
    let mut taught = |axis: &str| views.coordinate(&format!("Taught {axis} (m)"), &format!("teaching_plots/motion/{axis}"));
    let right: [ContainerLike; 5] = [
        taught(first)?.into(),
        taught(second)?.into(),
        views.plot("Force of the person (N)", "teaching_plots/person")?.into(),
        views.fraction_plot("Gripper: 0 closed, 1 open", "teaching_plots/gripper")?.into(),
        demonstration("/teaching_lanes", TEACHING_NAME.pattern).into(),
    ];
    let right = Vertical::new(right).with_row_shares(vec![1.0, 1.0, 1.0, 0.7, 0.6]);
    Ok(Horizontal::new([scene.into(), right.into()]).with_column_shares(vec![1.25, 1.0]))
}

/// Which demonstration it is: its number over time, and the name of the one at the cursor, for which a lane has no room.
fn demonstration(lane: &str, name: &str) -> Horizontal {
    let number = StateTimelineView::new("Number of the demonstration").with_origin(lane);
    let name = TextDocumentView::new("Its name").with_origin(name);
    Horizontal::new([number.into(), name.into()]).with_column_shares(vec![1.6, 1.0])
}

/// What a page says that is empty on all timelines but one.
fn choose(timeline: Timeline) -> String {
    format!("Empty? Choose {} at the bottom left", timeline.name)
}

/// The replays: what the arm felt, per axis.
pub(super) fn replay(views: &mut Views) -> Result<Vertical, Fault> {
    let plots: [ContainerLike; 4] = [
        views.high_plot(&format!("Measured force x (N). {}", choose(REPLAY_TIME)), "replay_plots/force/x")?.into(),
        views.high_plot("Measured force y (N)", "replay_plots/force/y")?.into(),
        views.high_plot("Measured force z (N)", "replay_plots/force/z")?.into(),
        demonstration("/replay_lanes", REPLAY_NAME.pattern).into(),
    ];
    Ok(Vertical::new(plots).with_row_shares(vec![1.0, 1.0, 1.0, 0.5]))
}
