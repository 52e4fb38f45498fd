//! Contract: the figures of an arm's run say what the records and the skill say: lines are the records, ellipses are the model's Gaussians,
//! bars are its statistic, bands are the moments of compliance.

use std::path::Path;

use cpdmp::figure::{
    ArmRun, Chart, Figure, Mark, Shape, arm_compliance, arm_forces, arm_forcing, arm_motion, arm_paths, arm_settings, arm_states, svg,
};
use cpdmp::learning::cpdmp::{CouplingMode, CouplingSettings};
use cpdmp::learning::{ExecutionSettings, LearningSettings};
use cpdmp::palette::meaning::{self, MINIMISES, STIFF};
use cpdmp::palette::{LIME, MAROON, Rgb};
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::{RunOutcome, StepRecord};
use nalgebra::{Matrix2, Vector2};

use crate::recording::beside::compared;
use crate::recording::made_up_run::{COMPLIES, learning_settings, outcome, outcome_of_the_baseline, question};

struct Parts {
    outcome: RunOutcome,
    learning: LearningSettings,
    question: ExecutionSettings,
}

impl Parts {
    fn of(outcome: RunOutcome) -> Self {
        Self { outcome, learning: learning_settings(), question: question() }
    }

    fn run(&self) -> ArmRun<'_> {
        let learned = (&self.outcome.skill, &self.outcome.dataset, &self.learning);
        ArmRun::new("made up, seed 1".into(), &self.outcome.steps, learned, self.question.clone()).expect("the skill answers")
    }
}

fn marks<'a>(chart: &'a Chart, legend: &str) -> Vec<&'a Mark> {
    chart.marks.iter().filter(|mark| mark.legend == legend).collect()
}

fn line<'a>(chart: &'a Chart, legend: &str) -> &'a [[f64; 2]] {
    match marks(chart, legend)[..] {
        [Mark { shape: Shape::Line { points, .. }, .. }] => points,
        _ => panic!("one line `{legend}`"),
    }
}

fn outlines<'a>(chart: &'a Chart, legend: &str) -> Vec<&'a [[f64; 2]]> {
    marks(chart, legend).into_iter().map(outline).collect()
}

fn outline(mark: &Mark) -> &[[f64; 2]] {
    match &mark.shape {
        Shape::Area { outline, .. } => outline,
        other => panic!("no outline: {other:?}"),
    }
}

#[test]
fn executed_lines_are_the_records_and_bands_are_the_moments_of_compliance() {
    let parts = Parts::of(outcome());
    let (motion, compliance) = (arm_motion(&parts.run()), arm_compliance(&parts.run()));
    let steps = &parts.outcome.steps;
    assert_eq!(motion.panels.len(), 3);
    for (axis, panel) in motion.panels.iter().enumerate() {
        let records: Vec<[f64; 2]> = steps.iter().map(|step| [step.time_s, step.tool.translation.vector[axis]]).collect();
        assert_eq!(line(panel, "executed"), records);
        assert_eq!(marks(panel, "taught").len(), parts.outcome.dataset.demonstrations.len());
    }
    let person: Vec<[f64; 2]> = steps.iter().map(|step| [step.time_s, step.human.force.norm()]).collect();
    assert_eq!(line(&compliance.panels[2], "of the person"), person);
    let window = [steps[COMPLIES.start].time_s, steps[COMPLIES.end - 1].time_s];
    for panel in motion.panels.iter().chain(&compliance.panels) {
        let bands: Vec<&Shape> = marks(panel, "the arm complies").iter().map(|mark| &mark.shape).collect();
        assert!(matches!(bands[..], [Shape::Band { stretch, .. }] if *stretch == window), "{bands:?}");
    }
}

#[test]
fn bars_are_the_statistic_against_sigma() {
    let parts = Parts::of(outcome());
    let figure = arm_compliance(&parts.run());
    let compliance = &parts.outcome.skill.compliance;
    let mut heights = Vec::new();
    for legend in ["stiff state", "state that complies"] {
        heights.extend(outlines(&figure.panels[0], legend).iter().map(|outline| outline[1][1]));
    }
    assert!(!heights.is_empty());
    for height in heights {
        let known = compliance.values_m2.iter().any(|value| (value.sqrt() * 1e3 - height).abs() < 1e-9);
        assert!(known, "{height} mm is the root of no state's statistic {:?}", compliance.values_m2);
    }
    let sigma = line(&figure.panels[0], "root of the threshold sigma")[0][1];
    assert!((sigma - compliance.threshold_m2.sqrt() * 1e3).abs() < 1e-9);
}

/// Contract: what did not happen takes no place: no line of a person who never helps, no displacement that is never asked for. Where forces
/// move the arm is marked, whichever way they do.
#[test]
fn only_what_happened_is_drawn() {
    let mut parts = Parts::of(outcome());
    for step in &mut parts.outcome.steps {
        step.human.force.fill(0.0);
        step.coupling_displacement.fill(0.0);
        step.beta = -step.beta;
    }
    let figure = arm_compliance(&parts.run());
    assert!(!figure.panels.iter().any(|panel| panel.title.contains("never on")));
    assert!(figure.panels.iter().all(|panel| marks(panel, "of the person").is_empty() && !panel.title.contains("move the tool")));
    let steps = &parts.outcome.steps;
    let window = [steps[COMPLIES.start].time_s, steps[COMPLIES.end - 1].time_s];
    for panel in &figure.panels {
        let bands: Vec<&Shape> = marks(panel, "the arm minimises the force error").iter().map(|mark| &mark.shape).collect();
        assert!(matches!(bands[..], [Shape::Band { stretch, .. }] if *stretch == window), "{bands:?}");
        assert!(marks(panel, "the arm complies").is_empty());
    }
    parts.outcome.steps.iter_mut().for_each(|step| step.activation = 0.0);
    assert!(arm_compliance(&parts.run()).panels.iter().any(|panel| panel.title.contains("the coupling is never on")));
}

/// Contract: the number of a state stands above its bar, and on no other number and not on the threshold.
#[test]
fn numbers_of_states_stand_clear() {
    let mut parts = Parts::of(outcome());
    let compliance = &mut parts.outcome.skill.compliance;
    // The threshold lies where a number would stand.
    let highest = compliance.values_m2.iter().copied().fold(0.0, f64::max).sqrt();
    compliance.threshold_m2 = (1.06 * highest).powi(2);
    let figure = arm_compliance(&parts.run());
    let panel = &figure.panels[0];
    let sigma = line(panel, "root of the threshold sigma")[0][1];
    let words = |mark: &Mark| match &mark.shape {
        Shape::Words { at, text, .. } => Some((*at, text.clone())),
        _ => None,
    };
    let numbers: Vec<([f64; 2], String)> = panel.marks.iter().filter_map(words).collect();
    assert!(numbers.len() > 2);
    let half_height = 0.03 * sigma;
    for (index, ([x, y], name)) in numbers.iter().enumerate() {
        assert!((y - sigma).abs() > half_height, "{name} lies on the threshold");
        let bars = panel.marks.iter().filter(|mark| matches!(mark.shape, Shape::Area { .. })).map(outline);
        let below = bars.filter(|bar| bar[0][0] <= *x && *x <= bar[2][0]).map(|bar| bar[1][1]).fold(0.0, f64::max);
        assert!(*y > below + half_height, "{name} lies in a bar");
        assert!(numbers[..index].iter().all(|([other, above], _)| (other - x).abs() > 0.02 || (above - y).abs() > half_height));
    }
}

/// Contract: a state is drawn as what it does about forces in this run, whatever it had learned to do.
#[test]
fn states_have_the_colour_of_what_the_coupling_lets_them_do() {
    let legend = |mode: CouplingMode| {
        let mut parts = Parts::of(outcome());
        parts.question.coupling = CouplingSettings { enabled: true, mode, ..CouplingSettings::default() };
        let run = parts.run();
        let mut of_states: Vec<(String, _)> = [arm_motion(&run), arm_compliance(&run), arm_forcing(&run).expect("drawn")]
            .into_iter()
            .chain(arm_paths(&run))
            .flat_map(|figure| figure.panels)
            .flat_map(|panel| panel.marks)
            .filter(|mark| mark.legend.contains("state"))
            .map(|mark| (mark.legend.to_string(), mark.color))
            .collect();
        of_states.dedup();
        of_states
    };
    let all = |states: &[(String, _)], name: &str, color| !states.is_empty() && states.iter().all(|one| one.0 == name && one.1 == color);
    assert!(all(&legend(CouplingMode::MinimiseForceError), "state that minimises the force error", MINIMISES));
    assert!(all(&legend(CouplingMode::PerState(vec![-1.0; 5])), "state that complies", meaning::COMPLIES));
    assert!(all(&legend(CouplingMode::PerState(vec![0.0; 5])), "stiff state", STIFF));
}

/// Every point of an ellipse over the phase is two standard deviations from the mean of one state, by the definition of a Gaussian.
#[test]
fn ellipses_over_the_phase_are_the_gaussians_of_the_model() {
    let parts = Parts::of(outcome());
    let figure = arm_forcing(&parts.run()).expect("drawn");
    let skill = &parts.outcome.skill;
    let phmm = skill.motion.phmm().expect("states");
    let phi = skill.motion.parameters.features.at(&skill.request(&parts.question).expect("answered").theta);
    for (j, panel) in figure.panels.iter().enumerate() {
        let drawn: Vec<_> = ["stiff state", "state that complies"].iter().flat_map(|legend| outlines(panel, legend)).collect();
        assert_eq!(drawn.len(), phmm.states());
        for outline in drawn {
            let on = |state: usize| {
                let (mean, all) = (phmm.mean_at(state, &phi), &phmm.covariances[state]);
                let inverse =
                    Matrix2::new(all[(0, 0)], all[(0, j + 1)], all[(j + 1, 0)], all[(j + 1, j + 1)]).try_inverse().expect("regular");
                let away = |point: &[f64; 2]| Vector2::from(*point) - Vector2::new(mean[0], mean[j + 1]);
                outline.iter().map(away).all(|away| ((away.transpose() * inverse * away)[0].sqrt() - 2.0).abs() < 1e-6)
            };
            assert!((0..phmm.states()).any(on), "an outline of panel {j} is no state's");
        }
    }
}

/// Every taught setting has its line, by the model's own forcing, and the ellipses of its states around the means of that setting.
#[test]
fn taught_settings_have_a_line_and_their_states_each() {
    let parts = Parts::of(outcome());
    let figure = arm_settings(&parts.run()).expect("drawn").expect("several settings");
    let (motion, lessons) = (&parts.outcome.skill.motion, &parts.outcome.dataset.demonstrations);
    let phmm = motion.phmm().expect("states");
    let mut heights: Vec<f64> = lessons.iter().map(|lesson| lesson.theta_m[0].1).collect();
    heights.dedup();
    assert!(heights.len() > 1);
    for (j, panel) in figure.panels.iter().enumerate() {
        let area = |mark: &'_ Mark| matches!(mark.shape, Shape::Area { .. });
        let areas: Vec<&[[f64; 2]]> = panel.marks.iter().filter(|mark| area(mark)).map(outline).collect();
        // One without a place stands for them in the legend.
        let outlines: Vec<&[[f64; 2]]> = areas.into_iter().filter(|outline| !outline.is_empty()).collect();
        assert_eq!(outlines.len(), heights.len() * phmm.states());
        for height in &heights {
            let theta = motion.parameters.resolve(&[("block_height_m".into(), *height)]).expect("known");
            let mut shaping = motion.shaping_at(&theta).expect("a model");
            let points = line(panel, &format!("block_height_m = {height}"));
            for (i, point) in points.iter().enumerate() {
                let mut forcing = vec![0.0; motion.columns.len()];
                shaping.forcing(i as f64 / (points.len() - 1) as f64, &mut forcing);
                assert_eq!(point[1].to_bits(), forcing[j].to_bits());
            }
            let phi = motion.parameters.features.at(&theta);
            for state in 0..phmm.states() {
                let mean = phmm.mean_at(state, &phi);
                // The middle of an ellipse is the mean of its points.
                let middle = |outline: &&[[f64; 2]]| {
                    let sum = outline.iter().fold(Vector2::zeros(), |sum, point| sum + Vector2::from(*point));
                    (sum / outline.len() as f64 - Vector2::new(mean[0], mean[j + 1])).norm() < 1e-6
                };
                assert!(outlines.iter().any(middle), "state {state} at {height} m");
            }
        }
    }
}

/// Contract: the legend says what everything is that is drawn of a setting, and no setting has a colour that means something else in the figures
/// beside this one.
#[test]
fn the_legend_of_taught_settings_is_whole() {
    let parts = Parts::of(outcome());
    let figure = arm_settings(&parts.run()).expect("drawn").expect("several settings");
    let taken = [meaning::PLANNED, meaning::EXECUTED, meaning::TAUGHT, STIFF, meaning::COMPLIES];
    for panel in &figure.panels {
        for legend in ["taught, in the colour of its setting", "state, two standard deviations"] {
            assert_eq!(marks(panel, legend).len(), 1, "{legend}");
        }
        let executed = line(panel, "block_height_m = 0.235, executed");
        assert!(executed.len() > 2, "the setting of the execution is named");
        let named = panel.marks.iter().filter(|mark| mark.legend.contains("block_height_m"));
        let (executed, of_settings): (Vec<&Mark>, Vec<&Mark>) = named.partition(|mark| mark.legend.ends_with(", executed"));
        assert!(executed.iter().all(|mark| mark.color == meaning::PLANNED), "what the skill makes of it has one colour in every figure");
        assert!(of_settings.len() > 1 && of_settings.iter().all(|mark| !taken.contains(&mark.color)));
    }
    let blind = Parts::of(outcome_of_the_baseline());
    assert!(arm_settings(&blind.run()).expect("drawn").is_none(), "what makes no difference between settings has no such figure");
}

/// The pieces of `beta`, in the order in which they are drawn.
fn pieces_of_beta(figure: &Figure) -> Vec<(Rgb, Vec<[f64; 2]>)> {
    let pieces = figure.panels[1].marks.iter().filter(|mark| mark.legend.starts_with("beta"));
    let piece = |mark: &Mark| if let Shape::Line { points, .. } = &mark.shape { (mark.color, points.clone()) } else { panic!("no line") };
    pieces.map(piece).collect()
}

/// Contract: `beta` is drawn as the records have it, piece by piece up to the start of the next one, in the colour of what the arm does: green where it
/// is stiff, pink where it complies, violet where it minimises the force error.
#[test]
fn beta_has_the_colour_of_what_it_does() {
    for sign in [1.0, -1.0] {
        let mut parts = Parts::of(outcome());
        parts.outcome.steps.iter_mut().for_each(|step| step.beta *= sign);
        let records: Vec<[f64; 2]> = parts.outcome.steps.iter().map(|step| [step.time_s, step.beta]).collect();
        let pieces = pieces_of_beta(&arm_compliance(&parts.run()));
        let colors: Vec<Rgb> = pieces.iter().map(|(color, _)| *color).collect();
        assert_eq!(colors, [STIFF, if sign > 0.0 { meaning::COMPLIES } else { MINIMISES }, STIFF]);
        let mut drawn = pieces[0].1.clone();
        for (_, piece) in &pieces[1..] {
            assert_eq!(drawn.pop(), piece.first().copied(), "a piece ends where the next one begins");
            drawn.extend(piece);
        }
        assert_eq!(drawn, records);
    }
}

/// Contract: when the skill is over the arm holds its place: `beta` is drawn as none whatever the last state did, and the stretch is marked; where the
/// records end with the skill there is none.
#[test]
fn a_skill_that_is_over_does_nothing_about_forces() {
    let mut parts = Parts::of(outcome());
    let end = parts.outcome.steps.iter().position(|step| step.time_fraction >= 1.0).expect("the records go on");
    for (index, step) in parts.outcome.steps.iter_mut().enumerate() {
        (step.beta, step.activation) = (1.0, if index < end { 0.9 } else { 0.0 });
    }
    let figure = arm_compliance(&parts.run());
    let times: Vec<f64> = parts.outcome.steps[end..].iter().map(|step| step.time_s).collect();
    let pieces = pieces_of_beta(&figure);
    let [.., (color, held)] = &pieces[..] else { panic!("nothing is drawn") };
    assert!(*color == STIFF && times.iter().all(|time_s| held.contains(&[*time_s, 0.0])), "{times:?}, {held:?}");
    let over = [times[0], times[times.len() - 1]];
    let bands = |figure: &Figure| -> Vec<[f64; 2]> {
        let all = figure.panels.iter().flat_map(|panel| marks(panel, "the skill is over"));
        all.map(|mark| if let Shape::Band { stretch, .. } = mark.shape { stretch } else { panic!("no band") }).collect()
    };
    for figure in [&figure, &arm_motion(&parts.run()), &arm_forces(&parts.run())] {
        assert_eq!(bands(figure), vec![over; figure.panels.len()], "{}", figure.title);
    }
    parts.outcome.steps.truncate(end + 1);
    assert!(bands(&arm_compliance(&parts.run())).is_empty());
}

/// Contract: a door's arc lies at the handle's distance about its hinge, and is drawn from above in true place.
#[test]
fn the_arc_of_a_door_is_a_circle_about_its_hinge() {
    let parts = Parts::of(outcome());
    let scenario = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/cabinet_door.toml");
    let options = LoadOptions { set: vec!["parameters.handle_y_m=0.35".into()], ..LoadOptions::default() };
    let Work::Arm(experiment) = Scenario::load(&scenario, &options).expect("shipped").work else { panic!("no arm") };
    let (objects, parameters) = (&experiment.objects, &experiment.parameters);
    let (hinge, first) = (Vector2::new(0.88, 0.65), Vector2::new(0.84, 0.35));
    let figure = arm_paths(&parts.run().in_scene(objects, parameters)).expect("a path");
    let arc = line(&figure.panels[0], "arc of the handle about its hinge");
    for point in arc {
        assert!(((Vector2::from(*point) - hinge).norm() - 0.3_f64.hypot(0.04)).abs() < 1e-12);
    }
    assert!((Vector2::from(arc[0]) - first).norm() < 1e-12);
    let turn = (Vector2::from(arc[0]) - hinge).angle(&(Vector2::from(arc[arc.len() - 1]) - hinge));
    assert!((turn - 1.2).abs() < 1e-9, "{turn} rad");
    // How far the tool is outside of the arc.
    let beside = figure.panels.last().expect("a panel of the arc");
    let radius_m = 0.3_f64.hypot(0.04);
    for ([time_s, outside_mm], step) in line(beside, "executed").iter().zip(&parts.outcome.steps) {
        let expected_mm = ((step.tool.translation.vector.xy() - hinge).norm() - radius_m) * 1e3;
        assert!(*time_s == step.time_s && (outside_mm - expected_mm).abs() < 1e-9, "{outside_mm} mm, {expected_mm} mm");
    }
    assert!(marks(&arm_paths(&parts.run()).expect("a path").panels[0], "arc of the handle about its hinge").is_empty());
}

#[test]
fn every_figure_can_be_drawn_also_for_a_skill_without_states() {
    for (outcome, states) in [(outcome(), 5), (outcome_of_the_baseline(), 0)] {
        let parts = Parts::of(outcome);
        let run = parts.run();
        let mut figures: Vec<Figure> = vec![arm_motion(&run), arm_compliance(&run), arm_forces(&run), arm_forcing(&run).expect("drawn")];
        figures.extend(arm_paths(&run));
        figures.extend(arm_settings(&run).expect("drawn"));
        figures.extend(arm_states(&run).expect("drawn"));
        assert_eq!(figures.len(), if states > 0 { 7 } else { 5 });
        for figure in figures {
            assert!(svg(&figure).is_ok_and(|text| text.contains("made up, seed 1")), "{}", figure.title);
        }
    }
}

/// Contract: what was executed beside the run is drawn under its own name, as its records have it, in every figure that is about where the tool
/// went or what it felt; without it there is nothing to compare.
#[test]
fn what_was_executed_beside_the_run_is_drawn_in_a_colour_of_its_own() {
    let parts = Parts::of(compared());
    let colors = meaning::beside(parts.outcome.beside.iter().map(|one| one.difference));
    let others = parts.outcome.beside.iter().zip(&colors).map(|(one, (color, _))| (one.name.as_str(), *color, &one.outcome.steps[..]));
    let run = parts.run().beside(others.collect());
    let (motion, forces) = (arm_motion(&run), arm_forces(&run));
    let paths = arm_paths(&run).expect("the tool moves");
    for (one, (color, _)) in parts.outcome.beside.iter().zip(colors) {
        let steps = &one.outcome.steps;
        for axis in 0..3 {
            let places: Vec<[f64; 2]> = steps.iter().map(|step| [step.time_s, step.tool.translation.vector[axis]]).collect();
            assert_eq!(line(&motion.panels[axis], &one.name), places);
            let errors: Vec<[f64; 2]> = steps.iter().map(|step| [step.time_s, step.wrench[axis] - step.expected_force[axis]]).collect();
            assert_eq!(line(&forces.panels[2 * axis + 1], &one.name), errors);
            let felt: Vec<[f64; 2]> = steps.iter().map(|step| [step.time_s, step.wrench[axis]]).collect();
            assert_eq!(line(&forces.panels[2 * axis], &one.name), felt);
        }
        let above: Vec<[f64; 2]> = steps.iter().map(|step| [step.tool.translation.x, step.tool.translation.y]).collect();
        assert_eq!(line(&paths.panels[0], &one.name), above);
        assert!(marks(&paths.panels[0], &one.name).iter().all(|mark| mark.color == color));
    }
    assert!(arm_forces(&parts.run()).panels.iter().all(|panel| marks(panel, &parts.outcome.beside[0].name).is_empty()));
    // Who expects no force has no force that is unexpected.
    let mut blind = parts.outcome.beside[0].outcome.steps.clone();
    blind.iter_mut().for_each(|step| step.expected_force.fill(0.0));
    let two = vec![("blind", LIME, &blind[..]), ("expecting", MAROON, &parts.outcome.beside[0].outcome.steps[..])];
    let forces = arm_forces(&parts.run().beside(two));
    assert!(marks(&forces.panels[1], "blind").is_empty() && marks(&forces.panels[1], "expecting").len() == 1);
    assert!(marks(&forces.panels[0], "blind").len() == 1 && marks(&forces.panels[0], "expecting").len() == 1);
}

/// Contract: forces are drawn as the records have them, with what was expected and the difference where the skill has a model of them.
#[test]
fn forces_are_those_of_the_records() {
    for (outcome, expects) in [(outcome(), true), (outcome_of_the_baseline(), false)] {
        let parts = Parts::of(outcome);
        let figure = arm_forces(&parts.run());
        assert_eq!((figure.panels.len(), figure.columns), if expects { (6, 2) } else { (3, 1) });
        for axis in 0..3 {
            let of = |value: &dyn Fn(&StepRecord) -> f64| -> Vec<[f64; 2]> {
                parts.outcome.steps.iter().map(|step| [step.time_s, value(step)]).collect()
            };
            let felt = &figure.panels[axis * figure.columns];
            assert_eq!(line(felt, "measured"), of(&|step| step.wrench[axis]));
            assert_eq!(marks(felt, "expected").len(), usize::from(expects));
            if expects {
                assert_eq!(line(felt, "expected"), of(&|step| step.expected_force[axis]));
                let error = line(&figure.panels[2 * axis + 1], "executed, measured less expected");
                assert_eq!(error, of(&|step| step.wrench[axis] - step.expected_force[axis]));
            }
        }
    }
}

/// Contract: what stands beside the run has a plan of its own, without what forces have moved of it, where that is not the plan of the run.
#[test]
fn another_plan_is_drawn_and_the_same_one_is_not() {
    let parts = Parts::of(outcome());
    let (mut pushed, mut elsewhere) = (parts.outcome.steps.clone(), parts.outcome.steps.clone());
    for step in &mut pushed {
        step.reference.translation.vector.x += 0.03;
        step.deviation.x += 0.03;
    }
    elsewhere.iter_mut().for_each(|step| step.reference.translation.vector.x += 0.03);
    let figure =
        arm_paths(&parts.run().beside(vec![("pushed", LIME, &pushed[..]), ("elsewhere", MAROON, &elsewhere[..])])).expect("a path");
    let above = &figure.panels[0];
    assert!(marks(above, "pushed, planned").is_empty());
    let place = |step: &StepRecord| {
        let place = step.reference.translation.vector - step.deviation;
        [place.x, place.y]
    };
    assert_eq!(line(above, "elsewhere, planned"), elsewhere.iter().map(place).collect::<Vec<_>>());
}
