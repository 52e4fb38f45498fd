//! The real binary, as a person or a CI job calls it.

mod all_at_once;
mod beside;
mod changed_run;
mod check;
mod check_motion;
mod check_run;
mod check_samples;
mod commands;
mod examples;
mod generate;
mod global_flags;
mod inspect;
mod killed;
mod learn;
mod learn_errors;
mod located;
mod migrate;
mod overrides;
mod pipes;
mod planar_run;
mod program;
mod real_run;
mod refusals;
mod replay;
mod run_folder;
mod schemas;
mod sweep;
mod sweep_faults;
mod teach;
mod trust;
mod view;

pub use program::{Folder, GOOD, Said, cpdmp};
