//! One integration binary: the heavy crates are linked once.

mod paper;
mod physics;
mod support;
