//! Scenario files: the only room that knows TOML as a language.
//!
//! A file goes through three stages. `layer` and `overrides` read text into a tree whose values know where they were typed, one layer on the
//! other. `conform` holds the tree against the table of keys in `schema`: types, ranges, unknown keys, defaults. `checks` looks at
//! what no single key can tell. Only then is it turned into the settings of the rooms below. Every stage goes on after a fault, so that one
//! pass tells them all.

mod beside;
mod build;
mod build_criteria;
mod build_learning;
mod build_planar;
mod build_scene;
mod changes;
mod check_coupling;
mod check_doors;
mod check_grasp;
mod check_learning;
mod check_names;
mod check_overrides;
mod check_planar;
mod check_taught;
mod check_times;
mod checks;
mod conform;
mod diagnostic;
mod fault;
mod json_schema;
mod key;
mod layer;
mod learning_file;
mod load;
mod measure;
mod migrate;
mod overrides;
mod parse;
mod places;
mod plain_value;
mod render;
mod resolved;
mod roots;
mod schema;
mod schema_criteria;
mod schema_learning;
mod schema_planar;
mod schema_scene;
mod schema_sweep;
mod source;
mod suggest;
mod sweep;
mod sweep_axis;
mod sweep_checks;
mod sweep_flags;
mod sweep_member;
mod tree;
mod view;
mod walk;
mod words;
mod work;

pub use changes::changed_keys;
pub use diagnostic::{Diagnostic, InvalidScenario, diagnose_some};
pub use fault::{Code, Severity};
pub use json_schema::{learning_schema, scenario_schema};
pub use learning_file::{LearningOptions, learning_settings};
pub use load::{LoadOptions, RecordingPlan, Scenario};
pub use migrate::Migration;
pub use overrides::spelled;
pub use places::Places;
pub use render::render;
pub use suggest::did_you_mean;
pub use sweep::{Sweep, SweepOptions};
pub use sweep_member::{InvalidMember, Member, Setting};
pub use work::{PlanarPlan, PlanarRun, Work};
