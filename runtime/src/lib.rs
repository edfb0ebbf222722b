//! Identification, residual tracing and control with the dynamics code that the robot-model compiler writes.
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "std")]
pub mod calibrate;
#[cfg(feature = "std")]
pub mod columns;
pub mod control;
#[cfg(feature = "std")]
pub mod excite;
#[cfg(feature = "std")]
pub mod friction_curve;
#[cfg(feature = "std")]
pub mod identify;
pub mod link;
#[cfg(feature = "std")]
pub mod log;
mod math;
pub mod mechanics;
pub mod memory;
pub mod model;
#[cfg(feature = "std")]
pub mod motion;
pub mod scalar;
#[cfg(feature = "std")]
pub mod signal;
#[cfg(feature = "std")]
pub mod simulate;
pub mod solve;
pub mod state;
#[cfg(feature = "std")]
mod threads;
#[cfg(feature = "std")]
pub mod trace;

pub use link::{Inertial, Link};
pub use mechanics::{Kinematics, Mechanics, Points};
pub use memory::Memory;
pub use model::{FromParameters, Matrix, RobotModel, Vector};
pub use scalar::Scalar;
pub use state::State;

#[cfg(feature = "derive")]
pub use robot_model_derive::{RobotModel, effects};

/// Parameters of the standard effects: one type each, for the fields of a struct that derives [`RobotModel`].
///
/// Linear parameters and shape parameters are fields; [`Default`] is no force at all, with shapes in the middle of their
/// ranges.
#[cfg(feature = "derive")]
pub mod effects {
    robot_model_derive::standard_effects!();
}

/// Includes what `robot_model_codegen::compile` wrote for a spec in the build script: `include_robot!("arm")` for
/// `arm.robot`.
#[macro_export]
macro_rules! include_robot {
    ($name:literal) => {
        include!(concat!(env!("OUT_DIR"), "/", $name, ".rs"));
    };
}
