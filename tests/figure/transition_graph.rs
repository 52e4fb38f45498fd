//! Contract: a transition graph shows every state once, every edge, with its share where there are several,, and chains apart from each other.

use cpdmp::figure::{Figure, svg, transitions};
use cpdmp::learning::phmm::{StateChain, TransitionEdge, TransitionGraph, TransitionNode};
use roxmltree::Document;

/// Two kinds of movement with a common start (0), and a state (6) that nothing leads to.
fn two_sides() -> (TransitionGraph, Vec<StateChain>) {
    let node = |(state, phase): (usize, f64)| TransitionNode { state, phase, initial: 0.0, start: state == 0 };
    let phases = [0.05, 0.3, 0.31, 0.6, 0.62, 0.95, 0.5];
    let edge = |(from, to, probability)| TransitionEdge { from, to, probability };
    let edges = [(0, 1, 0.55), (0, 2, 0.45), (1, 3, 1.0), (2, 4, 0.93), (2, 3, 0.07), (3, 5, 1.0)];
    let graph = TransitionGraph { nodes: phases.into_iter().enumerate().map(node).collect(), edges: edges.map(edge).into() };
    let chain = |states: &[usize], weight| StateChain { states: states.to_vec(), weight };
    (graph, vec![chain(&[0, 1, 3, 5], 0.55), chain(&[0, 2, 4], 0.45)])
}

#[test]
fn states_edges_and_chains_are_all_there() {
    let (graph, chains) = two_sides();
    let panel = transitions("Transitions", &graph, &chains, 560.0);
    let text = svg(&Figure { title: "Fig. 4".into(), panels: vec![panel], columns: 1, panel_size_pt: [600.0, 320.0] }).expect("drawn");
    let document = Document::parse(&text).expect("well-formed");
    let texts = document.descendants().filter(|e| e.has_tag_name("text")).filter_map(|e| e.text()).map(str::trim);
    let mut written: Vec<&str> = texts.collect();
    for words in
        ["0*", "1", "2", "3", "4", "5", "6", "0.55", "0.45", "0.93", "0.07", "chain 1", "chain 2", "in no chain", "in several chains"]
    {
        assert!(written.contains(&words), "{words} in {written:?}");
    }
    let written_in_order = written.clone();
    written.retain(|text| text.contains('.') && text.parse::<f64>().is_ok());
    assert_eq!(written.len(), 4, "one number per arrow where there are several ways: {written:?}");
    let discs = |color: &str| document.descendants().filter(|e| e.has_tag_name("circle") && e.attribute("fill") == Some(color)).count();
    assert_eq!(discs("#E69F00"), 3 + 1, "states of the first chain alone, and the legend");
    assert_eq!(discs("#56B4E9"), 2 + 1, "those of the second");
    let entry = |words: &str| written_in_order.iter().position(|text| *text == words);
    assert!(entry("chain 1") < entry("chain 2"), "the legend counts chains in their order: {written_in_order:?}");
}

/// Discs do not cover each other, however near their states are in phase.
#[test]
fn no_two_states_are_drawn_on_each_other() {
    let (mut graph, chains) = two_sides();
    graph.nodes.iter_mut().for_each(|node| node.phase = 0.5 + 1e-9 * node.state as f64);
    let panel = transitions("Transitions", &graph, &chains, 560.0);
    let text = svg(&Figure { title: "Fig. 4".into(), panels: vec![panel], columns: 1, panel_size_pt: [600.0, 320.0] }).expect("drawn");
    let document = Document::parse(&text).expect("well-formed");
    let number = |e: roxmltree::Node<'_, '_>, name: &str| e.attribute(name).and_then(|text| text.parse::<f64>().ok()).unwrap_or(f64::NAN);
    let circles: Vec<_> = document.descendants().filter(|e| e.has_tag_name("circle") && number(*e, "r") > 100.0).collect();
    assert_eq!(circles.len(), 7);
    for (i, a) in circles.iter().enumerate() {
        for b in &circles[..i] {
            let apart = (number(*a, "cx") - number(*b, "cx")).hypot(number(*a, "cy") - number(*b, "cy"));
            assert!(apart >= number(*a, "r") + number(*b, "r"), "{apart}");
        }
    }
}
