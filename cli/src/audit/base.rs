//! Base parameters of another source, a paper or another program: whether they are base parameters of this arm.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use robot_model_codegen::Compiled;

use super::{Check, Finding, Quantity};
use crate::Error;
use crate::output::{counted, names, rounded};

/// Sums of standard parameters by name, each with the factors of its parts.
pub type Sums = BTreeMap<String, BTreeMap<String, f64>>;

/// How a file has to say them.
pub(super) const FORM: &str = "write `{\"NAME\": {\"STANDARD PARAMETER\": FACTOR, ..}, ..}`";

/// Share by which factors may be off: what rounding to three digits leaves.
const DIGITS: f64 = 5e-3;

/// Factors below this share of the largest one of their sum are rounding.
const ROUNDING: f64 = 1e-9;

/// A factor that is another than the rest of its sum makes it.
struct Off {
    parameter: usize,
    given: f64,
    needed: f64,
}

/// Whether sums are base parameters: each is told by torques, none by the others, and there are as many as the arm has.
///
/// With `Y * standard = Y_b * map * standard` torques tell a sum `b * standard` where its row `b` is made of rows of `map`. What is kept
/// has columns in `map` that are independent, so `b[kept] * map[kept]^-1 * map` is the only candidate: the factors of regrouped
/// parameters follow from those of the kept ones, and of parameters that no torque depends on they are zero.
pub(super) fn check(compiled: &Compiled, sums: &Sums) -> Result<Check, Error> {
    let base = &compiled.base;
    let rows = sums.iter().map(|(name, parts)| row(compiled, name, parts));
    let rows: Vec<DVector<f64>> = rows.collect::<Result<_, _>>()?;
    let mut map = DMatrix::zeros(base.kept.len(), compiled.standard.len());
    for (place, combination) in base.combinations.iter().enumerate() {
        for &(parameter, factor) in combination {
            map[(place, parameter)] = factor;
        }
    }
    let of_kept = map.select_columns(&base.kept).transpose().lu();
    let mut shares = DMatrix::zeros(rows.len(), base.kept.len());
    let mut findings = Vec::new();
    for (place, ((name, _), row)) in sums.iter().zip(&rows).enumerate() {
        let share = of_kept.solve(&row.select_rows(&base.kept));
        let share = share.expect("columns of kept parameters are independent");
        shares.row_mut(place).copy_from(&share.transpose());
        let off = off(row, &share, &map);
        if !off.is_empty() {
            findings.push(other_factors(compiled, name, &off));
        }
    }
    let independent = rank(shares.clone());
    findings.extend(too_few_or_many(compiled, &shares, independent));
    let scope = format!(
        "{} of standard parameters, compared with the {} of the equations",
        counted(sums.len(), "sum"),
        counted(base.kept.len(), "base parameter")
    );
    let mut check = Check::new("base", scope, findings);
    check.quantities.extend([
        Quantity::of_all("independent", independent as f64, ""),
        Quantity::of_all("base_parameters", base.kept.len() as f64, ""),
    ]);
    Ok(check)
}

/// Factors of a sum, one a standard parameter.
fn row(
    compiled: &Compiled,
    name: &str,
    parts: &BTreeMap<String, f64>,
) -> Result<DVector<f64>, Error> {
    let mut row = DVector::zeros(compiled.standard.len());
    for (part, factor) in parts {
        let mut standard = compiled.standard.iter();
        let place = standard.position(|parameter| parameter.name == *part);
        let place = place.ok_or_else(|| {
            let robot = &compiled.model.name;
            Error::Argument(format!(
                "`{name}`: {robot} has no standard parameter `{part}`"
            ))
        })?;
        if !factor.is_finite() {
            return Err(Error::Argument(format!(
                "`{name}`: the factor of `{part}` is {factor}"
            )));
        }
        row[place] = *factor;
    }
    Ok(row)
}

/// Factors that are others than `share * map` has.
fn off(row: &DVector<f64>, share: &DVector<f64>, map: &DMatrix<f64>) -> Vec<Off> {
    let largest = row.amax();
    let all = row.iter().zip(map.column_iter()).enumerate();
    let off = all.filter_map(|(parameter, (&given, column))| {
        let parts = share.component_mul(&column);
        let needed = parts.sum();
        // Parts may cancel: what they are rounded by stays.
        let size = parts.iter().map(|part| part.abs()).sum::<f64>();
        let room = (DIGITS * size.max(given.abs())).max(ROUNDING * largest);
        ((given - needed).abs() > room).then_some(Off {
            parameter,
            given,
            needed,
        })
    });
    off.collect()
}

fn other_factors(compiled: &Compiled, name: &str, off: &[Off]) -> Finding {
    let called = |off: &Off| compiled.standard[off.parameter].name.as_str();
    let said = off.iter().map(|off| {
        let [given, needed] = [off.given, off.needed].map(rounded);
        format!("{needed} `{}` (it has {given})", called(off))
    });
    let said: Vec<String> = said.collect();
    let sentence = format!(
        "torques do not determine `{name}`: its other parts need {}",
        said.join(", ")
    );
    let numbers = off.iter().flat_map(|off| {
        let of = format!("{name}: {}", called(off));
        [("factor", off.given), ("needed", off.needed)]
            .map(|(what, value)| Quantity::of(what, &of, value, ""))
    });
    (sentence, numbers.collect())
}

/// Says so where sums are not as many independent ones as the arm has base parameters.
fn too_few_or_many(
    compiled: &Compiled,
    shares: &DMatrix<f64>,
    independent: usize,
) -> Option<Finding> {
    let base = &compiled.base;
    let sentence = if independent < base.kept.len() {
        let is_lacking = |place: &usize| shares.column(*place).iter().all(|share| *share == 0.0);
        let lacking = (0..base.kept.len()).filter(is_lacking);
        let lacking: Vec<&str> = lacking.map(|place| base.names[place].as_str()).collect();
        let none = match lacking[..] {
            [] => String::new(),
            _ => format!(": none contains {}", names(&lacking)),
        };
        format!(
            "{independent} of the sums are independent, but torques determine {}{none}",
            counted(base.kept.len(), "base parameter")
        )
    } else if independent < shares.nrows() {
        format!(
            "only {independent} of the {} sums are independent: the others are combinations of these",
            shares.nrows()
        )
    } else {
        return None;
    };
    Some((sentence, Vec::new()))
}

/// Of rows and columns in any units.
fn rank(mut matrix: DMatrix<f64>) -> usize {
    if matrix.is_empty() {
        return 0;
    }
    for mut row in matrix.row_iter_mut() {
        let length = row.amax();
        if length > 0.0 {
            row /= length;
        }
    }
    for mut column in matrix.column_iter_mut() {
        let length = column.norm();
        if length > 0.0 {
            column /= length;
        }
    }
    let singular = matrix.singular_values();
    let least = ROUNDING * singular.max();
    singular.iter().filter(|value| **value > least).count()
}
