//! Text out: what a run is told to people and to other programs.
//!
//! [`RunReport`] is the only source: `report.json` is its serialised form, and the table on the terminal is drawn from it. [`RunFolder`] is
//! where a run leaves its files: written beside, then renamed, so that there is never half of one.

mod comparison;
mod figures;
mod lock;
mod manifest;
mod outcome;
mod planar;
mod run_folder;
mod run_report;
mod sections;
mod text;

pub use comparison::{ComparisonReport, MethodSummary, MovementReport, SettingReport};
pub use manifest::{FileHash, Host, Manifest, hash_file};
pub use outcome::Outcome;
pub use run_folder::{OutputError, RunFolder, write_file};
pub use run_report::{
    ClearanceReport, CollisionReport, ComplianceReport, ComplianceState, CriterionReport, HumanReport, LearningSection, PhaseReport,
    RunReport, Window,
};
pub use text::text;
