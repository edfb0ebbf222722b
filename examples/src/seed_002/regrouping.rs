//! Equation (15), regrouping: which base parameters each matrix `k` makes, and what the audit says of these.

use robot_model_cli::audit::{self, Check, Sums};
use robot_model_codegen::Compiled;

use nalgebra::DMatrix;

use crate::paper::Error;

/// What the audit says of base parameters `kept + k dropped`.
#[derive(Debug, Clone, PartialEq)]
pub struct Regrouping {
    /// With `k = R2^T R1^-1`, the one product in the printed order that exists, transposed to be put in, and with the lengths of
    /// columns.
    pub printed: Check,
    /// With `k = R1^-1 R2` of normalized columns.
    pub of_unit: Check,
    /// With the same and the lengths of columns.
    pub of_measured: Check,
}

impl Regrouping {
    /// Asks, with the places of kept and dropped parameters, and these three matrices, rows of kept parameters.
    ///
    /// # Errors
    /// None are expected: names are those of the arm.
    pub fn of(
        compiled: &Compiled,
        [kept, dropped]: [&[usize]; 2],
        [printed, of_unit, of_measured]: [&DMatrix<f64>; 3],
    ) -> Result<Self, Error> {
        let name = |place: usize| compiled.standard[place].name.clone();
        let check = |k: &DMatrix<f64>| -> Result<Check, Error> {
            let sum = |(row, &kept): (usize, &usize)| {
                let own = [(name(kept), 1.0)].into_iter();
                let others = dropped.iter().enumerate();
                let others = others.map(|(column, &dropped)| (name(dropped), k[(row, column)]));
                (name(kept), own.chain(others).collect())
            };
            let sums: Sums = kept.iter().enumerate().map(sum).collect();
            Ok(audit::base(compiled, &sums)?)
        };
        Ok(Self {
            printed: check(printed)?,
            of_unit: check(of_unit)?,
            of_measured: check(of_measured)?,
        })
    }
}
