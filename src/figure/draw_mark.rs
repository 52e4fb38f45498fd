//! One mark: in a panel, and as a sample in the legend.

use plotters::chart::ChartContext;
use plotters::coord::types::RangedCoordf64;
use plotters::coord::{Shift, cartesian::Cartesian2d};
use plotters::element::{Circle, Drawable, PathElement, PointCollection, Polygon, Rectangle, Text};
use plotters::prelude::{DashedLineSeries, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, ShapeStyle};

use super::canvas::{Drawn, Page, TEXT_PT, fill, steps, stroke, text};
use super::mark::{Anchor, Mark, Shape, Symbol};
use crate::palette::Rgb;

/// Lengths of a dash and of the gap behind it (pt).
const DASH_PT: [f64; 2] = [5.0, 3.0];
/// Length and half width of an arrow's head (pt).
const HEAD_PT: [f64; 2] = [7.0, 3.0];
/// Largest radius of a symbol in the legend (pt).
const LARGEST_SAMPLE_PT: f64 = 5.0;

/// A panel with its axes.
pub(super) type Panel<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws a mark in a panel.
pub(super) fn draw_mark(mark: &Mark, panel: &mut Panel<'_, '_>) -> Drawn<()> {
    if let Shape::Band { stretch, opacity } = &mark.shape {
        return draw_band(*stretch, fill(mark.color, *opacity), panel);
    }
    let map = |point: &[f64; 2]| panel.plotting_area().map_coordinate(&(point[0], point[1]));
    let places: Vec<(i32, i32)> = mark.places().iter().map(map).collect();
    let page = panel.plotting_area().strip_coord_spec();
    let origin = page.get_base_pixel();
    let places: Vec<(i32, i32)> = places.into_iter().map(|(x, y)| (x - origin.0, y - origin.1)).collect();
    draw_shape(&mark.shape, mark.color, places, &page)
}

/// Fills the part of a stretch that is in the panel, over its whole height.
fn draw_band(stretch: [f64; 2], look: ShapeStyle, panel: &mut Panel<'_, '_>) -> Drawn<()> {
    let (along, up) = (panel.x_range(), panel.y_range());
    let [from, to] = stretch.map(|end| end.clamp(along.start, along.end));
    let corners = [(from, up.start), (to, up.end)];
    if from < to { panel.plotting_area().draw(&Rectangle::new(corners, look)).map_err(|error| error.to_string()) } else { Ok(()) }
}

/// Draws a sample of a mark, `width_pt` wide, with its left end in the middle of its height at `at` (pt).
pub(super) fn draw_sample(mark: &Mark, at: [f64; 2], width_pt: f64, page: &Page<'_, Shift>) -> Drawn<()> {
    let place = |x: f64, y: f64| (steps(at[0] + x), steps(at[1] + y));
    let places = match &mark.shape {
        Shape::Line { .. } | Shape::Arrow { .. } => vec![place(0.0, 0.0), place(width_pt, 0.0)],
        Shape::Area { .. } | Shape::Band { .. } => {
            vec![place(2.0, -4.0), place(width_pt - 2.0, -4.0), place(width_pt - 2.0, 4.0), place(2.0, 4.0)]
        }
        Shape::Symbols { .. } | Shape::Words { .. } => vec![place(width_pt / 2.0, 0.0)],
    };
    match &mark.shape {
        // A row of the legend is no higher than this.
        Shape::Symbols { symbol, radius_pt, .. } => {
            draw_symbol(*symbol, places[0], steps(radius_pt.min(LARGEST_SAMPLE_PT)), mark.color, page)
        }
        shape => draw_shape(shape, mark.color, places, page),
    }
}

fn draw_shape(shape: &Shape, color: Rgb, places: Vec<(i32, i32)>, page: &Page<'_, Shift>) -> Drawn<()> {
    match shape {
        Shape::Line { width_pt, dashed: false, .. } => put(page, &PathElement::new(places, stroke(color, *width_pt))),
        Shape::Line { width_pt, dashed: true, .. } => dashes(page, places, color, *width_pt),
        Shape::Area { opacity, border_pt, .. } => {
            put(page, &Polygon::new(places.clone(), fill(color, *opacity)))?;
            let closed: Vec<(i32, i32)> = places.iter().chain(places.first()).copied().collect();
            put(page, &PathElement::new(closed, stroke(color, *border_pt)))
        }
        Shape::Band { opacity, .. } => put(page, &Polygon::new(places, fill(color, *opacity))),
        Shape::Symbols { symbol, radius_pt, .. } => {
            places.into_iter().try_for_each(|place| draw_symbol(*symbol, place, steps(*radius_pt), color, page))
        }
        Shape::Arrow { width_pt, .. } => arrow(page, places, color, *width_pt),
        Shape::Words { text: words, anchor, .. } => {
            let side = match anchor {
                Anchor::Left => HPos::Left,
                Anchor::Middle => HPos::Center,
                Anchor::Right => HPos::Right,
            };
            let style = text(TEXT_PT, color, FontStyle::Normal, Pos::new(side, VPos::Center));
            places.into_iter().try_for_each(|place| put(page, &Text::new(words.clone(), place, style.clone())))
        }
    }
}

fn draw_symbol(symbol: Symbol, (x, y): (i32, i32), radius: i32, color: Rgb, page: &Page<'_, Shift>) -> Drawn<()> {
    match symbol {
        Symbol::Disc => put(page, &Circle::new((x, y), radius, fill(color, 1.0))),
        Symbol::Ring => put(page, &Circle::new((x, y), radius, stroke(color, 1.2))),
        Symbol::Square => put(page, &Rectangle::new([(x - radius, y - radius), (x + radius, y + radius)], fill(color, 1.0))),
        Symbol::Cross => {
            put(page, &PathElement::new(vec![(x - radius, y - radius), (x + radius, y + radius)], stroke(color, 1.6)))?;
            put(page, &PathElement::new(vec![(x - radius, y + radius), (x + radius, y - radius)], stroke(color, 1.6)))
        }
    }
}

fn dashes(page: &Page<'_, Shift>, places: Vec<(i32, i32)>, color: Rgb, width_pt: f64) -> Drawn<()> {
    let [dash, gap] = DASH_PT.map(steps);
    DashedLineSeries::new(places, dash, gap, stroke(color, width_pt)).into_iter().try_for_each(|element| put(page, &element))
}

/// The shaft, shortened to the head's middle, and the head.
fn arrow(page: &Page<'_, Shift>, mut places: Vec<(i32, i32)>, color: Rgb, width_pt: f64) -> Drawn<()> {
    let [.., (x0, y0), (x1, y1)] = places[..] else { return Ok(()) };
    let (dx, dy) = (f64::from(x1 - x0), f64::from(y1 - y0));
    let length = dx.hypot(dy).max(1.0);
    let [along, across] = HEAD_PT.map(|pt| f64::from(steps(pt)));
    let at = |back: f64, side: f64| {
        let x = f64::from(x1) - dx / length * back - dy / length * side;
        let y = f64::from(y1) - dy / length * back + dx / length * side;
        (x.round() as i32, y.round() as i32)
    };
    let last = places.len() - 1;
    places[last] = at(along / 2.0, 0.0);
    put(page, &PathElement::new(places, stroke(color, width_pt)))?;
    put(page, &Polygon::new(vec![(x1, y1), at(along, across), at(along, -across)], fill(color, 1.0)))
}

/// Puts an element on the page.
fn put<'a, 'b, E>(page: &Page<'b, Shift>, element: &'a E) -> Drawn<()>
where
    &'a E: PointCollection<'a, (i32, i32)>,
    E: Drawable<SVGBackend<'b>>,
{
    page.draw(element).map_err(|error| error.to_string())
}
