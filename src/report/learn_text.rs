//! The report of `cpdmp learn` for people.

use super::error_section::{opening, turn};
use super::table::{figure, table};
use super::wrench_section::{ALL, rows_of};
use super::{ChoiceSection, ErrorRow, FitSection, LearnReport, WrenchValidation};

const BOLD: &str = "\u{1b}[1m";
const PLAIN: &str = "\u{1b}[0m";
const YELLOW: &str = "\u{1b}[33m";

impl LearnReport {
    /// The report as text with ANSI colours, which the terminal strips where they are not wanted.
    pub fn text(&self) -> String {
        let unit = self.error_unit();
        let mut lines = vec![heading(&format!("Read {}", self.dataset.display()))];
        lines.extend(self.data.lines());
        lines.extend([String::new(), heading("Learned")]);
        lines.push(format!("  prepared     {}", self.preparation.text()));
        lines.extend(self.skill.lines());
        for (name, fit) in [("motion fit", &self.motion_fit), ("force fit", &self.force_fit)] {
            lines.extend(fit.as_ref().map(|fit| fit_line(name, fit)));
        }
        lines.extend(self.choices.iter().map(ChoiceSection::line));
        if !self.alignment_shifts_s.is_empty() {
            let shifts: Vec<String> = self.alignment_shifts_s.iter().map(|shift| figure(*shift)).collect();
            lines.push(format!("  aligned      in time, by at most (s): {}", shifts.join(", ")));
        }
        lines.push(format!("  sensor noise {}", self.noise()));
        lines.extend([String::new(), heading(&format!("Reproduction: error in {unit}, at equal time fractions"))]);
        lines.extend(self.reproduction_table());
        if !self.wrench_reproduction.is_empty() {
            lines.extend([String::new(), heading("Reproduction of the wrench: error of what is expected, at equal time fractions")]);
            let rows = self.wrench_reproduction.iter().chain(&self.wrench_reproduction_overall);
            lines.extend(rows_of(vec!["demonstration".to_owned()], rows, |_| Vec::new()));
        }
        if let Some(validation) = &self.cross_validation {
            let wrench = validation.wrench.as_ref().map(WrenchValidation::lines);
            for mut section in std::iter::once(validation.lines(unit)).chain(wrench) {
                section[0] = heading(&section[0]);
                lines.push(String::new());
                lines.extend(section);
            }
        }
        if !self.warnings.is_empty() {
            lines.push(String::new());
            lines.extend(self.warnings.iter().map(|warning| format!("{YELLOW}warning:{PLAIN} {warning}")));
        }
        lines.join("\n") + "\n"
    }

    /// Distances are over the columns in m; without one over all columns.
    fn error_unit(&self) -> &'static str {
        if self.skill.columns.iter().any(|name| name.ends_with("_m")) { "m" } else { "the columns' unit" }
    }

    fn noise(&self) -> String {
        let each = self.skill.columns.iter().zip(&self.forcing_noise);
        let each: Vec<String> = each.map(|(name, std)| format!("{name} {}", figure(*std))).collect();
        format!("in the forcing term, standard deviation: {}", each.join(", "))
    }

    fn reproduction_table(&self) -> Vec<String> {
        let mut first: Vec<String> = ["demonstration", "rms", "max"].map(str::to_owned).to_vec();
        first.extend(self.skill.columns.iter().map(|name| format!("rms {name}")));
        let also = self.reproduction_overall.as_ref().map(|all| [("rms turn deg", turn(all)), ("rms gripper", opening(all))]);
        first.extend(also.into_iter().flatten().filter(|(_, has)| has.is_some()).map(|(name, _)| name.to_owned()));
        let rows = self.reproduction.iter().chain(&self.reproduction_overall).map(row);
        table(&std::iter::once(first).chain(rows).collect::<Vec<_>>())
    }
}

fn row(error: &ErrorRow) -> Vec<String> {
    let mut row = vec![error.demonstration.clone().unwrap_or_else(|| ALL.to_owned()), figure(error.rms), figure(error.max)];
    row.extend(error.rms_columns.iter().map(|rms| figure(*rms)));
    row.extend(turn(error).into_iter().chain(opening(error)));
    row
}

fn fit_line(name: &str, fit: &FitSection) -> String {
    let likelihood = fit.log_likelihood.last().map_or(String::new(), |value| format!(", log-likelihood {}", figure(*value)));
    let starts = match fit.starts {
        1 => "1 start".to_owned(),
        n => format!("best of {n} starts ({} reached it)", fit.starts_at_best),
    };
    let status = fit.status.replace('_', " ");
    format!("  {name:<12} {} states, {starts}, {} iterations, {status}{likelihood}", fit.states, fit.iterations)
}

fn heading(text: &str) -> String {
    format!("{BOLD}{text}{PLAIN}")
}
