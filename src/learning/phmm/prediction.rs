//! How well the regression over a model predicts sequences.

use nalgebra::DVector;

use super::{Phmm, Sequence, mean_and_spread};
use crate::learning::{Gmr, LearningError};

/// Root mean square error of the regression (14) on `sequences`, each column in units of its standard deviation over `all` (-).
pub(in crate::learning) fn prediction_error(model: &Phmm, sequences: &[Sequence], all: &[Sequence]) -> Result<f64, LearningError> {
    let d = model.dimension();
    let column = |j: usize| all.iter().flat_map(move |s| s.values.iter().skip(j).step_by(d).copied());
    let scale: Vec<f64> = (0..d).map(|j| mean_and_spread(column(j)).1).collect();
    let (mut squares, mut count) = (0.0, 0.0);
    for sequence in sequences {
        let means: Vec<DVector<f64>> = (0..model.states()).map(|i| model.mean_at(i, &sequence.theta)).collect();
        let gmr = Gmr::new(&means, &model.covariances, 1)?;
        for t in 0..sequence.samples() {
            let sample = sequence.sample(t);
            let expected = gmr.mean(&sample[..1]);
            squares += (1..d).map(|j| ((sample[j] - expected[j - 1]) / scale[j]).powi(2)).sum::<f64>();
            count += (d - 1) as f64;
        }
    }
    Ok((squares / f64::max(count, 1.0)).sqrt())
}
