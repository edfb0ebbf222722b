//! Equation (15) by the check of dimensions: which column of `W2` is a sum of columns of `W1`, and which entry of `k` is a sum at all.
//!
//! A column of the regressor has the unit of a torque over that of its parameter. `R` has the units of its columns, `R^-1` those of the
//! parameters over a torque. Sums are written out as lines of a spec.

use nalgebra::DMatrix;
use robot_model_codegen::Compiled;

use crate::paper::refused;

/// Smaller entries of `k` are rounding.
const ROUNDING: f64 = 1e-9;

/// What the check of dimensions says of (15).
#[derive(Debug, Clone, PartialEq)]
pub struct Regrouping {
    /// Of an entry of `R2 R1^-1`, as printed, and of `R1^-1 R2`; nothing where it passes.
    pub order: [Option<String>; 2],
    /// Of `W2 = W1 k` with the `k` of normalized columns, as printed, and with lengths put back.
    pub lengths: [Sums; 2],
}

/// Columns of `W2` as sums of columns of `W1`.
#[derive(Debug, Clone, PartialEq)]
pub struct Sums {
    /// Columns that are sums of others; the rest is zero.
    pub columns: usize,
    /// What is said of those whose dimensions do not fit.
    pub refused: Vec<String>,
}

impl Regrouping {
    /// Asks, with the places of kept and dropped parameters, and `k` of normalized columns and of measured ones.
    #[must_use]
    pub fn of(
        compiled: &Compiled,
        [kept, dropped]: [&[usize]; 2],
        [of_unit, of_measured]: [&DMatrix<f64>; 2],
    ) -> Self {
        let units = |places: &[usize]| -> Vec<&str> {
            let names = places.iter().map(|&k| compiled.standard[k].name.as_str());
            names.map(unit).collect()
        };
        let (kept, dropped) = (units(kept), units(dropped));
        let printed = dropped.iter().zip(&kept);
        let printed = printed.map(|(dropped, kept)| format!("(load/{dropped})*({kept}/load)"));
        // A sum of as many terms: the language reads no longer ones than are good for a person.
        let repaired = dropped.iter();
        let repaired = repaired.map(|_| format!("({}/load)*(load/{})", kept[0], dropped[0]));
        let sums = |k: &DMatrix<f64>, is_plain: bool| {
            let columns = (0..dropped.len()).filter(|&j| k.column(j).amax() > ROUNDING);
            let said = columns.clone().filter_map(|j| {
                let terms = (0..kept.len()).filter(|&i| k[(i, j)].abs() > ROUNDING);
                let terms = terms.map(|i| {
                    let own = if is_plain {
                        String::new()
                    } else {
                        format!("*{}/{}", kept[i], dropped[j])
                    };
                    format!("({:e}{own})*(load/{})", k[(i, j)], kept[i])
                });
                check(std::iter::once(format!("load/{}", dropped[j])).chain(terms))
            });
            Sums {
                columns: columns.clone().count(),
                refused: said.collect(),
            }
        };
        Self {
            order: [check(printed), check(repaired)],
            lengths: [sums(of_unit, true), sums(of_measured, false)],
        }
    }
}

/// A constant with the unit of a parameter, by the end of its name.
fn unit(name: &str) -> &'static str {
    match name.rsplit('.').next().unwrap_or_default() {
        "m" => "mass",
        "mx" | "my" | "mz" => "moment",
        "fc1" | "fc2" => "load",
        "fv1" => "viscous",
        "fv3" => "cubic",
        // Inertias of links and of rotors, and friction with the square of the speed.
        _ => "inertia",
    }
}

/// What a spec says of a sum of these terms.
fn check(terms: impl Iterator<Item = String>) -> Option<String> {
    let sum = terms.collect::<Vec<String>>().join(" + ");
    let text = format!(
        "robot Regrouping {{
    coordinates th;
    parameters J: kg*m^2;
    constants mass = 1 kg, moment = 1 kg*m, inertia = 1 kg*m^2;
    constants load = 1 kg*m^2/s^2, viscous = 1 kg*m^2/s, cubic = 1 kg*m^2*s;
    let sum = {sum};
    kinetic = J/2*dot(th)^2;
    potential = 0;
}}
"
    );
    refused("regrouping.robot", &text)
}
