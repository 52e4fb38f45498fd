//! Random numbers that are the same on every machine and in every version: one named stream per consumer.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// The stream of random numbers called `name`, number `index`, of the run with this `seed`.
///
/// Streams of different names or indices are independent, so adding a consumer never changes what another one draws. The generator
/// is ChaCha8, whose output is fixed by its specification; the key is `seed`, the FNV-1a hash of `name`, `index`, and zero.
#[must_use]
pub fn stream(seed: u64, name: &str, index: u64) -> ChaCha8Rng {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key[8..16].copy_from_slice(&fnv_1a(name.as_bytes()).to_le_bytes());
    key[16..24].copy_from_slice(&index.to_le_bytes());
    ChaCha8Rng::from_seed(key)
}

/// One draw from `N(0, 1)`.
pub fn standard_normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// One draw, uniform in `[from, to)`.
pub fn uniform(random: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    from + (to - from) * random.random::<f64>()
}

fn fnv_1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_stable_and_distinct() {
        let first = |seed, name, index| standard_normal(&mut stream(seed, name, index));
        assert_eq!(first(7, "human", 0).to_bits(), first(7, "human", 0).to_bits());
        let others = [first(8, "human", 0), first(7, "noise", 0), first(7, "human", 1)];
        assert!(others.iter().all(|x| *x != first(7, "human", 0)));
    }

    #[test]
    fn normal_draws_have_mean_zero_and_variance_one() {
        let mut random = stream(1, "moments", 0);
        let draws: Vec<f64> = (0..20_000).map(|_| standard_normal(&mut random)).collect();
        let mean = draws.iter().sum::<f64>() / 2e4;
        let variance = draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 2e4;
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.04);
    }
}
