//! Trojanova, Cakurda, Hosovsky, Krenicky: Estimation of Grey-Box Dynamic Model of 2-DOF Pneumatic Actuator Robotic Arm Using Gravity Tests.
//!
//! Two links hang down, are let go from some height, and swing until dry friction stops them. Eleven parameters are estimated from that with
//! a trust region. Here the arm of the paper's Table 6 is let go, twenty times from each height, and the library looks for its parameters:
//! from where the paper starts, within its bounds.

pub mod audit;
pub mod equations;
pub mod figures;
mod findings;
pub mod model;
pub mod plant;
pub mod releases;
pub mod rows;
pub mod search;
pub mod symbols;
pub mod tables;
pub mod truth;
pub mod validation;

use robot_model::simulate::Functions as _;

use crate::paper::{Error, Paper};
use audit::Told;
use model::Model;
use rows::Results;
use truth::{CAD, ESTIMATED};

/// All that the paper is measured by.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn results() -> Result<Results, Error> {
    let model = Model::dry()?;
    let arm = model.arm(&CAD)?;
    let found = search::all(&arm)?;
    Ok(Results {
        differences: equations::differences()?,
        validations: validation::all(&arm, &found)?,
        told: Told::new(&model, &arm, &found)?,
        rests: audit::rests(&arm)?,
        found,
        model,
        arm,
    })
}

/// The paper, reproduced.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn run() -> Result<Paper, Error> {
    paper(&results()?)
}

/// Results as the paper would print them.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn paper(results: &Results) -> Result<Paper, Error> {
    let (found, told) = (&results.found, &results.told);
    let base = [CAD, ESTIMATED].map(|arm| results.model.constants.own(&arm.values()));
    Ok(Paper {
        title: "Seed 001: a pneumatic arm of two joints, identified from gravity releases"
            .to_owned(),
        tables: vec![
            tables::starts(found),
            tables::errors(&results.validations, 0),
            tables::errors(&results.validations, 1),
            tables::parameters(found, told),
            tables::silent(told),
            tables::ratios(told, &base),
            tables::bounds(),
            tables::rests(&results.rests),
        ],
        rows: results.rows()?,
        figures: figures::all(found, &results.validations),
    })
}
