//! Section 4.2 of the paper on 20 seeds: an obstacle of a new width is passed on the side that is told, or on both when none is told.

use std::sync::LazyLock;

use cpdmp::learning::phmm::FitStatus;
use cpdmp::planar::{Case, Guidance, Method, PlanarOutcome, Side, TwoSidedObstacleSettings, two_sided_obstacle};
use rayon::prelude::*;

const SIDES: [Side; 2] = [Side::Left, Side::Right];

/// The default task and models, shared by the tests.
static DEFAULT: LazyLock<Vec<PlanarOutcome>> = LazyLock::new(|| outcomes(&TwoSidedObstacleSettings::default()));

fn outcomes(settings: &TwoSidedObstacleSettings) -> Vec<PlanarOutcome> {
    (0..20u64).into_par_iter().map(|seed| two_sided_obstacle(settings, seed, &|| true).unwrap()).collect()
}

/// The clearance, as a share of the ideal one, of the best movement of a method on a side; negative infinity when it never passes there.
fn share(case: &Case, method: Method, side: Side) -> f64 {
    let ideal = case.ideals.iter().find(|ideal| ideal.side == side).unwrap().clearance_m;
    let there = case.of(method).filter(|m| m.side == Some(side));
    there.map(|m| m.clearance_m / ideal).fold(f64::NEG_INFINITY, f64::max)
}

fn new_cases(outcome: &PlanarOutcome, guidance: Guidance) -> impl Iterator<Item = &Case> {
    outcome.cases_with(guidance).filter(|case| !case.taught)
}

/// Sorted shares over all seeds and new widths.
fn shares(outcomes: &[PlanarOutcome], guidance: Guidance, method: Method) -> Vec<f64> {
    let cases = outcomes.iter().flat_map(|outcome| new_cases(outcome, guidance));
    let mut shares: Vec<f64> = cases.flat_map(|case| case.ideals.iter().map(move |ideal| share(case, method, ideal.side))).collect();
    shares.sort_by(f64::total_cmp);
    shares
}

/// Reached elsewhere: 2.9 of 4.0 by CPDMP, 4.0 by TP-GMM, which is better here.
#[test]
fn told_the_side_cpdmp_keeps_most_of_the_clearance_and_tp_gmm_all_of_it() {
    let outcomes = &*DEFAULT;
    let product = shares(outcomes, Guidance::WithSide, Method::CpdmpProduct);
    assert!(product[0] > 0.65, "worst of CPDMP: {}", product[0]);
    assert!(product[product.len() / 2] > 0.9, "median of CPDMP: {}", product[product.len() / 2]);
    let rival = shares(outcomes, Guidance::WithSide, Method::TpGmm);
    assert!(rival[0] > 0.85, "worst of TP-GMM: {}", rival[0]);
    assert!(rival[0] > product[0], "TP-GMM is better here: {} against {}", rival[0], product[0]);
    // A mean that is linear in side and width moves both sides the same way: at the wider obstacle it must fail.
    let linear = outcomes.iter().flat_map(|o| new_cases(o, Guidance::WithSide)).filter(|case| case.extrapolation > 0.0);
    let least = linear.map(|case| share(case, Method::Cpdmp, case.ideals[0].side)).fold(f64::INFINITY, f64::min);
    assert!(least < 0.0, "linear features cannot form side x width: {least}");
}

/// Reached elsewhere: 2.1 of 4.0 per side at N = 9, two chains in 9 of 10 data sets at N = 8 and 9.
#[test]
fn not_told_the_side_chains_pass_on_both_and_nothing_else_does() {
    let mut eight = TwoSidedObstacleSettings::default();
    eight.learning_without_side.motion.states = 8;
    // What is told the side is not looked at here.
    (eight.learning.motion.states, eight.learning.motion.max_iterations) = (2, 5);
    for (states, outcomes) in [(8, &outcomes(&eight)), (9, &*DEFAULT)] {
        let two = outcomes.iter().filter(|o| o.transitions.as_ref().unwrap().chains.len() == 2).count();
        assert!(two >= 18, "N = {states}: two chains in {two} of 20 data sets");
        for (seed, outcome) in outcomes.iter().enumerate() {
            for case in new_cases(outcome, Guidance::WithoutSide) {
                for side in SIDES {
                    let kept = share(case, Method::CpdmpChain, side);
                    assert!(kept > 0.525, "N = {states}, seed {seed}, {}, {}: {kept}", case.name, side.key());
                }
                for movement in case.of(Method::Cpdmp).chain(case.of(Method::TpGmm)) {
                    assert!(movement.collides, "N = {states}, seed {seed}, {}: {} m", case.name, movement.clearance_m);
                }
                assert_eq!(case.winner, Some(Method::CpdmpChain), "seed {seed}, {}", case.name);
            }
        }
    }
}

#[test]
fn the_outcome_is_complete_and_the_same_on_any_number_of_threads() {
    let settings = TwoSidedObstacleSettings::default();
    let outcome = &DEFAULT[3];
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert!(pool.install(|| two_sided_obstacle(&settings, 3, &|| true)).unwrap() == *outcome, "one thread gives the same bits");
    assert_eq!(outcome.demonstrations.len(), 12);
    assert!(outcome.demonstrations.iter().all(|shown| shown.clearance_m > 0.5));
    assert_eq!(outcome.demonstrations.iter().filter(|shown| shown.side == Side::Left).count(), 6);
    for model in &outcome.models {
        // The linear model of a product needs more iterations than it has; it must say so.
        let converged = model.status == Some(FitStatus::Converged);
        assert!(converged || model.warnings.iter().any(|w| w.contains("without converging")), "{:?} {:?}", model.method, model.status);
        assert!(model.log_likelihood.len() > 2 && model.log_likelihood.last() > model.log_likelihood.first());
    }
    let transitions = outcome.transitions.as_ref().unwrap();
    for row in &transitions.matrix {
        assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    }
    for curve in &outcome.forcing {
        let states = match (curve.method, curve.chain) {
            (None, _) => 0,
            (Some(Method::CpdmpChain), Some(chain)) => transitions.chains[chain].states.len(),
            (Some(method), _) => outcome.model(method, curve.guidance).unwrap().states,
        };
        assert_eq!(curve.states.len(), states);
        assert!(curve.phase.len() == curve.forcing_m.len() && curve.forcing_m.iter().flatten().all(|f| f.is_finite()));
    }
}

#[test]
fn tasks_that_cannot_be_shown_are_refused_with_all_their_faults() {
    let settings = TwoSidedObstacleSettings { taught_half_widths_m: vec![1.0, 1.0], clearance_m: -1.0, ..Default::default() };
    let message = two_sided_obstacle(&settings, 0, &|| true).unwrap_err().to_string();
    assert!(message.contains("different taught_half_widths_m") && message.contains("clearance_m is -1"), "{message}");
    let inside = TwoSidedObstacleSettings { goal_m: [0.0, 0.1], ..Default::default() };
    let message = two_sided_obstacle(&inside, 0, &|| true).unwrap_err().to_string();
    assert!(message.contains("half_width_m = 1 is -") && message.contains("half_width_m = 2.5"), "{message}");
    let not_a_number = TwoSidedObstacleSettings { start_m: [f64::NAN, -4.0], ..Default::default() };
    assert!(two_sided_obstacle(&not_a_number, 0, &|| true).is_err());
}
