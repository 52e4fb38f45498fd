//! Gaussian mixture regression (13)-(15): what a mixture over inputs and outputs expects of the outputs, given the inputs.
//!
//! ```text
//! h_i(x) = N(x; mu_i^x, Sigma_i^xx) / sum_j N(x; mu_j^x, Sigma_j^xx)                                          (13)
//! y(x) = sum_i h_i [mu_i^y + Sigma_i^yx (Sigma_i^xx)^-1 (x - mu_i^x)]                                         (14), (15)
//! ```
//!
//! Weights are formed from log densities, so a query far from every state is answered by the nearest one, never by 0/0. As in the
//! paper, they use the inputs' marginals without priors.
//!
//! A movement asks with one input, the phase, many times a second: for that case the numbers of all components also lie one after the
//! other in memory. Both ways do the same arithmetic in the same order.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::learning::LearningError;
use crate::math::softmax_in_place;

/// A regression with everything precomputed: a query allocates nothing.
#[derive(Debug, Clone)]
pub struct Gmr {
    inputs: usize,
    outputs: usize,
    components: Vec<Component>,
    /// With one input, for each component: input mean, precision, log normaliser, then output mean and gain of every output.
    line: Vec<f64>,
}

#[derive(Debug, Clone)]
struct Component {
    input_mean: DVector<f64>,
    precision: DMatrix<f64>,
    log_normaliser: f64,
    output_mean: DVector<f64>,
    gain: DMatrix<f64>,
    conditional: DMatrix<f64>,
}

impl Gmr {
    /// From component means (d) and covariances (d x d), whose first `inputs` variables are the inputs.
    ///
    /// # Errors
    /// When there is no component, no input or no output, shapes disagree, or a covariance of the inputs is not SPD.
    pub fn new(means: &[DVector<f64>], covariances: &[DMatrix<f64>], inputs: usize) -> Result<Self, LearningError> {
        let d = means.first().map_or(0, DVector::len);
        if inputs == 0 || inputs >= d || means.len() != covariances.len() {
            let found = format!("{} means, {} covariances, {inputs} inputs of {d} variables", means.len(), covariances.len());
            return Err(LearningError::Model(format!("regression needs one covariance per mean, an input and an output: {found}")));
        }
        let components = means.iter().zip(covariances).enumerate();
        let components = components.map(|(i, (mean, covariance))| Component::new(i, mean, covariance, inputs, d));
        let components = components.collect::<Result<Vec<_>, _>>()?;
        let line = if inputs == 1 { components.iter().flat_map(Component::line).collect() } else { Vec::new() };
        Ok(Self { inputs, outputs: d - inputs, components, line })
    }

    /// Number of components.
    #[must_use]
    pub fn components(&self) -> usize {
        self.components.len()
    }

    /// Number of outputs.
    #[must_use]
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// Weights `h_i` (13) at the inputs `x`, written into `weights` (one per component).
    pub fn weights(&self, x: &[f64], weights: &mut [f64]) {
        if let [x] = x {
            for (h, numbers) in weights.iter_mut().zip(self.line.chunks_exact(LEAD + 2 * self.outputs)) {
                let off = x - numbers[0];
                *h = numbers[2] - 0.5 * (off * numbers[1] * off);
            }
        } else {
            for (h, component) in weights.iter_mut().zip(&self.components) {
                *h = component.log_density(x);
            }
        }
        softmax_in_place(weights);
    }

    /// The expected outputs (14) for weights that [`Self::weights`] has formed, written into `outputs`.
    pub fn mean_into(&self, x: &[f64], weights: &[f64], outputs: &mut [f64]) {
        outputs.fill(0.0);
        if let [x] = x {
            for (numbers, h) in self.line.chunks_exact(LEAD + 2 * self.outputs).zip(weights) {
                let off = x - numbers[0];
                for (y, mean_and_gain) in outputs.iter_mut().zip(numbers[LEAD..].chunks_exact(2)) {
                    *y += h * (mean_and_gain[0] + mean_and_gain[1] * off);
                }
            }
            return;
        }
        for (component, h) in self.components.iter().zip(weights) {
            for (row, y) in outputs.iter_mut().enumerate() {
                *y += h * component.expected(x, row);
            }
        }
    }

    /// The expected outputs at `x`.
    #[must_use]
    pub fn mean(&self, x: &[f64]) -> DVector<f64> {
        let (mut weights, mut outputs) = (vec![0.0; self.components.len()], DVector::zeros(self.outputs));
        self.weights(x, &mut weights);
        self.mean_into(x, &weights, outputs.as_mut_slice());
        outputs
    }

    /// The covariance of the outputs at `x` by the law of total covariance: `sum_i h_i (C_i + y_i y_i^T) - y y^T`.
    #[must_use]
    pub fn covariance(&self, x: &[f64]) -> DMatrix<f64> {
        let mut weights = vec![0.0; self.components.len()];
        self.weights(x, &mut weights);
        let mean = self.mean(x);
        let mut covariance = DMatrix::zeros(self.outputs, self.outputs);
        for (component, h) in self.components.iter().zip(&weights) {
            let off = DVector::from_fn(self.outputs, |row, _| component.expected(x, row)) - &mean;
            covariance += *h * (&component.conditional + &off * off.transpose());
        }
        covariance
    }

    /// The covariance of one component's outputs given its inputs.
    #[must_use]
    pub fn conditional_covariance(&self, component: usize) -> &DMatrix<f64> {
        &self.components[component].conditional
    }

    /// `Sigma_i^yx (Sigma_i^xx)^-1` of one component (outputs x inputs).
    #[must_use]
    pub fn gain(&self, component: usize) -> &DMatrix<f64> {
        &self.components[component].gain
    }

    /// The mean of one component's inputs.
    #[must_use]
    pub fn input_mean(&self, component: usize) -> &DVector<f64> {
        &self.components[component].input_mean
    }

    /// Number of inputs.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.inputs
    }
}

/// Numbers of a component that stand before its outputs in [`Gmr::line`].
const LEAD: usize = 3;

impl Component {
    /// The numbers of a component with one input, as [`Gmr::line`] has them.
    fn line(&self) -> Vec<f64> {
        let outputs = self.output_mean.iter().zip(self.gain.iter()).flat_map(|(mean, gain)| [*mean, *gain]);
        [self.input_mean[0], self.precision[(0, 0)], self.log_normaliser].into_iter().chain(outputs).collect()
    }

    fn new(index: usize, mean: &DVector<f64>, covariance: &DMatrix<f64>, inputs: usize, d: usize) -> Result<Self, LearningError> {
        let wrong = |what: &str| LearningError::Model(format!("state {index}: {what}"));
        if mean.len() != d || covariance.shape() != (d, d) {
            return Err(wrong("mean or covariance of another size than the first state's"));
        }
        let outputs = d - inputs;
        let xx = covariance.view((0, 0), (inputs, inputs)).into_owned();
        let yx = covariance.view((inputs, 0), (outputs, inputs)).into_owned();
        let factor = Cholesky::new(xx).ok_or_else(|| wrong("the inputs' covariance is not positive definite"))?;
        let half_log_determinant: f64 = factor.l_dirty().diagonal().iter().map(|l| l.ln()).sum();
        let gain = factor.solve(&yx.transpose()).transpose();
        let conditional = covariance.view((inputs, inputs), (outputs, outputs)) - &gain * yx.transpose();
        Ok(Self {
            input_mean: mean.rows(0, inputs).into_owned(),
            precision: factor.inverse(),
            log_normaliser: -0.5 * inputs as f64 * std::f64::consts::TAU.ln() - half_log_determinant,
            output_mean: mean.rows(inputs, outputs).into_owned(),
            gain,
            conditional: (&conditional + conditional.transpose()) * 0.5,
        })
    }

    fn log_density(&self, x: &[f64]) -> f64 {
        let mut squares = 0.0;
        for (a, x_a) in x.iter().enumerate() {
            for (b, x_b) in x.iter().enumerate() {
                squares += (x_a - self.input_mean[a]) * self.precision[(a, b)] * (x_b - self.input_mean[b]);
            }
        }
        self.log_normaliser - 0.5 * squares
    }

    fn expected(&self, x: &[f64], row: usize) -> f64 {
        let bent = x.iter().enumerate().map(|(a, x_a)| self.gain[(row, a)] * (x_a - self.input_mean[a]));
        self.output_mean[row] + bent.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Gaussian;

    fn mixture() -> (Vec<DVector<f64>>, Vec<DMatrix<f64>>) {
        let means = vec![DVector::from_vec(vec![0.1, 1.0, -1.0]), DVector::from_vec(vec![0.8, 2.0, 0.5])];
        let c = DMatrix::from_row_slice(3, 3, &[0.04, 0.02, -0.01, 0.02, 0.5, 0.1, -0.01, 0.1, 0.3]);
        (means, vec![c.clone(), &c * 2.0])
    }

    #[test]
    fn one_component_is_the_conditional_gaussian() {
        let (means, covariances) = mixture();
        let gmr = Gmr::new(&means[..1], &covariances[..1], 1).unwrap();
        let x = DVector::from_element(1, 0.37);
        let direct = Gaussian::new(means[0].clone(), covariances[0].clone()).unwrap().conditional(&[0], &x).unwrap();
        assert!((gmr.mean(&[0.37]) - direct.mean()).norm() < 1e-14);
        assert!((gmr.covariance(&[0.37]) - direct.covariance()).norm() < 1e-14);
    }

    #[test]
    fn two_components_are_the_weighted_conditionals() {
        let (means, covariances) = mixture();
        let gmr = Gmr::new(&means, &covariances, 1).unwrap();
        let x = DVector::from_element(1, 0.4);
        let parts: Vec<Gaussian> = (0..2).map(|i| Gaussian::new(means[i].clone(), covariances[i].clone()).unwrap()).collect();
        let h: Vec<f64> = parts.iter().map(|g| g.marginal(&[0]).unwrap().log_density(&x).exp()).collect();
        let y: Vec<DVector<f64>> = parts.iter().map(|g| g.conditional(&[0], &x).unwrap().mean().clone()).collect();
        let expected = (&y[0] * h[0] + &y[1] * h[1]) / (h[0] + h[1]);
        assert!((gmr.mean(&[0.4]) - expected).norm() < 1e-13);
    }

    #[test]
    fn the_line_in_memory_answers_bit_for_bit_as_the_components_do() {
        let (means, covariances) = mixture();
        let gmr = Gmr::new(&means, &covariances, 1).unwrap();
        for i in -20..40 {
            let x = [0.05 * f64::from(i)];
            let (mut h, mut y) = ([0.0; 2], [0.0; 2]);
            gmr.weights(&x, &mut h);
            gmr.mean_into(&x, &h, &mut y);
            let mut slow: Vec<f64> = gmr.components.iter().map(|c| c.log_density(&x)).collect();
            softmax_in_place(&mut slow);
            assert_eq!(h.as_slice(), slow);
            for (row, y) in y.iter().enumerate() {
                assert_eq!(*y, gmr.components.iter().zip(h).map(|(c, h)| h * c.expected(&x, row)).sum::<f64>());
            }
        }
    }

    #[test]
    fn far_queries_are_finite_and_answered_by_the_nearest_state() {
        let (means, covariances) = mixture();
        let gmr = Gmr::new(&means, &covariances, 1).unwrap();
        for x in [-1e6, 1e6] {
            assert!(gmr.mean(&[x]).iter().chain(gmr.covariance(&[x]).iter()).all(|y| y.is_finite()));
        }
        assert!(Gmr::new(&means, &covariances, 3).is_err() && Gmr::new(&[], &[], 1).is_err());
    }
}
