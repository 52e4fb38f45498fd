//! The report of `check` as workflow commands: GitHub shows each at its line of the scenario.

use super::check_report::{CheckReport, Checked};
use super::{Outcome, verdict};

/// One annotation per line; the last one sums up.
#[must_use]
pub fn github(report: &CheckReport) -> String {
    let passed = report.checks.iter().filter(|check| check.outcome == Outcome::Passed).count();
    let mut lines: Vec<String> = report.checks.iter().flat_map(annotations).collect();
    let told = format!("{passed} of {} as expected, {:.1} s", report.checks.len(), report.wall_s);
    lines.push(command("notice", &[("title", "cpdmp check".to_owned())], &told));
    lines.join("\n") + "\n"
}

fn annotations(check: &Checked) -> Vec<String> {
    let mut lines = Vec::new();
    for fault in &check.faults {
        let kind = if fault.warning { "warning" } else { "error" };
        let place = fault.line.zip(fault.column);
        lines.push(command(kind, &properties(&fault.file, place, &fault.code), &fault.message));
    }
    for warning in check.run_warnings() {
        lines.push(command("warning", &properties(&check.path, None, "warning"), warning));
    }
    if let Some(error) = check.report.as_ref().and_then(|report| report.error.as_ref()) {
        lines.push(command("error", &properties(&check.path, None, check.outcome.name()), error));
    }
    for criterion in check.criteria().filter(|criterion| criterion.fails()) {
        let place = criterion.place.as_ref();
        let file = place.map_or(&check.path, |place| &place.file);
        let properties = properties(file, place.map(|place| (place.line, place.column)), &criterion.name);
        let contacts: String = check.refused_contacts().map(|contact| format!("\n{}", verdict::contact(contact))).collect();
        lines.push(command("error", &properties, &format!("{}: {}{contacts}", criterion.name, verdict::reason(criterion))));
    }
    lines
}

fn properties(file: &str, place: Option<(usize, usize)>, title: &str) -> Vec<(&'static str, String)> {
    let mut properties = vec![("file", file.to_owned())];
    if let Some((line, column)) = place {
        properties.extend([("line", line.to_string()), ("col", column.to_string())]);
    }
    properties.push(("title", title.to_owned()));
    properties
}

/// `::kind key=value,key=value::message`, escaped as the runner unescapes it.
fn command(kind: &str, properties: &[(&str, String)], message: &str) -> String {
    let pairs: Vec<String> = properties.iter().map(|(key, value)| format!("{key}={}", in_property(value))).collect();
    format!("::{kind} {}::{}", pairs.join(","), in_message(message))
}

fn in_message(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

fn in_property(text: &str) -> String {
    in_message(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contract: what the runner's own unescaping makes of a command is what was put in (actions/toolkit, `command.ts`).
    #[test]
    fn a_command_survives_the_runner() {
        let (file, message) = ("a,b:c%.toml", "50 %, first\r\nsecond: ::error::");
        let line = command("error", &properties(file, Some((3, 1)), "t"), message);
        assert_eq!(line.lines().count(), 1);
        let (head, told) = line.strip_prefix("::error ").and_then(|rest| rest.split_once("::")).expect("a command");
        let plain = |text: &str| {
            [("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ","), ("%25", "%")]
                .iter()
                .fold(text.to_owned(), |t, (a, b)| t.replace(a, b))
        };
        assert_eq!(plain(told), message);
        let pairs: Vec<(&str, String)> = head.split(',').filter_map(|pair| pair.split_once('=')).map(|(k, v)| (k, plain(v))).collect();
        assert_eq!(pairs, [("file", file.to_owned()), ("line", "3".to_owned()), ("col", "1".to_owned()), ("title", "t".to_owned())]);
    }
}
