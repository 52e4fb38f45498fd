//! The paper's experiments, on synthetic data and judged from the simulated world.

mod cabinet_door;
mod cabinet_scene;
mod dataset_damage;
mod dataset_import;
mod execution_modes;
mod learning_baseline;
mod learning_coupling;
mod learning_datasets;
mod learning_execution;
mod learning_hostile;
mod learning_laws;
mod learning_motion;
mod learning_noise;
mod learning_orientation;
mod learning_pick_and_place;
mod learning_selection;
mod learning_validation;
mod phmm_inference;
mod phmm_laws;
mod pick_and_place;
mod planar_obstacle_avoidance;
mod planar_two_sided;
mod push_object;
mod tpgmm;
