//! Filters without phase, derivatives and rates: from a [`Log`](crate::log::Log) to a [`Motion`](crate::motion::Motion).
//!
//! Torque and regressor columns meet in least squares, so they must have seen the same filter: [`SharedFilter`] is that
//! filter, applied once to the torque and to every column after it is formed. What differs between them fakes effects.

mod derivative;
mod encoder;
mod error;
mod filter;
mod first_order;
mod noise;
mod prepare;
mod repeat;
pub mod resample;
mod shared;
mod spectrum;

pub use derivative::derivative;
pub use encoder::encoder_step;
use encoder::turn_speed;
pub use error::SignalError;
pub use filter::LowPass;
pub use first_order::FirstOrder;
pub use noise::acceleration_noise;
pub(crate) use noise::{MEDIAN_OF_NORMAL, position_noise, raw_acceleration_noise, white_noise};
pub(crate) use prepare::MOTION_ORDER;
pub use prepare::{Bands, Prepared, prepare, prepare_velocities};
pub(crate) use repeat::period;
pub use shared::SharedFilter;
pub(crate) use shared::border;
pub use spectrum::{SEGMENT_S, band_density};
