//! One integration binary: the heavy crates are linked once.

mod architecture;
mod cli;
mod faults;
mod figure;
mod paper;
mod physics;
mod recording;
mod support;
