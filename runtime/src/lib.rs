//! Identification, residual tracing and control with the dynamics code that the robot-model compiler writes.
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "std")]
pub mod columns;
#[cfg(feature = "std")]
pub mod identify;
#[cfg(feature = "std")]
pub mod log;
#[cfg(feature = "std")]
pub mod motion;
#[cfg(feature = "std")]
pub mod signal;
#[cfg(feature = "std")]
pub mod trace;
