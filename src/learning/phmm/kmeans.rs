//! k-means clustering with k-means++ seeds.

use rand_chacha::ChaCha8Rng;

use crate::math::uniform;

/// Iterations after which the clustering is good enough to start from.
const MOST_ITERATIONS: usize = 50;

/// Labels (T) of samples given row by row (T x d): `clusters` groups with small distances to their centres. An empty cluster takes
/// the sample that lies farthest from its centre.
#[must_use]
pub fn k_means(samples: &[f64], dimension: usize, clusters: usize, random: &mut ChaCha8Rng) -> Vec<usize> {
    let rows: Vec<&[f64]> = samples.chunks_exact(dimension).collect();
    if rows.is_empty() || clusters == 0 {
        return vec![0; rows.len()];
    }
    let mut centres = seeds(&rows, clusters, random);
    let mut labels = vec![usize::MAX; rows.len()];
    for _ in 0..MOST_ITERATIONS {
        let nearest: Vec<(usize, f64)> = rows.iter().map(|row| nearest_centre(row, &centres)).collect();
        let changed = labels.iter().zip(&nearest).any(|(before, (now, _))| before != now);
        labels = nearest.iter().map(|(label, _)| *label).collect();
        if !changed {
            break;
        }
        move_centres(&rows, &mut labels, &nearest, &mut centres);
    }
    labels
}

/// k-means++: each further centre is a sample drawn in proportion to its squared distance from the **nearest** centre so far.
fn seeds(rows: &[&[f64]], clusters: usize, random: &mut ChaCha8Rng) -> Vec<Vec<f64>> {
    let first = (uniform(random, 0.0, rows.len() as f64) as usize).min(rows.len() - 1);
    let mut centres = vec![rows[first].to_vec()];
    let mut distances: Vec<f64> = rows.iter().map(|row| squared_distance(row, &centres[0])).collect();
    while centres.len() < clusters {
        let mut left = uniform(random, 0.0, distances.iter().sum());
        let drawn = distances.iter().position(|d| {
            left -= d;
            left < 0.0
        });
        let centre = rows[drawn.unwrap_or(rows.len() - 1)].to_vec();
        for (distance, row) in distances.iter_mut().zip(rows) {
            *distance = distance.min(squared_distance(row, &centre));
        }
        centres.push(centre);
    }
    centres
}

fn move_centres(rows: &[&[f64]], labels: &mut [usize], nearest: &[(usize, f64)], centres: &mut [Vec<f64>]) {
    let mut occupied = vec![false; centres.len()];
    labels.iter().for_each(|label| occupied[*label] = true);
    if occupied.contains(&false) {
        let mut far: Vec<usize> = (0..rows.len()).collect();
        far.sort_by(|a, b| nearest[*a].1.total_cmp(&nearest[*b].1));
        for cluster in 0..centres.len() {
            if !labels.contains(&cluster)
                && let Some(sample) = far.pop()
            {
                labels[sample] = cluster;
            }
        }
    }
    let mut counts = vec![0.0; centres.len()];
    let mut sums = vec![vec![0.0; rows[0].len()]; centres.len()];
    for (row, label) in rows.iter().zip(labels.iter()) {
        counts[*label] += 1.0;
        for (sum, x) in sums[*label].iter_mut().zip(*row) {
            *sum += x;
        }
    }
    for ((centre, sum), count) in centres.iter_mut().zip(sums).zip(counts).filter(|(_, count)| *count > 0.0) {
        *centre = sum.into_iter().map(|s| s / count).collect();
    }
}

fn nearest_centre(row: &[f64], centres: &[Vec<f64>]) -> (usize, f64) {
    let distances = centres.iter().map(|centre| squared_distance(row, centre)).enumerate();
    distances.fold((0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
}

fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{standard_normal, stream};

    #[test]
    fn three_separated_clusters_are_found_from_any_seed() {
        for seed in 0..100 {
            let mut random = stream(seed, "clusters", 0);
            let mut samples = Vec::new();
            for t in 0..60 {
                let centre = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)][t % 3];
                samples.extend([centre.0 + 0.3 * standard_normal(&mut random), centre.1 + 0.3 * standard_normal(&mut random)]);
            }
            let labels = k_means(&samples, 2, 3, &mut random);
            assert!((0..60).all(|t| labels[t] == labels[t % 3]) && labels[0] != labels[1] && labels[1] != labels[2], "seed {seed}");
        }
    }

    #[test]
    fn equal_samples_do_not_hang_or_panic() {
        let labels = k_means(&[1.0; 12], 2, 4, &mut stream(0, "equal", 0));
        assert_eq!(labels.len(), 6);
    }
}
