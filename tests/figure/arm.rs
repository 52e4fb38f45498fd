//! Contract: the figures of an arm's run say what the records and the skill say: lines are the records, ellipses are the model's Gaussians,
//! bars are its statistic, bands are the moments of compliance.

use cpdmp::figure::{ArmRun, Chart, Figure, Mark, Shape, arm_compliance, arm_forcing, arm_motion, arm_paths, arm_states, svg};
use cpdmp::learning::{ExecutionSettings, LearningSettings};
use cpdmp::simulation::RunOutcome;
use nalgebra::{Matrix2, Vector2};

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
    let outline = |mark: &&'a Mark| match &mark.shape {
        Shape::Area { outline, .. } => &outline[..],
        other => panic!("no outline: {other:?}"),
    };
    marks(chart, legend).iter().map(outline).collect()
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

#[test]
fn every_figure_can_be_drawn_also_for_a_skill_without_states() {
    for (outcome, states) in [(outcome(), 5), (outcome_of_the_baseline(), 0)] {
        let parts = Parts::of(outcome);
        let run = parts.run();
        let mut figures: Vec<Figure> = vec![arm_motion(&run), arm_compliance(&run), arm_forcing(&run).expect("drawn")];
        figures.extend(arm_paths(&run));
        figures.extend(arm_states(&run).expect("drawn"));
        assert_eq!(figures.len(), if states > 0 { 5 } else { 4 });
        for figure in figures {
            assert!(svg(&figure).is_ok_and(|text| text.contains("made up, seed 1")), "{}", figure.title);
        }
    }
}
