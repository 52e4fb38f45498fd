//! One panel: title, axes, marks.

use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, RGBColor};

use super::canvas::{Drawn, Page, TITLE_PT, plain, steps, stroke, text};
use super::chart::Chart;
use super::draw_mark::draw_mark;
use super::extent::extent;
use super::ticks::tick;
use crate::palette::{BLACK, GREY};

/// Height of the title (pt), if there is one.
const TITLE_HEIGHT_PT: f64 = 20.0;
/// Width of the vertical axis' numbers and label, and height of the horizontal one's (pt).
const LABELS_PT: [f64; 2] = [54.0, 34.0];
/// Space at the left and at the right (pt), the latter for half of the last number.
const SIDES_PT: [f64; 2] = [6.0, 14.0];
/// Space above the title (pt), to the panel above.
const TOP_PT: f64 = 8.0;
/// Ticks per axis, at most: one per so many points.
const TICK_PT: [f64; 2] = [45.0, 20.0];

/// Draws a panel of this size (pt).
pub(super) fn draw_chart(chart: &Chart, size_pt: [f64; 2], area: &Page<'_, Shift>) -> Drawn<()> {
    let labels_pt = if chart.axes.is_some() { LABELS_PT } else { [SIDES_PT[1] - SIDES_PT[0], 6.0] };
    let title_pt = if chart.title.is_empty() { 0.0 } else { TITLE_HEIGHT_PT };
    let left_pt = SIDES_PT[0] + labels_pt[0];
    let plot_pt = [size_pt[0] - left_pt - SIDES_PT[1], size_pt[1] - labels_pt[1] - title_pt - TOP_PT];
    let Some([x, y]) = extent(chart, plot_pt) else { return Err("a panel is empty".to_owned()) };
    let title = text(TITLE_PT, BLACK, FontStyle::Bold, Pos::new(HPos::Center, VPos::Center));
    let middle = steps(left_pt + plot_pt[0] / 2.0);
    area.draw_text(&chart.title, &title, (middle, steps(TOP_PT + title_pt / 2.0))).map_err(|error| error.to_string())?;
    let mut context = ChartBuilder::on(area)
        .margin_top(steps(TOP_PT + title_pt))
        .margin_left(steps(SIDES_PT[0]))
        .margin_right(steps(SIDES_PT[1]))
        .x_label_area_size(steps(labels_pt[1]))
        .y_label_area_size(steps(labels_pt[0]))
        .build_cartesian_2d(x[0]..x[1], y[0]..y[1])
        .map_err(|error| error.to_string())?;
    if let Some([horizontal, vertical]) = &chart.axes {
        let number = plain(Pos::default());
        let most = [0, 1].map(|axis| (plot_pt[axis] / TICK_PT[axis]).max(2.0) as usize);
        context
            .configure_mesh()
            .max_light_lines(0)
            .bold_line_style(RGBColor(GREY.red, GREY.green, GREY.blue).mix(0.25).stroke_width(steps(0.4) as u32))
            .axis_style(stroke(BLACK, 0.7))
            .x_labels(most[0])
            .y_labels(most[1])
            .x_label_formatter(&|value| tick(*value, x))
            .y_label_formatter(&|value| tick(*value, y))
            .x_desc(&horizontal.label)
            .y_desc(&vertical.label)
            .label_style(number.clone())
            .axis_desc_style(number)
            .set_all_tick_mark_size(steps(3.0))
            .draw()
            .map_err(|error| error.to_string())?;
    }
    chart.marks.iter().filter(|mark| mark.is_finite()).try_for_each(|mark| draw_mark(mark, &mut context))
}
