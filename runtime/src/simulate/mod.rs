//! Motion of an arm under torques or a controller, and the log that it leaves.
//!
//! In: a [`Plant`], equations of motion with sizes known at run time. Out: its motion ([`Integrator`]), or the log of a sampled
//! loop with sensors as real ones are ([`Loop`]).
//!
//! Dry friction is no steep curve here: a joint stands, moves, or stops at an instant that is found, and which joints stand is
//! the solution of a complementarity problem. Stiff effects, as bristles are, take linearly implicit steps with exact slopes.

mod adjustable;
mod complementarity;
mod controller;
mod error;
mod explicit;
mod implicit;
mod integrate;
mod looped;
mod motion;
mod noise;
mod plant;
mod tangent;
mod through;
mod trajectory;

pub use adjustable::{Adjustable, ParameterSlopes};
pub use controller::{ComputedTorque, Controller, Gains, InverseDynamics, Measured, Pd, Torques};
pub use error::SimulateError;
pub use integrate::{Integrator, Tolerances, Work};
pub use looped::{Loop, Record};
pub use motion::Drive;
pub use noise::Sensors;
pub use plant::{Instant, Jumps, Plant, Slopes};
pub use tangent::Tangent;
pub use through::{Functions, Through};
pub use trajectory::{Desired, Trajectory};
