//! The paper's experiments, on synthetic data and judged from the simulated world.

mod dataset_damage;
mod dataset_import;
mod learning_datasets;
mod learning_execution;
mod learning_laws;
mod learning_pick_and_place;
mod learning_selection;
mod pick_and_place;
