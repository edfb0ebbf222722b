//! What a good model is worth in a control loop: a simulated PUMA 560 with friction, under the controllers of the runtime.
//!
//! The arm is a compiled spec with numbers, moved by the simulator: encoders of 16 bits, velocities from their differences, a
//! torque that acts a millisecond late, noise in the log. The controllers know one of three things: what was identified from a
//! log of that arm, CAD values of which each base parameter is off by 15 %, or nothing.
//!
//! `cargo test -p robot-model-tests control_shows -- --nocapture` prints the tables of `docs/control.md`.

mod contact;
mod guiding;
mod knowledge;
mod puma;
mod tracking;
