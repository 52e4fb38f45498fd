//! Section 4.1 of the paper on 20 seeds: CPDMP keeps clear wherever LWR-DMP collides.

use cpdmp::planar::{Method, ObstacleAvoidanceSettings, PlanarOutcome, obstacle_avoidance};
use rayon::prelude::*;

fn outcomes(settings: &ObstacleAvoidanceSettings) -> Vec<PlanarOutcome> {
    (0..20u64).into_par_iter().map(|seed| obstacle_avoidance(settings, seed).unwrap()).collect()
}

#[test]
fn cpdmp_keeps_clear_wherever_lwr_dmp_collides() {
    let mut collisions = 0;
    for (seed, outcome) in outcomes(&ObstacleAvoidanceSettings::default()).iter().enumerate() {
        for case in &outcome.cases {
            let (own, rival) = (case.of(Method::Cpdmp).next().unwrap(), case.of(Method::LwrDmp).next().unwrap());
            collisions += usize::from(rival.collides);
            assert!(!(rival.collides && own.collides), "seed {seed}, {}: {} m", case.name, own.clearance_m);
        }
    }
    assert!(collisions >= 40, "LWR-DMP collides at the goals that lean most: {collisions}");
}
