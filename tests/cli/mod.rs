//! The real binary, as a person or a CI job calls it.

mod commands;
mod generate;
mod inspect;
mod learn;
mod overrides;
mod program;
mod real_run;
mod run_folder;

pub use program::{Folder, GOOD, Said, cpdmp};
