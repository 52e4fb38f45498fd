//! Sums of probabilities that are far too small to be written down, kept as logarithms.

/// `ln sum_i exp(x_i)`, exact to rounding for any finite or `-inf` entries; `-inf` for an empty slice.
///
/// The largest entry is taken out first, so nothing overflows and at least one term of the sum is 1.
#[must_use]
pub fn log_sum_exp(log_values: &[f64]) -> f64 {
    let largest = log_values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if largest == f64::NEG_INFINITY {
        return largest;
    }
    largest + log_values.iter().map(|x| (x - largest).exp()).sum::<f64>().ln()
}

/// Replaces log weights by the weights `exp(x_i) / sum_j exp(x_j)` and returns the logarithm of that sum.
///
/// When every entry is `-inf` the weights are equal: no entry is then more likely than another.
pub fn softmax_in_place(log_weights: &mut [f64]) -> f64 {
    let largest = log_weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if largest == f64::NEG_INFINITY {
        let equal = 1.0 / log_weights.len() as f64;
        log_weights.fill(equal);
        return largest;
    }
    let mut total = 0.0;
    for w in log_weights.iter_mut() {
        *w = (*w - largest).exp();
        total += *w;
    }
    for w in log_weights.iter_mut() {
        *w /= total;
    }
    largest + total.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_survive_values_no_float_can_hold() {
        assert!((log_sum_exp(&[-1e6, -1e6]) - (-1e6 + 2f64.ln())).abs() < 1e-9);
        assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
        assert_eq!(log_sum_exp(&[f64::NEG_INFINITY, 3.0]), 3.0);
    }

    #[test]
    fn weights_sum_to_one_even_far_away() {
        let mut w = [-1e12, -1e12 - 1.0, f64::NEG_INFINITY];
        softmax_in_place(&mut w);
        assert!((w.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let mut none = [f64::NEG_INFINITY; 4];
        softmax_in_place(&mut none);
        assert_eq!(none, [0.25; 4]);
    }
}
