//! Sections 3.1 and 3.2: five installations, identified through `Y_L` with friction and without it.

use robot_model::columns::MomentumArm;
use robot_model::identify::{AtTurns, Beyond, Estimate, Identify};
use robot_model::log::Log;

use super::device::{self, SPEC};
use super::plant::{Plant, Three};
use super::rig::{self, Gains};
use super::sensors::Record;
use super::sines::Sines;
use super::truth::{CORNER, Pi, table_1};
use crate::paper::{Error, in_threads};

/// No channel of a simulated log is late.
fn on_time() -> Identify {
    Identify {
        beyond: Beyond::Deviations,
        ..Identify::default()
    }
}

/// Gains of the rig. Softer ones leave joints standing longer at their turns, where the `sgn` of (6) is no torque.
pub const STIFF: Gains = Gains::all(40.0, 0.4);

/// Seconds that are dropped, identified with, validated on.
pub const SECONDS: [f64; 3] = [4.0, 40.0, 40.0];

/// One record in two halves.
#[derive(Debug, Clone)]
pub struct Halves {
    /// For the fit.
    pub train: Log,
    /// For the errors.
    pub validate: Log,
}

impl Halves {
    pub(super) fn of(record: &Record) -> Result<Self, Error> {
        let [dropped, train, validate] = SECONDS;
        Ok(Self {
            train: record.log("train", dropped, dropped + train)?,
            validate: record.log("validate", dropped + train, dropped + train + validate)?,
        })
    }
}

/// What one installation came to.
#[derive(Debug, Clone)]
pub struct Installation {
    /// Its parameters.
    pub truth: Pi,
    /// The device in the loop of the rig.
    pub halves: Halves,
    /// Identified from it, with friction; rows at turns, where friction holds joints, are left out.
    pub estimate: Estimate,
    /// The same with all rows.
    pub with_turns: Estimate,
    /// RMS% of (15) on the other half, with friction.
    pub rms: Three,
    /// A model without friction, identified from the same half with all rows.
    pub without_friction: Estimate,
    /// RMS% of a model without friction, identified from the same half.
    pub rms_without_friction: Three,
}

/// Of all five.
///
/// # Errors
/// Those of the plant and of identification.
pub fn all(motion: &Sines) -> Result<Vec<Installation>, Error> {
    let model = device::momentum(SPEC)?;
    let bare = device::momentum(&device::without_friction())?;
    let seconds = SECONDS.iter().sum();
    in_threads(&[0, 1, 2, 3, 4], |&k: &usize| {
        let truth = table_1(k);
        let seed = 50 + k as u64;
        let plant = Plant::new(truth, motion.at(0.0)[0]);
        let halves = Halves::of(&rig::run(plant, motion, &STIFF, seconds, seed)?)?;
        let estimate = fit(&model, &halves.train)?;
        let without = fit_with_turns(&bare, &halves.train)?;
        Ok(Installation {
            truth,
            rms: rms(&estimate, &model, &halves.validate)?,
            rms_without_friction: rms(&without, &bare, &halves.validate)?,
            with_turns: fit_with_turns(&model, &halves.train)?,
            halves,
            estimate,
            without_friction: without,
        })
    })
}

/// Through `Y_L`, without rows at turns: what holds a joint that stands is not what (6) says.
///
/// # Errors
/// Those of identification.
pub fn fit(model: &dyn MomentumArm, log: &Log) -> Result<Estimate, Error> {
    let identify = Identify {
        at_turns: AtTurns::LeftOut,
        ..on_time()
    };
    Ok(identify.fit_filtered(model, std::slice::from_ref(log), Some(CORNER))?)
}

/// Through `Y_L`, of all rows.
///
/// # Errors
/// Those of identification.
pub fn fit_with_turns(model: &dyn MomentumArm, log: &Log) -> Result<Estimate, Error> {
    Ok(on_time().fit_filtered(model, std::slice::from_ref(log), Some(CORNER))?)
}

/// RMS% of (15) of each joint.
///
/// # Errors
/// Those of the filters.
pub fn rms(estimate: &Estimate, model: &dyn MomentumArm, log: &Log) -> Result<Three, Error> {
    let errors = estimate.filtered_errors(model, log)?;
    Ok(std::array::from_fn(|j| errors.relative_percent[j]))
}

impl Installation {
    /// Errors of some parameters of an estimate, in percent of the parameter, the largest.
    #[must_use]
    pub fn off(&self, estimate: &Estimate, which: std::ops::Range<usize>) -> f64 {
        let found = device::values(estimate);
        which
            .map(|k| 100.0 * ((found[k] - self.truth[k]) / self.truth[k]).abs())
            .fold(0.0, f64::max)
    }

    /// The largest error of some parameters in deviations that the fit gives itself.
    #[must_use]
    pub fn deviations_off(&self, estimate: &Estimate, which: std::ops::Range<usize>) -> f64 {
        let (found, std) = (device::values(estimate), device::deviations(estimate));
        which
            .map(|k| ((found[k] - self.truth[k]) / std[k]).abs())
            .fold(0.0, f64::max)
    }
}
