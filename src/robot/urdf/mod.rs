//! Reading robot descriptions (URDF): every fault found at once, each with its line, and nothing dropped without a word.

mod build;
mod collada;
mod elements;
mod finding;
mod inertial;
mod joint;
mod load;
mod mesh;
mod numbers;
mod outline;
mod shapes;
mod structure;
mod tree;
mod vocabulary;

pub use finding::{Finding, Severity, UrdfError};
pub use load::{Attachment, LoadOptions, Loaded, collision_mesh_files, load, parse};
