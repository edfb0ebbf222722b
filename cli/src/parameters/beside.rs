//! Standard parameters that stand in a file of `identify` beside base parameters.

use std::path::Path;

use robot_model_codegen::Compiled;
use robot_model_codegen::parameters::{file, standard};

use super::of_file;
use crate::{Error, json};

/// Rounding of the sums that make base parameters of standard ones.
const ROUNDING: f64 = 1e-6;

/// Standard parameters that a file of `identify` holds beside its base parameters.
pub(crate) enum Beside {
    Nothing,
    /// They make the same base parameters.
    Same(Vec<Option<f64>>),
    /// They are of another arm, or of another fit.
    Other,
}

/// What a file says of standard parameters, where its base parameters were taken.
pub(crate) fn beside(compiled: &Compiled, file: &Path, beta: &[f64]) -> Result<Beside, Error> {
    let given = file::beside(&json::read(file)?);
    let Some(given) = given.map_err(|error| of_file(file, error))? else {
        return Ok(Beside::Nothing);
    };
    let (mut missing, mut from_spec) = (Vec::new(), Vec::new());
    let found = match standard(compiled, &given, &mut missing, &mut from_spec) {
        Ok(found) if missing.is_empty() => found,
        _ => return Ok(Beside::Other),
    };
    let numbers: Vec<f64> = found.iter().map(|value| value.unwrap_or(0.0)).collect();
    let sums = compiled.base.beta(&numbers);
    let sizes = compiled.base.combinations.iter().map(|combination| {
        let terms = combination
            .iter()
            .map(|&(k, share)| (share * numbers[k]).abs());
        terms.sum::<f64>()
    });
    let is_same = sums
        .iter()
        .zip(beta)
        .zip(sizes)
        .all(|((sum, value), size)| (sum - value).abs() <= ROUNDING * size.max(value.abs()));
    Ok(if is_same {
        Beside::Same(found)
    } else {
        Beside::Other
    })
}
