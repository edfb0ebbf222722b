//! All that is computed.

use super::audit::{self, Audits};
use super::contact::{self, Felt};
use super::control::{self, Square};
use super::device::{self, SPEC};
use super::equation_13::Left;
use super::equations::{self, Comparison, Off};
use super::fits::{self, Installation};
use super::shares::{self, Shares};
use super::sines::{ROOM, Sines};
use super::tracing::{self, Traces};
use super::truth::{COMMAND_GAIN, CONTROL_GAINS, SINES, WEIGHTS, piece_wise, table_1};
use super::weights::{self, Balance};
use crate::paper::{Audited, Error, both, in_threads};

/// One setting of section 4.3 with identified and with piece-wise parameters.
#[derive(Debug, Clone)]
pub struct Controlled {
    /// Installation, from 0.
    pub installation: usize,
    /// `K_P` and `K_D`.
    pub gains: [f64; 2],
    /// With identified and with piece-wise parameters.
    pub squares: [Square; 2],
}

/// The installation with the largest `pi4`, whose row of (13) has the wrong sign.
pub const COUPLED: usize = 1;

/// Everything.
#[derive(Debug, Clone)]
pub struct Results {
    /// The motion of section 3.1.
    pub motion: Sines,
    /// Equations (4) and (13), as printed and with the sign put right.
    pub equations: [Comparison; 2],
    /// Series of (13) that are off, with filters as printed and over all.
    pub filters: [Vec<Off>; 2],
    /// What identification leaves of [`COUPLED`] where (13) is its model.
    pub left_by_13: Left,
    /// Tables 1 and 2.
    pub installations: Vec<Installation>,
    /// Figures 5 and 7.
    pub traces: Traces,
    /// Table 1, audited.
    pub audits: Audits,
    /// Figures 10 and 11.
    pub shares: Vec<Shares>,
    /// Section 4.2 with the printed lever, and with that of the printed moment.
    pub balances: [Balance; 2],
    /// That lever, and the one of the second mass that is recommended, m.
    pub levers: [f64; 2],
    /// What `audit` says of the device that carries the recommended weights: with the printed lever, with the first of these.
    pub carried: [Audited; 2],
    /// Figures 14 to 16.
    pub controlled: Vec<Controlled>,
    /// Largest `K_P` of each installation with identified and with piece-wise parameters.
    pub largest_gains: Vec<[f64; 2]>,
    /// Section 4.4.
    pub felt: Felt,
    /// Difference of (21) from the spec's point, m^2.
    pub jacobian_off: f64,
    /// Largest relative difference of parameters from a log of commands that the spec scales.
    pub scaled_off: f64,
}

/// Computes it.
///
/// # Errors
/// Those of the libraries.
pub fn results() -> Result<Results, Error> {
    let motion = Sines::new(SINES, &ROOM, 4);
    let installations = fits::all(&motion)?;
    let known = |k: usize| device::values(&installations[k].estimate);
    let largest = |k: &usize| {
        both(
            || control::largest_gain(&table_1(*k), &known(*k)),
            || control::largest_gain(&table_1(*k), &piece_wise()),
        )
    };
    let settings: Vec<_> = [0, 0, 4].into_iter().zip(CONTROL_GAINS).collect();
    let controlled = |&(k, gains): &(usize, [f64; 2])| -> Result<Controlled, Error> {
        let square = |known| control::square(&table_1(k), known, gains);
        Ok(Controlled {
            installation: k,
            gains,
            squares: [square(&known(k))?, square(&piece_wise())?],
        })
    };
    let controlled = in_threads(&settings, controlled)?;
    let largest_gains = in_threads(&[0, 1, 2, 3, 4], largest)?.into_iter();
    let levers = weights::levers_of_print()?;
    Ok(Results {
        equations: [equations::compare(false), equations::compare(true)],
        filters: [
            equations::off_along(&motion, false)?,
            equations::off_along(&motion, true)?,
        ],
        left_by_13: Left::of(&installations[COUPLED])?,
        traces: tracing::all(&installations[0].halves.train, &motion)?,
        audits: audit::all()?,
        shares: (0..5)
            .map(|k| shares::shares(&table_1(k), &motion))
            .collect(),
        balances: [
            weights::balance(WEIGHTS.lever)?,
            weights::balance(levers[0])?,
        ],
        carried: [
            weights::carried(WEIGHTS.lever)?,
            weights::carried(levers[0])?,
        ],
        levers,
        controlled,
        largest_gains: largest_gains.map(<[f64; 2]>::from).collect(),
        felt: contact::felt(&known(2), &motion)?,
        jacobian_off: contact::jacobian_off(),
        scaled_off: scaled_off(&installations[0])?,
        installations,
        motion,
    })
}

impl Results {
    /// Largest `K_P pi6` of each installation, with the `pi6` that the controller knows, identified and piece-wise, N m/rad.
    #[must_use]
    pub fn largest_stiffness(&self) -> Vec<[f64; 2]> {
        let pairs = self.largest_gains.iter().zip(&self.installations);
        let of = |([ours, other], one): (&[f64; 2], &Installation)| {
            let known = [device::values(&one.estimate)[5], piece_wise()[5]];
            [ours * known[0], other * known[1]]
        };
        pairs.map(of).collect()
    }
}

/// A log of commands instead of torques, by a spec that has the gain.
fn scaled_off(installation: &Installation) -> Result<f64, Error> {
    let velocity = "velocity = 3.5 rad/s;";
    let gain = format!("{velocity} actuator_gain = {};", 1.0 / COMMAND_GAIN);
    let model = device::momentum(&SPEC.replace(velocity, &gain))?;
    let mut log = installation.halves.train.clone();
    for tau in log.tau.iter_mut().flatten() {
        *tau *= COMMAND_GAIN;
    }
    let scaled = device::values(&fits::fit(&model, &log)?);
    let own = device::values(&installation.estimate);
    let off = scaled.iter().zip(own).map(|(x, y)| ((x - y) / y).abs());
    Ok(off.fold(0.0, f64::max))
}
