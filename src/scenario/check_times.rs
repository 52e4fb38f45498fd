//! Times that rise: way-points and pushes.

use super::checks::list;
use super::fault::{Code, Fault};
use super::measure::plain;
use super::tree::Node;

/// Way-points begin at 0, rise, and end with the demonstration.
pub(super) fn waypoints(teaching: &Node, faults: &mut Vec<Fault>) {
    let items = list(teaching, "waypoint");
    if let (true, Some(node)) = (items.len() < 2, teaching.get("waypoint")) {
        faults.push(Fault::at(Code::WrongLength, node.origin, format!("{} way-points are no way", items.len())).expected("at least two"));
    }
    let times: Vec<(f64, &Node)> =
        items.iter().filter_map(|item| item.get("time_s")).filter_map(|node| Some((node.as_number()?, node))).collect();
    if let Some((time, node)) = times.first().filter(|(time, _)| *time != 0.0) {
        let fault = Fault::at(Code::Order, node.origin, format!("the first way-point is at {} s", plain(*time)));
        faults.push(fault.expected("0 s: it is where the demonstration begins"));
    }
    for pair in times.windows(2).filter(|pair| pair[1].0 <= pair[0].0) {
        let message = format!("this way-point is at {} s, not after the one before it", plain(pair[1].0));
        faults.push(Fault::at(Code::Order, pair[1].1.origin, message).expected(format!("a time after {} s", plain(pair[0].0))));
    }
    let duration = teaching.get("duration_s").and_then(Node::as_number).unwrap_or(f64::INFINITY);
    for (time, node) in times.iter().filter(|(time, _)| *time > duration) {
        let message = format!("this way-point is at {} s, after the demonstration's end", plain(*time));
        faults.push(Fault::at(Code::Order, node.origin, message).expected(format!("a time up to {} s", plain(duration))));
    }
}

/// A force is averaged over logged steps: a window shorter than one would silently be longer.
pub(super) fn windows_of_means(scenario: &Node, faults: &mut Vec<Fault>) {
    let Some(rate_hz) = scenario.get("simulation").and_then(|simulation| simulation.get("log_rate_hz")).and_then(Node::as_number) else {
        return;
    };
    for node in list(scenario, "criterion").iter().filter_map(|criterion| criterion.get("mean_over_s")) {
        if let Some(window_s) = node.as_number().filter(|window_s| *window_s > 0.0 && window_s * rate_hz < 1.0 - 1e-9) {
            let message = format!("{} s are shorter than a logged step (`simulation.log_rate_hz` is {})", plain(window_s), plain(rate_hz));
            let expected = format!("{} s or longer, or 0 for every step of the engine", plain(1.0 / rate_hz));
            faults.push(Fault::at(Code::OutOfRange, node.origin, message).expected(expected));
        }
    }
}

/// Pushes follow each other.
pub(super) fn pushes(scenario: &Node, faults: &mut Vec<Fault>) {
    let windows =
        scenario.get("human").and_then(|human| human.get("help")).and_then(|help| help.get("windows_s")).map_or(&[][..], Node::items);
    let mut end_before = f64::NEG_INFINITY;
    for window in windows {
        let [start, end] = window.as_numbers()[..] else { continue };
        if end <= start || start < end_before {
            let message = format!("the push from {} s to {} s does not follow the one before it", plain(start), plain(end));
            faults.push(Fault::at(Code::Order, window.origin, message).expected("start before end, each push after the one before it"));
        }
        end_before = end;
    }
}
