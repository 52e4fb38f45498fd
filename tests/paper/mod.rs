//! The paper's experiments, on synthetic data and judged from the simulated world.

mod learning_coupling;
mod learning_datasets;
mod learning_execution;
mod learning_laws;
mod learning_motion;
mod learning_orientation;
mod learning_pick_and_place;
mod pick_and_place;
