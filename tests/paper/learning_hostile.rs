//! Demonstrations that nobody should record, through reading, learning and generating: a clear error, or finite numbers.

use std::fmt::Write;

use cpdmp::demonstration::Dataset;
use cpdmp::learning::{ExecutionSettings, Features, LearningSettings, ShapingKind, Skill, generate, learn};
use proptest::prelude::*;

/// What is wrong with a data set.
#[derive(Debug, Clone)]
struct Hostile {
    /// Samples of each demonstration.
    samples: Vec<usize>,
    /// Size and offset of the movement (m).
    scale: f64,
    offset: f64,
    /// Whether the second column never changes.
    constant: bool,
    /// How parameters go with the demonstrations: one value for all, collinear, two huge ones, distinct.
    thetas: usize,
    /// A cell (demonstration, row, column) and what stands in it.
    bad: Option<(usize, usize, usize, &'static str)>,
    /// Step between samples (s).
    step_s: f64,
    /// How far away it is asked (-).
    query: f64,
}

fn hostile() -> impl Strategy<Value = Hostile> {
    let sizes = prop::sample::select(vec![1_usize, 2, 3, 5, 8, 13, 40, 90]);
    let scales = prop::sample::select(vec![0.0, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12]);
    let cells = prop::sample::select(vec!["nan", "inf", "", "-1", "0", "x", "1e308", "-1e308", "1e-320"]);
    let bad = prop::option::weighted(0.4, (0_usize..4, 0_usize..8, 0_usize..3, cells));
    let steps = prop::sample::select(vec![1e-6, 1e-3, 0.01, 0.1, 10.0, 1e4]);
    let queries = prop::sample::select(vec![-1e6, -3.0, 0.0, 0.5, 1.0, 1e3, 1e9]);
    let shape = (prop::collection::vec(sizes, 1..5), scales.clone(), scales, any::<bool>(), 0_usize..4);
    (shape, bad, steps, queries).prop_map(|((samples, scale, offset, constant, thetas), bad, step_s, query)| Hostile {
        samples,
        scale,
        offset,
        constant,
        thetas,
        bad,
        step_s,
        query,
    })
}

impl Hostile {
    fn theta(&self, k: usize) -> [f64; 2] {
        let k = k as f64;
        [[0.3, 0.3], [k, 2.0 * k], [1e9 + k, -1e-9 * k], [0.1 * k, (7.0 * k).sin()]][self.thetas]
    }

    /// The data set as files in `folder`.
    fn write(&self, folder: &std::path::Path) {
        let mut list = "schema_version = 1\nmotion = [\"x_m\", \"y_m\"]\nwrench = []\n".to_owned();
        for (k, samples) in self.samples.iter().enumerate() {
            let mut text = "time_s,x_m,y_m\n".to_owned();
            for t in 0..*samples {
                let u = t as f64 / (*samples as f64 - 1.0).max(1.0);
                let x = self.offset + self.scale * (u + 0.3 * (5.0 * u).sin() * (1.0 + 0.1 * k as f64));
                let y = if self.constant { self.offset } else { self.offset - self.scale * u * u };
                let mut cells = [format!("{:e}", self.step_s * t as f64), format!("{x:e}"), format!("{y:e}")];
                if let Some((demonstration, row, column, cell)) = self.bad
                    && (demonstration, row) == (k, t)
                {
                    cells[column] = cell.to_owned();
                }
                writeln!(text, "{}", cells.join(",")).unwrap();
            }
            std::fs::write(folder.join(format!("{k}.csv")), text).unwrap();
            let [a, b] = self.theta(k);
            writeln!(list, "[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {{ a = {a:?}, b = {b:?} }}").unwrap();
        }
        std::fs::write(folder.join("dataset.toml"), list).unwrap();
    }

    /// Where it is asked: between and far beyond the demonstrations.
    fn asked(&self) -> ExecutionSettings {
        let ([a, b], [c, d]) = (self.theta(0), self.theta(self.samples.len() - 1));
        let theta_m = vec![("a".to_owned(), a + self.query * (c - a)), ("b".to_owned(), b + self.query * (d - b))];
        ExecutionSettings { theta_m, ..ExecutionSettings::default() }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn hostile_demonstrations_lead_to_an_error_or_to_finite_numbers(
        hostile in hostile(),
        (states, features, align, baseline) in (1_usize..7, 0_usize..3, any::<bool>(), any::<bool>()),
        ridge in prop::sample::select(vec![0.0, 0.1]),
    ) {
        let folder = tempfile::tempdir().unwrap();
        hostile.write(folder.path());
        let mut settings = LearningSettings { align, lwr_basis: 5, ..LearningSettings::default() };
        settings.shaping = if baseline { ShapingKind::Lwr } else { ShapingKind::Phmm };
        settings.motion.features = [Features::Linear, Features::Quadratic, Features::Rbf { centres: 3, width: 1.0 }][features];
        (settings.motion.states, settings.motion.kmeans_starts, settings.motion.max_iterations, settings.motion.ridge) = (states, 1, 15, ridge);
        let dataset = match Dataset::read(folder.path()) {
            Ok(dataset) => dataset,
            Err(error) => {
                prop_assert!(!error.faults().is_empty() && !error.to_string().is_empty());
                return Ok(());
            }
        };
        let learned = match learn(&dataset, &settings, 1) {
            Ok(learned) => learned,
            Err(error) => {
                prop_assert!(error.to_string().len() > 10, "{error}");
                return Ok(());
            }
        };
        let again = Skill::from_json(&learned.skill.to_json().unwrap());
        prop_assert!(again.is_ok_and(|skill| skill == learned.skill), "what is learned can be written and read again");
        match generate(&learned.skill, &hostile.asked(), learned.skill.motion.duration_s / 50.0, 1.2) {
            Ok(moved) => prop_assert!(moved.values().iter().all(|x| x.is_finite()), "{hostile:?}"),
            Err(error) => prop_assert!(error.to_string().len() > 10, "{error}"),
        }
    }
}
