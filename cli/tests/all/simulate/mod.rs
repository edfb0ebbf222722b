//! Simulation: against what can be worked out by hand.

mod common;
mod conservation;
mod coupled;
mod differences;
mod dry;
mod everything;
mod led;
mod lugre;
mod placed;
mod sensitivity;
mod soft;
mod touched;
mod twin;
mod ungrouped;
