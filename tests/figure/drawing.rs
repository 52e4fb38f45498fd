//! Contract: a drawing is well-formed SVG, everything in it is on the page, every series is there, and no text is lost.

use cpdmp::figure::{Anchor, Axis, Chart, Edge, Figure, Mark, Node, Symbol, graph, svg};
use cpdmp::math::{covariance_outline, ellipse_outline};
use cpdmp::palette::{BLACK, BLUE, GREY, ORANGE, VERMILION};
use nalgebra::Matrix2;
use roxmltree::{Document, Node as Element};

/// A figure with every kind of mark.
fn figure() -> Figure {
    let wave: Vec<[f64; 2]> = (0..200).map(|i| f64::from(i) / 50.0).map(|x| [x, (3.0 * x).sin()]).collect();
    let mut map = Chart::map("A map", [Axis::new("x (m)"), Axis::new("y (m)")]);
    map.marks = vec![
        Mark::area("obstacle", GREY, 0.5, ellipse_outline([2.0, 0.0], [0.5, 1.0])),
        Mark::line("a <wave> & more", BLUE, 1.5, wave.clone()),
        Mark::dashes("dashes", ORANGE, 1.5, wave.iter().map(|[x, y]| [*x, y + 0.5]).collect()),
        Mark::symbols("hit", VERMILION, Symbol::Cross, 4.0, vec![[1.0, 0.0], [2.0, 0.5]]),
        Mark::words(BLACK, [0.0, 1.0], Anchor::Left, "words"),
    ];
    let mut plot = Chart::plot("A plot", [Axis::new("time fraction (-)"), Axis::new("forcing (m)")]);
    plot.marks = vec![
        Mark::line("a <wave> & more", BLUE, 1.0, wave),
        Mark::area("state", ORANGE, 0.2, covariance_outline([1.0, 0.5], &Matrix2::new(0.1, 0.05, 0.05, 0.1), 2.0)),
    ];
    let node = |name: &str, x| Node { name: name.into(), at: [x, 0.0], color: ORANGE, legend: "chain 1".into() };
    let edge = |from, to| Edge { from, to, label: "0.98".into(), width_pt: 1.0, color: BLACK };
    let mut bare = Chart::bare("A graph");
    bare.marks = graph(&[node("0", 0.0), node("1", 100.0)], &[edge(0, 1), edge(1, 0)], 1.0);
    Figure { title: "Everything".into(), panels: vec![map, plot, bare], columns: 2, panel_size_pt: [320.0, 240.0] }
}

fn numbers(element: Element<'_, '_>, attribute: &str) -> Vec<f64> {
    let text = element.attribute(attribute).unwrap_or_default();
    text.split([' ', ',']).filter(|part| !part.is_empty()).map(|part| part.parse().expect("a number")).collect()
}

#[test]
fn everything_is_on_the_page_and_nothing_is_lost() {
    let text = svg(&figure()).expect("drawn");
    let document = Document::parse(&text).expect("well-formed");
    let root = document.root_element();
    let view = numbers(root, "viewBox");
    let inside = |x: f64, y: f64| (0.0..=view[2]).contains(&x) && (0.0..=view[3]).contains(&y);
    for element in root.descendants().filter(Element::is_element) {
        let points = numbers(element, "points");
        assert!(points.chunks(2).all(|point| inside(point[0], point[1])), "{element:?}");
        if let ([x], [y]) = (&numbers(element, "x")[..], &numbers(element, "y")[..]) {
            assert!(inside(*x, *y), "{element:?}");
        }
    }
    let written: Vec<&str> = root.descendants().filter(|e| e.has_tag_name("text")).filter_map(|e| e.text()).map(str::trim).collect();
    for words in ["Everything", "A map", "A plot", "A graph", "x (m)", "forcing (m)", "words", "0.98"] {
        assert!(written.contains(&words), "{words} in {written:?}");
    }
    // A name that two panels use is in the legend once.
    for words in ["a <wave> & more", "obstacle", "dashes", "hit", "state", "chain 1"] {
        assert_eq!(written.iter().filter(|text| **text == words).count(), 1, "{words} in {written:?}");
    }
    let strokes = |color: &str| root.descendants().filter(|e| e.has_tag_name("polyline") && e.attribute("stroke") == Some(color)).count();
    assert_eq!(strokes("#0072B2"), 3, "the wave in both panels and in the legend");
    assert!(strokes("#D55E00") >= 6, "three crosses with two strokes");
}

#[test]
fn equal_figures_are_equal_text_and_nothing_to_draw_is_an_error() {
    assert_eq!(svg(&figure()).expect("drawn"), svg(&figure()).expect("drawn"));
    let mut empty = figure();
    empty.panels[1].marks = vec![Mark::line("", BLUE, 1.0, vec![[f64::NAN, 0.0]])];
    assert!(svg(&empty).expect_err("nothing to draw").to_string().contains("Everything"));
}

/// A unit is as long along x as along y in a map: the crosses are 1 m apart along x and half a metre along y.
#[test]
fn a_map_has_one_scale() {
    let mut figure = figure();
    figure.panels.truncate(1);
    figure.panels[0].marks = vec![Mark::line("", BLUE, 1.0, vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0]])];
    let text = svg(&figure).expect("drawn");
    let document = Document::parse(&text).expect("well-formed");
    let line = document.descendants().find(|e| e.has_tag_name("polyline") && e.attribute("stroke") == Some("#0072B2")).expect("the line");
    let p = numbers(line, "points");
    let (along_x, along_y) = ((p[2] - p[0]) / 3.0, p[3] - p[5]);
    assert!((along_x - along_y).abs() < 2.0, "{along_x} and {along_y} steps per metre");
}
