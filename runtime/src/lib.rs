//! Identification, residual tracing and control with the dynamics code that the robot-model compiler writes.
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "std")]
pub mod columns;
#[cfg(feature = "std")]
pub mod identify;
#[cfg(feature = "std")]
pub mod log;
pub mod math;
pub mod model;
#[cfg(feature = "std")]
pub mod motion;
#[cfg(feature = "std")]
pub mod signal;
#[cfg(feature = "std")]
pub mod trace;

pub use model::{Matrix, RobotModel, State, Vector};

#[cfg(feature = "derive")]
pub use robot_model_derive::RobotModel;

/// Includes what `robot_model_codegen::compile` wrote for a spec in the build script: `include_robot!("arm")` for
/// `arm.robot`.
#[macro_export]
macro_rules! include_robot {
    ($name:literal) => {
        include!(concat!(env!("OUT_DIR"), "/", $name, ".rs"));
    };
}
