//! Demonstrations as a person would record them: one CSV file, several repetitions of different lengths, start points and speeds.

use std::fmt::Write;

/// `time_s`, a repetition number and two columns in m: strokes from a start point of their own to one goal, with an arc on the way. The
/// same `repetitions` give the same text. Starts lie on a line, `0.1 * k` m apart.
pub fn strokes_csv(repetitions: usize) -> String {
    let mut text = String::from("time_s,repetition,x_m,y_m\n");
    for k in 0..repetitions {
        let (samples, duration) = (90 + 17 * (k % 3), 1.8 + 0.2 * (k % 4) as f64);
        for i in 0..samples {
            let u = i as f64 / (samples - 1) as f64;
            let [x, y] = stroke(start_of(k), u);
            writeln!(text, "{:.5},{k},{x:.6},{y:.6}", duration * u).expect("text grows");
        }
    }
    text
}

/// The start of repetition `k` (m).
pub fn start_of(k: usize) -> [f64; 2] {
    [0.1 * k as f64, 0.05 * (k % 2) as f64]
}

/// Where the stroke from `start` is at time fraction `u` (m): minimum jerk to (1, 0.5), over an arc of 0.2 m.
pub fn stroke(start: [f64; 2], u: f64) -> [f64; 2] {
    let s = u * u * u * (10.0 + u * (6.0 * u - 15.0));
    let arc = 0.2 * (std::f64::consts::PI * s).sin().powi(2);
    [start[0] + (1.0 - start[0]) * s, start[1] + (0.5 - start[1]) * s + arc]
}
