//! The shoulder of a PUMA, identified by output error: "Parameter identification for a robotic manipulator arm", a report on a
//! UNIMATE PUMA 600 of NASA's Langley Research Center.
//!
//! The arm and its motor are simulated with the last line of the paper's Table 2; then the paper's procedure runs on what was measured of
//! them, with the tool's search, simulator and calibration.

mod data;
mod drive;
mod figures;
mod fits;
mod law;
mod misprint;
mod motion;
mod plant;
mod replay;
mod rows;
mod scale;
mod sensitivity;
mod slopes;
mod truth;
mod turns;
mod words;

pub use data::Data;
pub use drive::{GAIN, Static, calibrated, noise_gain, white_gain};
pub use fits::{Fit, Tables, cost};
pub use law::{LAWS, Law};
pub use misprint::{Beside, Pair, mended, pairs, start};
pub use plant::Experiment;
pub use replay::Own;
pub use scale::{FACTORS, Told, costs_by_factor, told};
pub use sensitivity::{Change, carried, changes, nearby};
pub use slopes::{slope_errors, upright_rate};
pub use truth::{ARM, BACK_EMF, FIGURE_7, TABLE_1, TABLE_2};
pub use turns::{Turns, turns};

use crate::paper::{Error, Paper};

/// Seeds of the noise.
const EXPERIMENT: u64 = 1;
const GAUGE: u64 = 3;
const STANDING: u64 = 4;

/// Those of logs on which figures 7 and 8 are drawn again.
const OTHERS: std::ops::Range<u64> = 100..111;

/// All that came out.
#[derive(Debug, Clone)]
pub struct Findings {
    /// The simulated experiment.
    pub experiment: Experiment,
    /// What the paper makes of its measurements.
    pub data: Data,
    /// Tables 1 and 2.
    pub tables: Tables,
    /// Figures 7 to 10, then 7 and 8 on a noisy log with the printed parameters and with the arm's own.
    pub changes: [Change; 8],
    /// Other changes of figure 8, rad/s, and how far they carry, rad.
    pub nearby: Vec<[f64; 2]>,
    /// Distances of the last two of `changes` on logs of other noise, rad, from the least on.
    pub carried: [Vec<f64>; 2],
    /// Motions through turn-arounds.
    pub turns: [Turns; 2],
    /// Errors of exact slopes.
    pub slope_errors: [f64; 5],
    /// Rates at which the upright falls, models (5.1) and (5.2), 1/s.
    pub rates: [f64; 2],
    /// The static experiment.
    pub statics: Static,
    /// What differences make of noise, 1/s.
    pub noise_gain: f64,
    /// Numbers of Table 1 that are off, and their table.
    pub misprints: (crate::paper::Table, Vec<Pair>),
    /// The start of Table 1 beside what output error tells of ratios, as printed and with the number put right.
    pub start_told: [Vec<Beside>; 2],
    /// What model (5.2) tells of its parameters.
    pub told: Vec<Told>,
    /// Costs of a wrong law by the factor of measured velocities in the input.
    pub by_factor: Vec<(f64, f64)>,
}

impl Findings {
    /// Simulates and identifies.
    ///
    /// # Errors
    /// None are expected; those of the libraries are passed on.
    pub fn new() -> Result<Self, Error> {
        let experiment = Experiment::run(EXPERIMENT);
        let data = Data::new(&experiment)?;
        let misprints = misprint::table()?;
        let tables = Tables::of(&data)?;
        let told = told(&data, &tables.second[2])?;
        // The number that is off, where there is one.
        let repaired = misprints.1.first().map_or_else(start, mended);
        let held = &told[0].found;
        Ok(Self {
            start_told: [
                misprint::beside(start(), held)?,
                misprint::beside(repaired, held)?,
            ],
            tables,
            changes: changes(&experiment, &data)?,
            nearby: nearby(&data)?,
            carried: carried(OTHERS)?,
            turns: turns(&experiment)?,
            slope_errors: slope_errors(&data)?,
            // Figures of friction that the constants of Table 2 come to, without and with the back-EMF.
            rates: [upright_rate(12.0, 2.59)?, upright_rate(12.0, 35.0)?],
            statics: calibrated(GAUGE)?,
            noise_gain: noise_gain(STANDING),
            misprints,
            told,
            by_factor: costs_by_factor(&data)?,
            data,
            experiment,
        })
    }

    /// Beside the paper.
    ///
    /// # Errors
    /// Mistakes of the spec.
    pub fn paper(&self) -> Result<Paper, Error> {
        let mut tables = self.tables.beside();
        tables.extend([
            figures::table(&self.changes),
            figures::nearby(&self.nearby),
            self.misprints.0.clone(),
            scale::table(&self.told),
            figures::by_factor(&self.by_factor),
        ]);
        Ok(Paper {
            title:
                "Parameter identification for a robotic manipulator arm: the shoulder of a PUMA 600"
                    .to_owned(),
            tables,
            rows: rows::rows(self)?,
            figures: figures::figures(self),
        })
    }
}

/// The paper beside what came out.
///
/// # Errors
/// As [`Findings::new`].
pub fn run() -> Result<Paper, Error> {
    Findings::new()?.paper()
}
