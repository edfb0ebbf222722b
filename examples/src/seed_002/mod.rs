//! "A New Joint Friction Model for Parameter Identification and Sensor-less Hand guiding in Industrial Robots", Liu, Li, Fang, Han
//! and Zhang: a ROKAE arm with six joints.
//!
//! The arm is simulated (`plant.rs`, `experiment.rs`) with the friction of Table I and bodies of ours, as those of the table are none.
//! What is said of it is said by the compiler, the runtime and the audit.

pub mod arm;
mod arm_rows;
pub mod base;
mod base_rows;
pub mod excitation;
pub mod experiment;
mod figures;
pub mod guiding;
pub mod law;
pub mod plant;
pub mod regrouping;
pub mod results;
mod rows;
pub mod stacked;
pub mod streaming;
pub mod table_one;
pub mod table_two;
mod tables;
pub mod truth;

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
        title: "Liu, Li, Fang, Han and Zhang: a ROKAE arm, friction with square and cube, weighted least squares, hand guiding"
            .to_owned(),
        tables: tables::tables(results),
        rows: rows::rows(results),
        figures: figures::figures(results)?,
    })
}
