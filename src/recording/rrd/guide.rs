//! A page in the recording that says how to read it.

use rerun::TextDocument;

use super::beside;
use super::entity_path::{ENTITIES, GUIDE, TIMELINES};
use super::recorder::{Fault, Recorder};
use crate::simulation::{Experiment, RunOutcome};

/// Logs the page.
pub(super) fn log_guide(recorder: &Recorder, experiment: &Experiment, outcome: &RunOutcome) -> Result<(), Fault> {
    recorder.always(GUIDE.path(), &TextDocument::from_markdown(page(experiment, outcome)))
}

fn page(experiment: &Experiment, outcome: &RunOutcome) -> String {
    let setting: Vec<String> = experiment.parameters.0.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let mut page = format!(
        "{READING}\n{}{MORE}\n\nThis is `{}`, seed {}; {}; {} demonstrations.\n\n## Timelines\n\n",
        beside::in_words(&outcome.beside),
        experiment.name,
        experiment.seed,
        setting.join(", "),
        outcome.dataset.demonstrations.len(),
    );
    page.extend(TIMELINES.iter().map(|timeline| format!("- `{}`: {}\n", timeline.name, timeline.meaning)));
    page.push_str("\n## Entities\n\n");
    page.extend(ENTITIES.iter().map(|entity| format!("- `{}`: {}\n", entity.pattern, entity.meaning)));
    page
}

const READING: &str = "\
A person taught the arm by leading it (grey paths). From the demonstrations the arm learned a movement of states. Where the demonstrations
agree, a state is **stiff** (green): the arm holds its way. Where they disagree, it **complies** (pink): the arm yields to forces, and a
person may push it to where it should go (vermilion arrow). Ellipsoids and ellipses show how far the demonstrations of one setting disagree in
each state, at two standard deviations.

- grey: taught; blue: planned, what the skill generates for this setting without any force; orange: executed
- in the scene the executed path is thick, and all others are thin with thick dashes, each where no other has one; in the plots of motion, where
  lines lie on each other, the lower one is wider. So those in one place are all seen. Things that would hide the paths of the execution are
  translucent
- lime, where nothing was executed beside the run: what plain DMPs by locally weighted regression generate from the same demonstrations, when
  the skill is told parameters: they are not";

const MORE: &str = "\
- dark blue arrow and line: force measured at the tool; yellow: force that the skill expects; vermilion: force of the person
- an arrow is as long as its force is large up to 15 N; a larger force is drawn little longer, and the plots say how large it is. Measured and
  expected forces act at the tool, and are drawn beside it
- the ellipsoid with the thick lines is that of the active state, which is also named beside the scene
- the plot above the lanes says why: a state complies when the demonstrations disagree in it by more than the threshold sigma
- white points touch and may, red ones must not. Where a touch that must not be is deepest stays marked from its first moment to 0.8 s after its
  last, and words beside the scene tell what touches, how hard and how deep in any single step of the engine; the plots show forces as the
  controller estimates them at the logged steps. A white line is a smallest distance, while it happens
- below the scene: how the run ended, what the colours mean, and what has happened until now; *All events* also lists what is to come
- the cursors of plots and lanes are not below each other: each is to be read at its own
- the forcing term is what bends the movement on its way; on the timeline `phase` it is over the phase, as in the paper's Fig. 6a

The page **Teaching** shows the lessons, one after the other, and the page **Replay** what the arm felt when it repeated them alone. Each has a
timeline of its own: choose it at the bottom left, or its page stays empty.";
