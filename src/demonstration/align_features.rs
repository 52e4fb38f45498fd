//! What movements are compared by when they are brought to one timing: where they are, seen from their own chords, and where they head.

use nalgebra::DMatrix;

use super::{Dataset, DemonstrationError};

/// Points of the grid of time fractions on which movements are compared.
pub(super) const POINTS: usize = 151;
/// Weight of the direction of movement beside the position (-).
const DIRECTION: f64 = 1.0;

/// Places and unit directions of every demonstration at equal time fractions (K of points x (1 + 2 d)). Places are seen from each
/// demonstration's own chord, the line from its start to its goal: how far along it, and how far beside it. Movements from other starts or to
/// other goals then look alike where they are alike in time.
pub(super) fn features(dataset: &Dataset) -> Result<Vec<DMatrix<f64>>, DemonstrationError> {
    let mut positions = Vec::new();
    for demonstration in &dataset.demonstrations {
        let grid = demonstration.trajectory.resampled((POINTS - 1) as f64 / demonstration.trajectory.duration_s())?;
        positions.push(grid.select(&dataset.motion)?);
    }
    let directions: Vec<DMatrix<f64>> = z_scored(positions.clone()).iter().map(directions).collect();
    let places = of_common_scale(from_chords(&z_scored(positions)));
    Ok(places.iter().zip(&directions).map(|(place, direction)| joined(place, direction)).collect())
}

/// Every column with mean 0 and deviation 1 over all demonstrations; 0 for one that stands still.
fn z_scored(mut positions: Vec<DMatrix<f64>>) -> Vec<DMatrix<f64>> {
    let d = positions.first().map_or(0, DMatrix::ncols);
    let count = (positions.len() * POINTS) as f64;
    for j in 0..d {
        let mean = positions.iter().map(|p| p.column(j).sum()).sum::<f64>() / count;
        let squares: f64 = positions.iter().flat_map(|p| p.column(j).iter().map(|x| (x - mean).powi(2)).collect::<Vec<_>>()).sum();
        let spread = (squares / count).sqrt();
        let scale = if spread > 1e-9 * mean.abs() && spread > 0.0 { 1.0 / spread } else { 0.0 };
        positions.iter_mut().for_each(|p| p.column_mut(j).apply(|x| *x = (*x - mean) * scale));
    }
    positions
}

/// All columns times one factor, so that together they vary as much as that many columns of deviation 1. A factor of its own for each would make
/// the noise beside a straight path as loud as the way along it.
fn of_common_scale(mut places: Vec<DMatrix<f64>>) -> Vec<DMatrix<f64>> {
    let Some((columns, rows)) = places.first().map(|p| (p.ncols(), places.len() * p.nrows())) else { return places };
    let variance = |j: usize| {
        let mean = places.iter().map(|p| p.column(j).sum()).sum::<f64>() / rows as f64;
        places.iter().map(|p| p.column(j).iter().map(|x| (x - mean).powi(2)).sum::<f64>()).sum::<f64>() / rows as f64
    };
    let total: f64 = (0..columns).map(variance).sum();
    let scale = if total > 0.0 { ((columns - 1).max(1) as f64 / total).sqrt() } else { 0.0 };
    places.iter_mut().for_each(|p| *p *= scale);
    places
}

/// A chord shorter than this fraction of what its movement spans has no direction to speak of (-).
const LEAST_CHORD: f64 = 0.3;

/// How far along its chord each place is (1, from 0 to 1) and how far beside it, in spans of the movement (d). Where one of the movements has no chord, since it ends
/// near its start, places of all are seen from their starts alone.
fn from_chords(positions: &[DMatrix<f64>]) -> Vec<DMatrix<f64>> {
    let chord = |p: &DMatrix<f64>| p.row(p.nrows() - 1) - p.row(0);
    let span = |p: &DMatrix<f64>| p.row_iter().map(|row| (row - p.row(0)).norm()).fold(0.0, f64::max);
    let straight = positions.iter().all(|p| chord(p).norm() > LEAST_CHORD * span(p));
    let seen = |p: &DMatrix<f64>| {
        let (start, chord, span) = (p.row(0).into_owned(), chord(p), span(p));
        let size = if span > 0.0 { 1.0 / span } else { 0.0 };
        let mut places = DMatrix::zeros(p.nrows(), p.ncols() + 1);
        for (t, row) in p.row_iter().enumerate() {
            let way = row - &start;
            let along = if straight { way.dot(&chord) / chord.norm_squared() } else { 0.0 };
            places[(t, 0)] = along;
            places.view_mut((t, 1), (1, p.ncols())).copy_from(&((way - &chord * along) * size));
        }
        places
    };
    positions.iter().map(seen).collect()
}

/// Direction is speed relative to the movement's own mean speed, at most 1 long, so that standing still has none.
fn directions(p: &DMatrix<f64>) -> DMatrix<f64> {
    let d = p.ncols();
    let step = |i: usize| p.row((i + 2).min(POINTS - 1)) - p.row(i.saturating_sub(2));
    let mean = (0..POINTS).map(|i| step(i).norm()).sum::<f64>() / POINTS as f64;
    let mut features = DMatrix::zeros(POINTS, d);
    for i in 0..POINTS {
        let v = step(i);
        let scale = if mean > 0.0 { DIRECTION / (v.norm() + 0.3 * mean) } else { 0.0 };
        features.view_mut((i, 0), (1, d)).copy_from(&(v * scale));
    }
    features
}

/// The columns of both, side by side.
fn joined(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_columns(&a.column_iter().chain(b.column_iter()).collect::<Vec<_>>())
}
