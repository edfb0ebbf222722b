//! Standard parameters whose columns are counted, in place of the base parameters'.

use nalgebra::DMatrix;
use robot_model::excite::Basis;
use robot_model_codegen::{Compiled, DesignColumn, DesignColumns};

use crate::Error;
use crate::output::counted;

/// Smallest singular value, relative to the largest, of a choice of parameters that are told apart.
const APART: f64 = 1e-9;

/// A regressor's columns are those of its base parameters: parameters by name, which are these times a matrix.
pub(super) fn basis(
    compiled: &Compiled,
    columns: &DesignColumns,
    names: &[String],
) -> Result<Basis, Error> {
    let count = columns.columns.len();
    if names.len() != count {
        return Err(Error::Argument(format!(
            "--columns names {}, the regressor has {}: give as many",
            counted(names.len(), "parameter"),
            counted(count, "column")
        )));
    }
    let mut chosen = Vec::new();
    for name in names {
        let place = compiled.standard.iter().position(|p| p.name == *name);
        chosen.push(place.ok_or_else(|| {
            Error::Argument(format!(
                "--columns: no standard parameter `{name}`; `robot-model show --what base-parameters` has their names"
            ))
        })?);
    }
    let matrix = DMatrix::from_fn(count, count, |row, column| {
        let DesignColumn::Parameter(base) = columns.columns[row] else {
            unreachable!(
                "`--columns` does not work with `--separate`, whose effects have columns of shapes"
            );
        };
        let mut combination = compiled.base.combinations[base].iter();
        let part = combination.find(|part| part.0 == chosen[column]);
        part.map_or(0.0, |part| part.1)
    });
    let singular = matrix.singular_values();
    if singular.min() <= APART * singular.max() {
        return Err(Error::Argument(
            "--columns: no motion separates these parameters; choose one from each base parameter's combination"
                .to_owned(),
        ));
    }
    Ok(Basis::new(names.to_vec(), |row, column| {
        matrix[(row, column)]
    }))
}
