//! x
mod physics;
mod support;
