//! A start from a fit that has a motor and its link in one sum, for a simulation in which springs part them.

use std::path::Path;

use robot_model_codegen::Compiled;

use crate::Error;
use crate::output::{self, names};
use crate::parameters;

/// Share of a sum that its motor has where the spec's links would leave it none: from there a search goes up and down.
const MOTOR: f64 = 0.2;

/// Where a value of the parted arm is from.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Origin {
    Spec,
    /// The spec's by a factor.
    Scaled,
    Fit,
    Unknown,
}

/// One parameter of the fit, and what it is of: places and factors of those of the parted arm.
struct Sum<'a> {
    name: &'a str,
    value: f64,
    parts: Vec<(usize, f64)>,
}

/// Values of the parted arm, as far as they are known.
struct Split {
    values: Vec<f64>,
    origins: Vec<Origin>,
    /// Which of them are never below zero.
    nonnegative: Vec<bool>,
}

/// One value a parameter, and one a shape.
pub(super) type ParametersAndShapes = (Vec<f64>, Vec<f64>);

/// Parameters of the arm whose motors and links move apart, and shapes, from a file of those of the `whole` arm: what is in a sum there is the
/// spec's own as far as that says it, and the sum's rest. Nothing where the file is no such fit.
pub(super) fn apart(
    whole: &Compiled,
    parted: &Compiled,
    file: &Path,
) -> Result<Option<ParametersAndShapes>, Error> {
    if whole.base.names == parted.base.names {
        return Ok(None);
    }
    let Ok((fit, _, source)) = parameters::values(whole, Some(file)) else {
        return Ok(None);
    };
    let mut split = Split::of_spec(parted)?;
    let sums = sums(whole, parted, &fit.beta).into_iter();
    let (alone, lumped): (Vec<_>, Vec<_>) = sums.partition(|sum| sum.parts.len() == 1);
    // What is told by itself is no unknown of a sum.
    for sum in &alone {
        split.take_rest(sum);
    }
    // A mass is in the sums of all links before it, so that all links have their weight before a rest is taken.
    for sum in &lumped {
        split.make_room(sum);
    }
    for sum in &lumped {
        split.take_rest(sum);
    }
    output::say(&format!(
        "note: {source}: {}",
        said(parted, &lumped, &split)
    ));
    Ok(Some((split.values, fit.shapes)))
}

fn sums<'a>(whole: &'a Compiled, parted: &Compiled, beta: &[f64]) -> Vec<Sum<'a>> {
    let fitted = whole.base.names.iter().zip(&whole.base.combinations);
    let sums = fitted.zip(beta).map(|((name, combination), value)| {
        let parts = combination.iter().filter_map(|(standard, factor)| {
            let place = parted.base.kept.iter().position(|kept| kept == standard)?;
            Some((place, *factor))
        });
        Sum {
            name,
            value: *value,
            parts: parts.collect(),
        }
    });
    sums.filter(|sum| !sum.parts.is_empty()).collect()
}

/// What of the sums is from where.
fn said(parted: &Compiled, lumped: &[Sum<'_>], split: &Split) -> String {
    let of = |origin: Origin| -> Vec<&str> {
        let parts = lumped.iter().flat_map(|sum| &sum.parts);
        let places = parts.map(|(place, _)| *place);
        let own = places.filter(|place| split.origins[*place] == origin);
        let mut names: Vec<&str> = own.map(|place| parted.base.names[place].as_str()).collect();
        names.sort_unstable();
        names.dedup();
        names
    };
    let sums: Vec<&str> = lumped.iter().map(|sum| sum.name).collect();
    let spec = match of(Origin::Spec).as_slice() {
        [] => String::new(),
        list => format!("from the spec's values of {}, and ", names(list)),
    };
    let scaled = match of(Origin::Scaled).as_slice() {
        [] => String::new(),
        list => format!(
            "from scaled-down spec values of {}, as the full ones would leave no motor inertia, and ",
            names(list)
        ),
    };
    format!(
        "springs separate parameters that are one sum there ({}); the search starts {spec}{scaled}from the remainder of each sum for {}",
        names(&sums),
        names(&of(Origin::Fit))
    )
}

impl Split {
    fn of_spec(parted: &Compiled) -> Result<Self, Error> {
        let known = parameters::known(parted, None, &[])?;
        let origin = |name: &String| {
            if known.missing.contains(name) {
                Origin::Unknown
            } else {
                Origin::Spec
            }
        };
        let kept = parted.base.kept.iter();
        let nonnegative = kept.map(|kept| parted.model.is_nonnegative(&parted.standard[*kept]));
        Ok(Self {
            origins: parted.base.names.iter().map(origin).collect(),
            nonnegative: nonnegative.collect(),
            values: known.beta,
        })
    }

    /// What parts of some origins make of a sum.
    fn taken(&self, sum: &Sum<'_>, of: &[Origin]) -> f64 {
        let own = sum.parts.iter();
        let own = own.filter(|(place, _)| of.contains(&self.origins[*place]));
        own.map(|(place, factor)| factor * self.values[*place])
            .sum()
    }

    /// Scales what the spec says where it would leave nothing to a value that is not known, and never below zero.
    fn make_room(&mut self, sum: &Sum<'_>) {
        let own = self.taken(sum, &[Origin::Spec, Origin::Scaled]);
        let left = sum.value - self.taken(sum, &[Origin::Fit]);
        let broken = sum.parts.iter().find(|(place, factor)| {
            let is_unknown = self.origins[*place] == Origin::Unknown;
            is_unknown && self.nonnegative[*place] && factor * (left - own) <= 0.0
        });
        let Some((_, factor)) = broken else { return };
        // Sums about another axis than the joint's may be below zero.
        let scale = (left - (MOTOR * left).abs().copysign(*factor)) / own;
        if !(scale > 0.0 && scale.is_finite()) {
            return;
        }
        for (place, _) in &sum.parts {
            if [Origin::Spec, Origin::Scaled].contains(&self.origins[*place]) {
                self.values[*place] *= scale;
                self.origins[*place] = Origin::Scaled;
            }
        }
    }

    /// Gives what is not known in a sum the least values with which it holds: `x_k = f_k rest / sum(f_j^2)`.
    fn take_rest(&mut self, sum: &Sum<'_>) {
        let of = |origins: &[Origin]| -> Vec<(usize, f64)> {
            let parts = sum.parts.iter().copied();
            let own = parts.filter(|(place, _)| origins.contains(&self.origins[*place]));
            own.collect()
        };
        let mut open = of(&[Origin::Unknown]);
        if open.is_empty() {
            // Where the spec says all of them, the sum still holds.
            open = of(&[Origin::Spec, Origin::Scaled]);
            open.truncate(1);
        }
        for (place, _) in &open {
            self.values[*place] = 0.0;
        }
        let all = [Origin::Spec, Origin::Scaled, Origin::Fit, Origin::Unknown];
        let rest = sum.value - self.taken(sum, &all);
        let norm: f64 = open.iter().map(|(_, factor)| factor * factor).sum();
        for (place, factor) in open {
            self.values[place] = factor * rest / norm;
            self.origins[place] = Origin::Fit;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(values: &[f64], unknown: &[usize]) -> Split {
        let origin = |place: usize| {
            if unknown.contains(&place) {
                Origin::Unknown
            } else {
                Origin::Spec
            }
        };
        Split {
            values: values.to_vec(),
            origins: (0..values.len()).map(origin).collect(),
            nonnegative: vec![true; values.len()],
        }
    }

    fn sum(value: f64, parts: &[(usize, f64)]) -> Sum<'static> {
        Sum {
            name: "sum",
            value,
            parts: parts.to_vec(),
        }
    }

    fn assert_near(found: &[f64], expected: &[f64]) {
        let mut pairs = found.iter().zip(expected);
        assert!(
            pairs.all(|(a, b)| (a - b).abs() < 1e-12),
            "{found:?}, not {expected:?}"
        );
    }

    #[test]
    fn a_motor_has_a_share_where_links_would_take_all() {
        // An inertia and a mass half a meter away, and a motor.
        let izzr = sum(1.5, &[(0, 1.0), (1, 0.25), (2, 1.0)]);
        let mut split = split(&[1.53, 2.0, 0.0], &[2]);
        split.make_room(&izzr);
        split.take_rest(&izzr);
        let scale = 1.2 / 2.03;
        assert_near(&split.values, &[1.53 * scale, 2.0 * scale, 0.3]);
        assert_eq!(split.origins, [Origin::Scaled, Origin::Scaled, Origin::Fit]);
    }

    #[test]
    fn a_motor_has_a_share_of_a_sum_below_zero() {
        let izzr = sum(-0.7, &[(0, 1.0), (1, -0.25), (2, 1.0)]);
        let mut split = split(&[0.18, 3.0, 0.0], &[2]);
        split.make_room(&izzr);
        split.take_rest(&izzr);
        let scale = 0.84 / 0.57;
        assert_near(&split.values, &[0.18 * scale, 3.0 * scale, 0.14]);
    }

    #[test]
    fn a_motor_has_the_rest_where_there_is_one() {
        let izzr = sum(2.5, &[(0, 1.0), (1, 0.25), (2, 1.0)]);
        let mut split = split(&[1.53, 2.0, 0.0], &[2]);
        split.make_room(&izzr);
        split.take_rest(&izzr);
        assert_near(&split.values, &[1.53, 2.0, 0.47]);
        assert_eq!(split.origins, [Origin::Spec, Origin::Spec, Origin::Fit]);
    }

    #[test]
    fn unknowns_of_a_sum_are_the_least_with_which_it_holds() {
        let mut split = split(&[1.0, 0.0, 0.0], &[1, 2]);
        split.take_rest(&sum(11.0, &[(0, 1.0), (1, 1.0), (2, 3.0)]));
        assert_near(&split.values, &[1.0, 1.0, 3.0]);
        // What is fitted already stays, and what the spec has gives way.
        split.take_rest(&sum(5.0, &[(1, 1.0), (0, 2.0)]));
        assert_near(&split.values, &[2.0, 1.0, 3.0]);
    }
}
