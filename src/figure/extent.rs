//! The ranges of a panel's axes.

use super::chart::Chart;

/// Free space around the marks, as a fraction of the range.
const SPACE: f64 = 0.04;

/// Where the marks of a panel are: the least and the greatest value on each axis, with a little space around. `None` without a finite mark.
pub(super) fn extent(chart: &Chart, plot_size: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let marks = || chart.marks.iter().filter(|mark| mark.is_finite()).flat_map(|mark| mark.places());
    let mut ranges = [0, 1].map(|axis| {
        let included = chart.axes.as_ref().map_or(&[][..], |axes| &axes[axis].includes);
        let values = marks().map(|place| place[axis]).chain(included.iter().copied());
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    });
    if ranges.iter().any(|[low, high]| low > high) {
        return None;
    }
    for (range, axis) in ranges.iter_mut().zip([0, 1]) {
        let least = chart.axes.as_ref().map_or(0.0, |axes| axes[axis].least_range);
        let missing = (least - (range[1] - range[0])).max(0.0);
        *range = [range[0] - missing / 2.0, range[1] + missing / 2.0];
        let width = range[1] - range[0];
        // A range of nothing still needs two ends.
        let space = if width > 0.0 { SPACE * width } else { range[0].abs().max(1.0) * 0.5 };
        *range = [range[0] - space, range[1] + space];
    }
    if chart.equal_aspect {
        let per_point = [0, 1].map(|axis| (ranges[axis][1] - ranges[axis][0]) / plot_size[axis]);
        let coarser = per_point[0].max(per_point[1]);
        for (range, size) in ranges.iter_mut().zip(plot_size) {
            let missing = coarser * size - (range[1] - range[0]);
            *range = [range[0] - missing / 2.0, range[1] + missing / 2.0];
        }
    }
    Some(ranges)
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Chart, Mark};
    use super::*;
    use crate::palette::BLACK;

    fn chart(equal_aspect: bool, points: Vec<[f64; 2]>) -> Chart {
        let axes = [Axis::new("x (m)"), Axis::new("y (m)")];
        Chart { equal_aspect, marks: vec![Mark::line("", BLACK, 1.0, points)], ..Chart::map("", axes) }
    }

    #[test]
    fn every_mark_is_inside_and_a_map_has_one_scale() {
        let points = vec![[-1.0, 5.0], [3.0, 8.0], [0.5, 5.5]];
        for equal_aspect in [false, true] {
            let [x, y] = extent(&chart(equal_aspect, points.clone()), [400.0, 100.0]).expect("marks");
            assert!(points.iter().all(|p| (x[0]..x[1]).contains(&p[0]) && (y[0]..y[1]).contains(&p[1])));
            let scales = [(x[1] - x[0]) / 400.0, (y[1] - y[0]) / 100.0];
            assert_eq!((scales[0] - scales[1]).abs() < 1e-12, equal_aspect, "{scales:?}");
        }
    }

    #[test]
    fn noise_is_drawn_over_a_range_that_is_long_enough() {
        let noise = vec![[0.0, 2.0], [1.0, 2.000_001]];
        let mut drawn = chart(false, noise);
        drawn.axes = Some([Axis::new("t (s)"), Axis::at_least("y (m)", 0.01)]);
        let [x, y] = extent(&drawn, [400.0, 100.0]).expect("marks");
        assert!((y[1] - y[0] - 0.01 * (1.0 + 2.0 * SPACE)).abs() < 1e-12 && (0.5 * (y[0] + y[1]) - 2.000_000_5).abs() < 1e-12, "{y:?}");
        assert!((x[1] - x[0] - (1.0 + 2.0 * SPACE)).abs() < 1e-12, "{x:?}");
    }

    #[test]
    fn one_point_has_a_range_and_nothing_has_none() {
        let [x, y] = extent(&chart(false, vec![[2.0, 0.0]]), [1.0, 1.0]).expect("a mark");
        assert!(x[0] < 2.0 && x[1] > 2.0 && y[0] < 0.0 && y[1] > 0.0);
        assert_eq!(extent(&chart(false, Vec::new()), [1.0, 1.0]), None);
        assert_eq!(extent(&chart(false, vec![[f64::NAN, 0.0]]), [1.0, 1.0]), None);
    }
}
