//! Keys of planar experiments, which have no arm.

use super::key::Kind::{Count, Number, Section, Tag, Vector};
use super::key::Length::{AtLeast, Exactly};
use super::key::{Key, Preset, Shape, Variant};
use super::measure::within;

pub(super) const PLANAR: Shape = Shape {
    keys: &[
        Key::new("kind", Tag, "which experiment"),
        Key::new("obstacle_half_depth_m", Number(within("m", 0.05, 10.0)), "half depth of the obstacle, along y").or_number(0.5),
        Key::new("start_m", Vector(within("m", -100.0, 100.0), Exactly(2)), "where movements start").or(Preset::Vector(&[0.0, -4.0])),
        Key::new("clearance_m", Number(within("m", 0.01, 10.0)), "distance at which the person passes the obstacle's edge").or_number(1.0),
        Key::new("pass_fraction", Number(within("", 0.1, 0.9)), "when they pass it, as a fraction of the duration").or_number(0.5),
    ],
    variants: &[
        Variant {
            kind: "obstacle_avoidance",
            keys: &[
                Key::new("hand", Section(TWICE), "how movements are shown").or_empty(),
                Key::new("goal_y_m", Number(within("m", -100.0, 100.0)), "where goals lie along y").or_number(4.0),
                Key::new("obstacle_half_width_m", Number(within("m", 0.05, 10.0)), "half width of the obstacle, along x").or_number(1.0),
                Key::new("taught_goals_x_m", Vector(within("m", -100.0, 100.0), AtLeast(2)), "taught goals along x")
                    .or(Preset::Vector(&[1.0, 2.0, 3.0, 4.0])),
                Key::new("new_goals_x_m", Vector(within("m", -100.0, 100.0), AtLeast(0)), "new goals along x")
                    .or(Preset::Vector(&[-2.0, -1.0, 0.0, 2.5, 5.0])),
            ],
        },
        Variant {
            kind: "two_sided_obstacle",
            keys: &[
                Key::new("hand", Section(THRICE), "how movements are shown").or_empty(),
                Key::new(
                    "taught_half_widths_m",
                    Vector(within("m", 0.05, 10.0), AtLeast(2)),
                    "taught half widths of the obstacle, along x",
                )
                .or(Preset::Vector(&[1.0, 2.0])),
                Key::new("new_half_widths_m", Vector(within("m", 0.05, 10.0), AtLeast(0)), "new half widths")
                    .or(Preset::Vector(&[1.5, 2.5])),
                Key::new("goal_m", Vector(within("m", -100.0, 100.0), Exactly(2)), "where movements end").or(Preset::Vector(&[0.0, 4.0])),
                Key::new("states_without_side", Count(1, 200), "states of the model that is not told the side; any may follow any other")
                    .or(Preset::Count(9)),
                Key::new("kmeans_starts_without_side", Count(0, 1000), "its starts by k-means, beside those by time slices")
                    .or(Preset::Count(4)),
                Key::new("tp_gmm_components", Count(1, 200), "components of TP-GMM").or(Preset::Count(16)),
            ],
        },
    ],
};

const TWICE: Shape = Shape::plain(&hand(2));

const THRICE: Shape = Shape::plain(&hand(3));

const fn hand(repetitions: i64) -> [Key; 7] {
    [
        Key::new("repetitions", Count(1, 50), "how often each situation is shown").or(Preset::Count(repetitions)),
        Key::new("duration_s", Number(within("s", 0.5, 60.0)), "mean duration").or_number(4.0),
        Key::new("rate_hz", Number(within("Hz", 10.0, 1000.0)), "samples per second").or_number(100.0),
        Key::new("duration_spread", Number(within("", 0.0, 0.3)), "spread of the duration, as a fraction of it").or_number(0.05),
        Key::new("timing_spread", Number(within("", 0.0, 0.1)), "spread of when the obstacle is passed, as a fraction of the duration")
            .or_number(0.02),
        Key::new("shape_spread_m", Number(within("m", 0.0, 1.0)), "spread of where it is passed, per axis").or_number(0.05),
        Key::new("noise_m", Number(within("m", 0.0, 0.1)), "noise of the position sensor per axis, standard deviation").or_number(0.002),
    ]
}

/// What makes movements in planar experiments.
pub(super) const METHODS: [&str; 5] = ["cpdmp", "cpdmp_product", "cpdmp_chain", "lwr_dmp", "tp_gmm"];
