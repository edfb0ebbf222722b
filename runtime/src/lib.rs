//! Identification, residual tracing and control with the dynamics code that the robot-model compiler writes.
//!
//! Controllers use [`RobotModel`] and [`control`], without `std` where there is none. With `std`, [`log`] reads measured logs, [`identify`] finds
//! parameters in them, [`trace`] names what the model lacks, [`excite`] designs motions, and [`simulate`] moves arms.
//!
//! # Examples
//! From a log to parameters, and to what they leave. The arm is a pendulum whose model has inertia, gravity and viscous friction; the machine
//! has dry friction of 0.7 N m, too. Its columns are written by hand, as [`columns::Columns`] shows; of a spec the command line has them.
#![cfg_attr(feature = "std", doc = "```")]
#![cfg_attr(not(feature = "std"), doc = "```ignore")]
//! # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
//! # use pendulum::{dry_friction, measure, pendulum};
//! use robot_model::identify::Identify;
//! use robot_model::log::Log;
//! use robot_model::trace::{Outcome, Trace};
//!
//! // Torque is `izz ddq + mx sin(q) + fv dq`; `izz`, `mx` and `fv` are not known.
//! let arm = pendulum();
//! // `Log::read` has it from a CSV, Parquet or MCAP file.
//! let log: Log = measure(0.7);
//!
//! let fit = Identify::default().fit(&arm, std::slice::from_ref(&log))?;
//! println!("{fit}"); // a table: value and deviation of each parameter, error of each joint
//! assert!((fit.values()[0] - 2.0).abs() < 0.1); // kg m^2
//!
//! // What was left, is it noise? Candidates are laws that the model does not have.
//! let friction = dry_friction();
//! let verdict = Trace::new(vec![&friction]).run(&arm, &[log], &mut |stage| eprintln!("{stage}"))?;
//! assert_eq!(verdict.outcome, Outcome::Explained);
//! let found = &verdict.findings[0];
//! assert_eq!(found.kind, "coulomb-friction");
//! assert!((found.parameters[0].value - 0.7).abs() < 0.02); // N m
//! # Ok::<(), robot_model::identify::IdentifyError>(())
//! ```
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
