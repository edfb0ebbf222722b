//! One joint with friction of bristles: the dynamic model of a manipulator with one degree of freedom, with the friction that its
//! authors identify, and what their equations and numbers come to.
//!
//! The link moves by an integrator of its own ([`plant`]) on a rig with the paper's sensors ([`rig`]); what is identified and audited is
//! by the libraries ([`tool`], [`audit`]).

pub mod audit;
pub mod encoder;
pub mod experiments;
pub mod phenomena;
pub mod plant;
pub mod refine;
pub mod results;
pub mod rig;
pub mod rows;
mod shown;
pub mod tool;
pub mod truth;

use crate::paper::{Error, Paper};

/// Reproduces the paper.
///
/// # Errors
/// Those of the libraries; none is expected.
pub fn run() -> Result<Paper, Error> {
    paper(&results::results()?)
}

/// Results as tables, rows and figures.
///
/// # Errors
/// Those of the libraries; none is expected.
pub fn paper(results: &results::Results) -> Result<Paper, Error> {
    Ok(Paper {
        title: "Dynamic model of a robotic manipulator with one degree of freedom with friction component (LuGre)".to_owned(),
        tables: shown::tables(results),
        rows: rows::rows(results),
        figures: shown::figures(results)?,
    })
}

/// A count from what is one but for rounding.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of samples are small, and not negative"
)]
pub(crate) fn nearest(count: f64) -> usize {
    count.round() as usize
}
