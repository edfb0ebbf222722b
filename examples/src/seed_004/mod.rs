//! "Experimental Identification and Analysis of the Dynamics of a PHANTOM Premium 1.5A Haptic Device", Taati, Tahmasebi and
//! Hashtrudi-Zaad: a parallelogram with three joints in five installations.
//!
//! Every column of table 1 is a device here, simulated by equations that are written by hand (`plant.rs`), where such a device can
//! move at all. What is said of it is said by the compiler, the runtime and the audit.

mod applications;
pub mod audit;
pub mod contact;
pub mod control;
pub mod device;
pub mod equation_13;
pub mod equations;
mod figures;
pub mod fits;
pub mod plant;
pub mod results;
pub mod rig;
mod rows;
pub mod sensors;
pub mod shares;
pub mod sines;
mod tables;
pub mod tracing;
pub mod truth;
pub mod weights;

use crate::paper::{Error, Paper};

/// Reproduces the publication.
///
/// # Errors
/// Those of the libraries.
pub fn run() -> Result<Paper, Error> {
    paper(&results::results()?)
}

/// What the results say of the publication.
///
/// # Errors
/// Those of the libraries.
pub fn paper(results: &results::Results) -> Result<Paper, Error> {
    Ok(Paper {
        title: "Taati, Tahmasebi and Hashtrudi-Zaad: a PHANTOM haptic device, identified without accelerations"
            .to_owned(),
        tables: tables::tables(results),
        rows: rows::rows(results),
        figures: figures::figures(results)?,
    })
}
