//! Control laws on the typed face: hard real time, `no_std`, no allocation, no panic.
//!
//! In: an arm with its parameters, the [`State`](crate::State) that was measured and the one that is desired, once a cycle. Out:
//! a [`Command`], which always has a finite torque within the limits of [`Safety`] and says in its [`Status`] whether the law or
//! the safe torque is in it. A reading that is no number, a state outside of the limits, a model without a finite torque: each
//! holds the arm, and the law is back in the cycle in which they are gone. Mistakes that are known before the first cycle are
//! errors of the constructors.
//!
//! | | torque |
//! |---|---|
//! | [`ComputedTorque`] | inverse dynamics of `ddq_d + kd (dq_d - dq) + kp (q_d - q)`, friction in part |
//! | [`GravityCompensation`] | what holds the arm still |
//! | [`HandGuiding`] | `{C dq + G + tau_f} - K_d dq` |
//! | [`FeedForward`] | inverse dynamics of the desired motion, stiffness and damping beside |
//! | [`Adaptive`] | Slotine and Li's: parameters that change until the motion is followed |
//!
//! [`MomentumObserver`] and [`ContactForce`] tell what acts on the arm from outside, [`counterbalance`] which weights spare
//! gravity torque, [`Dissection`] of what a torque is made.
//!
//! A measured state's `q` and `dq`, and where effects read them `memory`, `inputs`, `time` and `measured_torque`, are read. An
//! arm whose effects remember renews `memory` with [`Memory::memory_after`](crate::Memory::memory_after) once a cycle.
//!
//! # Examples
#![cfg_attr(feature = "derive", doc = "```")]
#![cfg_attr(not(feature = "derive"), doc = "```ignore")]
//! # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
//! use robot_model::control::{ComputedTorque, ControlError, Gains, Safety, Status};
//! use robot_model::{State, Vector};
//!
//! let limits = Safety::new().torque([60.0, 25.0]).velocity([3.0, 4.0]);
//! let mut control = ComputedTorque::new(arms::two_link(), Gains::critically_damped(25.0))?.with_safety(limits)?;
//! let desired = State::at_rest(Vector::from([0.3, -0.8]));
//! let mut measured = State::at_rest(Vector::from([0.29, -0.8]));
//!
//! let command = control.torque(&measured, &desired);
//! assert_eq!(command.status, Status::Normal);
//! // An encoder fails: the arm is held where it was last seen.
//! measured.q[1] = f64::NAN;
//! let command = control.torque(&measured, &desired);
//! assert!(matches!(command.status, Status::Held(_)) && command.torque.iter().all(|tau| tau.is_finite()));
//! # Ok::<(), ControlError>(())
//! ```

mod adaptive;
mod command;
mod computed_torque;
mod contact;
pub mod counterbalance;
mod directions;
mod dissect;
mod error;
mod feed_forward;
mod friction;
mod gains;
mod gravity;
mod guard;
mod hand_guiding;
mod observer;
mod reference;
mod safety;

pub use adaptive::{Adaptation, Adaptive};
pub use command::{Command, Reason, Signal, Status};
pub use computed_torque::ComputedTorque;
pub use contact::{Contact, ContactForce};
pub use dissect::{Dissection, Share};
pub use error::ControlError;
pub use feed_forward::FeedForward;
pub use friction::{Friction, FrictionVelocity};
pub use gains::Gains;
pub use gravity::GravityCompensation;
pub use hand_guiding::HandGuiding;
pub use observer::{ExternalTorque, MomentumObserver};
pub use reference::{Reference, ReferenceRegressor};
pub use safety::Safety;
