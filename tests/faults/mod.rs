//! Everything that can be wrong with what the program is given. One test per fault, on the real binary.

mod coupling;
mod extends;
mod hostile_files;
mod learning_files;
mod scenario;
