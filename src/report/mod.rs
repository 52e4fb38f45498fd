//! Text out: what a run is told to people and to other programs.
//!
//! [`RunReport`] is the only source: `report.json` is its serialised form, and the table on the terminal is drawn from it. [`RunFolder`] is
//! where a run leaves its files: written beside, then renamed, so that there is never half of one.

mod beside_section;
mod check_report;
mod check_text;
mod choice_section;
mod comparison;
mod compliance_report;
mod contact_report;
mod criterion_report;
mod data_section;
mod error_section;
mod github;
mod input_fault;
mod junit;
mod learn_report;
mod learn_text;
mod lock;
mod manifest;
mod outcome;
mod output_file;
mod planar;
mod recorded_report;
mod robot_section;
mod run_folder;
mod run_report;
mod run_section;
mod schemas;
mod sections;
mod skill_section;
mod summary;
mod table;
mod text;
mod verdict;
mod wrench_section;

pub use beside_section::BesideReport;
pub use check_report::{CheckReport, Checked};
pub use check_text::check_text;
pub use choice_section::{Candidate, ChoiceSection};
pub use comparison::{ComparisonReport, MethodSummary, MovementReport, SettingReport};
pub use compliance_report::{ComplianceReport, ComplianceState, HumanReport, Window};
pub use contact_report::{ClearanceReport, CollisionReport};
pub use criterion_report::{AnswerStatus, CriterionReport};
pub use data_section::{ColumnRow, DataSection, DemonstrationRow};
pub use error_section::{ErrorRow, ValidationRow, ValidationSection};
pub use github::github;
pub use input_fault::{FileCode, InputFault};
pub use junit::{junit, junit_without_verdict};
pub use learn_report::LearnReport;
pub use lock::{Lock, lock_beside};
pub use manifest::{FileHash, Host, MANIFEST_VERSION, Manifest, hash_bytes, hash_file, read_regular};
pub use outcome::Outcome;
pub use output_file::{Replaceable, followed, prepare_file, remove_file, replace_file, rewrite_file};
pub use recorded_report::{Change, RecordedReport};
pub use robot_section::{JointLine, RobotSection};
pub use run_folder::{OutputError, RunFolder, write_file};
pub use run_report::{LearningSection, ParameterReport, PhaseReport, RunReport};
pub use run_section::{CriterionLine, FileLine, RunSection};
pub use schemas::{check_schema, learn_schema, manifest_schema, report_schema, written_schema};
pub use skill_section::{FitSection, ParameterRange, SkillSection, StateRow};
pub use summary::summary;
pub use table::{figure, table};
pub use text::text;
pub use wrench_section::{WrenchErrorSize, WrenchRow, WrenchValidation};
