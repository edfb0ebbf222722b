//! What ends a simulation.

use thiserror::Error;

/// Why a motion has no continuation. Joints count from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SimulateError {
    /// `d tau / d ddq` is singular: something moves that has no inertia.
    #[error(
        "at {time:.6} s the accelerations are undefined: the mass matrix is singular; give every moving joint an inertia, by its link or \
         `motor_inertia`"
    )]
    NoInertia {
        /// Time, s.
        time: f64,
    },
    /// A torque of the plant is no number.
    #[error(
        "at {time:.6} s the torque of joint {joint} is not a number: the spring deflection has no matching load, or an effect's formula has \
         no value there; check the parameters of its effects"
    )]
    NoTorque {
        /// Time, s.
        time: f64,
        /// The joint, from 1.
        joint: usize,
    },
    /// The load of a joint and what depends on it drive each other up.
    #[error(
        "at {time:.6} s the accelerations have no solution: the load and the friction or deflection that depends on it amplify each other, \
         or the motion diverges; reduce that friction or deflection, or the controller's gains"
    )]
    NoAcceleration {
        /// Time, s.
        time: f64,
    },
    /// A position, velocity or state is no number, or has grown beyond all bounds.
    #[error(
        "at {time:.6} s the motion of joint {joint} diverges; check the parameters, and the controller's gains and rate"
    )]
    Unbounded {
        /// Time, s.
        time: f64,
        /// The joint, from 1.
        joint: usize,
    },
    /// Neighboring motions part beyond all bounds.
    #[error(
        "at {time:.6} s the sensitivity of joint {joint} to parameters or start values diverges; check the parameters, or simulate a shorter time"
    )]
    Sensitive {
        /// Time, s.
        time: f64,
        /// The joint, from 1.
        joint: usize,
    },
    /// An internal state has grown beyond all bounds.
    #[error(
        "at {time:.6} s internal state {state} of the effects diverges; check the parameters of its effect"
    )]
    UnboundedState {
        /// Time, s.
        time: f64,
        /// The state, from 1.
        state: usize,
    },
    /// A number of the set-up is out of its range.
    #[error("{what} must be {range}, not {value}")]
    Setting {
        /// What it is.
        what: &'static str,
        /// What it may be.
        range: &'static str,
        /// What it is.
        value: f64,
    },
    /// Parts of a set-up have other sizes than the arm.
    #[error("{what} has {found} where the arm has {expected}")]
    Size {
        /// What it is.
        what: &'static str,
        /// How many it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
}

impl SimulateError {
    /// Of a time before the present one.
    pub(super) fn back_to(time: f64) -> Self {
        Self::Setting {
            what: "the time to advance to",
            range: "the present one or a later one",
            value: time,
        }
    }
}
