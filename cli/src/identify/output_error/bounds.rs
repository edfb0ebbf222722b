//! Bounds: a share of all values, and those that a file gives: of parameters by themselves, or of the standard parameters and constants that base parameters are made of.

use std::collections::BTreeMap;
use std::path::Path;

use robot_model::identify::output_error::{other_ranges, ranges_within};
use robot_model_codegen::Compiled;
use robot_model_spec::model::Body;
use robot_model_spec::parameter::{Owner, Status};
use serde_json::Value;

use crate::{Error, json, output};

/// Least and largest value.
type Range = [f64; 2];

const OPEN: Range = [f64::NEG_INFINITY, f64::INFINITY];

/// What a file says, by name.
type Given = BTreeMap<String, Range>;

/// What a user says of ranges.
#[derive(Clone, Copy)]
pub(super) struct Said<'a> {
    /// Values that the search starts from.
    pub start: &'a [f64],
    /// Whether somebody has given them.
    pub is_given: bool,
    /// Percent about them.
    pub within: Option<f64>,
    /// Ranges by name, which come first.
    pub file: Option<&'a Path>,
}

/// Ranges of parameters: those of shapes, signs that effects declare, and what is said. `names` are base parameters, then open
/// shapes; where somebody has given a start below zero it is the least value.
pub(super) fn bounds(
    compiled: &Compiled,
    names: &[String],
    said: Said<'_>,
) -> Result<Vec<Range>, Error> {
    let limits = limits(compiled, said);
    let wanted = match said.within {
        Some(percent) => ranges_within(said.start, percent / 100.0),
        None => vec![OPEN; names.len()],
    };
    let both = |range: &Range, limits: &Range| [range[0].max(limits[0]), range[1].min(limits[1])];
    let mut bounds: Vec<Range> = wanted
        .iter()
        .zip(&limits)
        .map(|(x, y)| both(x, y))
        .collect();
    let Some(path) = said.file else {
        return Ok(bounds);
    };
    let given = read(path)?;
    let parts = Parts {
        compiled,
        given: &given,
    };
    // What the file alone bounds.
    let mut of_file = limits.clone();
    for (place, base) in compiled.base.combinations.iter().enumerate() {
        let sum = parts.sum(base);
        let [low, high] = both(&sum, &limits[place]);
        if low > high {
            let (name, [low, high]) = (&names[place], sum);
            return Err(Error::json(
                path,
                &format!("the bounds of `{name}` are {low} .. {high}, but it is never negative"),
            ));
        }
        of_file[place] = [low, high];
        if sum != OPEN {
            bounds[place] = [low, high];
        }
    }
    for (name, range) in &given {
        if let Some(place) = names.iter().position(|other| other == name) {
            bounds[place] = *range;
        } else if let Err(reason) = parts.check(name, names, &of_file) {
            return Err(Error::json(path, &reason));
        }
    }
    Ok(bounds)
}

/// Says so where a file has other ranges than what is said of all: about the start, and of what base parameters are made of about the
/// spec's own values.
pub(super) fn doubt(
    compiled: &Compiled,
    names: &[String],
    said: Said<'_>,
) -> Result<Option<String>, Error> {
    let (Some(percent), Some(path)) = (said.within, said.file) else {
        return Ok(None);
    };
    let value = |name: &str| match names.iter().position(|other| other == name) {
        Some(place) => Some(said.start[place]),
        None => nominal(compiled, name),
    };
    let given = read(path)?.into_iter();
    let given = given.filter_map(|(name, range)| Some((value(&name)?, name, range)));
    let given: Vec<(f64, String, Range)> = given.collect();
    let values: Vec<f64> = given.iter().map(|(value, ..)| *value).collect();
    let wanted = ranges_within(&values, percent / 100.0);
    let ranges: Vec<Range> = given.iter().map(|(.., range)| *range).collect();
    let others = other_ranges(&ranges, &wanted).into_iter();
    let others = others.map(|place| {
        let [low, high] = wanted[place].map(|end| output::significant(end, 3));
        let [own_low, own_high] = ranges[place];
        format!(
            "`{}` {own_low} .. {own_high} and not {low} .. {high}",
            given[place].1
        )
    });
    let others: Vec<String> = others.collect();
    Ok((!others.is_empty()).then(|| {
        format!(
            "{} sets other ranges than {percent} %: {}",
            path.display(),
            others.join(", ")
        )
    }))
}

/// The spec's own value of a constant of energies, or of a standard parameter.
fn nominal(compiled: &Compiled, name: &str) -> Option<f64> {
    let constants = compiled.model.energies().into_iter();
    let mut constants = constants.flat_map(|energies| &energies.parameters);
    let mut standard = compiled.standard.iter();
    let constant = constants.find(|constant| constant.name == name);
    let standard = standard.find(|parameter| parameter.name == name);
    constant
        .and_then(|constant| constant.nominal)
        .or_else(|| match standard?.status {
            Status::Nominal(value) => Some(value),
            _ => None,
        })
}

/// Ranges of shapes, and signs that effects declare.
fn limits(compiled: &Compiled, said: Said<'_>) -> Vec<Range> {
    let ranges = compiled.model.effects.iter().flat_map(|effect| {
        let shapes = effect.definition.shapes.iter();
        shapes.map(|shape| [shape.low, shape.high])
    });
    let ranges: Vec<Range> = ranges.collect();
    let signs = compiled.base.combinations.iter().enumerate();
    let signs = signs.map(|(place, base)| match base[..] {
        [(k, factor)] if factor > 0.0 && is_sign(compiled, k) => {
            let start = if said.is_given {
                said.start[place]
            } else {
                0.0
            };
            [start.min(0.0), f64::INFINITY]
        }
        _ => OPEN,
    });
    let shapes = compiled.free_shapes().into_iter().map(|k| ranges[k]);
    signs.chain(shapes).collect()
}

/// Whether an effect declares that a parameter is never below zero.
fn is_sign(compiled: &Compiled, parameter: usize) -> bool {
    let parameter = &compiled.standard[parameter];
    matches!(parameter.owner, Owner::Effect { .. }) && compiled.model.is_nonnegative(parameter)
}

fn read(path: &Path) -> Result<Given, Error> {
    let Value::Object(entries) = json::read(path)? else {
        return Err(Error::json(path, &"write `{\"NAME\": [LOW, HIGH], ..}`"));
    };
    let range = |(name, value): (String, Value)| {
        let pair = value.as_array().and_then(|pair| match pair.as_slice() {
            [low, high] => Some([low.as_f64()?, high.as_f64()?]),
            _ => None,
        });
        match pair {
            Some(range) if range[0] <= range[1] => Ok((name, range)),
            _ => Err(Error::json(
                path,
                &format!("`{name}`: write `[LOW, HIGH]`, two ascending numbers"),
            )),
        }
    };
    entries.into_iter().map(range).collect()
}

/// What base parameters are made of, with what is given of it.
struct Parts<'a> {
    compiled: &'a Compiled,
    given: &'a Given,
}

impl Parts<'_> {
    /// Least and largest value of a sum of standard parameters: none that they can make lies outside, though they may not make all inside.
    fn sum(&self, combination: &[(usize, f64)]) -> Range {
        let parts = combination.iter();
        let parts = parts.map(|&(k, factor)| product([factor, factor], self.standard(k)));
        parts.fold([0.0, 0.0], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
    }

    fn standard(&self, parameter: usize) -> Range {
        if let Some(range) = self.given.get(&self.compiled.standard[parameter].name) {
            return *range;
        }
        let factors = self.constants(parameter).into_iter();
        let powers = factors.map(|(name, exponent)| {
            let range = self.given.get(name).copied().unwrap_or(OPEN);
            power(range, exponent)
        });
        powers.reduce(product).unwrap_or(OPEN)
    }

    /// Constants of energies whose product a standard parameter is, with their exponents.
    fn constants(&self, parameter: usize) -> Vec<(&str, i32)> {
        match (
            &self.compiled.model.body,
            self.compiled.standard[parameter].owner,
        ) {
            (Body::Energies(energies), Owner::Monomial(k)) => {
                let factors = energies.monomials[k].factors.iter();
                let named = |&(k, exponent): &(usize, i32)| {
                    (energies.parameters[k].name.as_str(), exponent)
                };
                factors.map(named).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Names of all that a base parameter is made of.
    fn names(&self, base: usize) -> Vec<&str> {
        let combination = self.compiled.base.combinations[base].iter();
        let names = combination.flat_map(|&(k, _)| {
            let constants = self.constants(k);
            if constants.is_empty() {
                vec![self.compiled.standard[k].name.as_str()]
            } else {
                constants.into_iter().map(|(name, _)| name).collect()
            }
        });
        let mut names: Vec<&str> = names.collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Whether a name that is no parameter of the search bounds one.
    fn check(&self, name: &str, names: &[String], bounds: &[Range]) -> Result<(), String> {
        let bases = 0..self.compiled.base.combinations.len();
        let within: Vec<usize> = bases
            .clone()
            .filter(|&base| self.names(base).contains(&name))
            .collect();
        let is_bounded = |&base: &usize| bounds[base] != OPEN;
        match within.first() {
            None => {
                let own = bases.flat_map(|base| self.names(base));
                let mut known: Vec<&str> = names.iter().map(String::as_str).chain(own).collect();
                known.sort_unstable();
                known.dedup();
                Err(format!(
                    "no parameter is called `{name}`; there are {}",
                    output::names(&known)
                ))
            }
            Some(_) if within.iter().any(is_bounded) => Ok(()),
            Some(&base) => {
                let open = self.names(base).into_iter();
                let open: Vec<&str> = open
                    .filter(|part| !self.given.contains_key(*part))
                    .collect();
                Err(format!(
                    "`{name}` alone bounds nothing identifiable; `{}` also needs bounds of {}, or bounds of its own",
                    names[base],
                    output::names(&open)
                ))
            }
        }
    }
}

/// Of all products of a value of one and a value of the other.
fn product(one: Range, other: Range) -> Range {
    let all = [
        one[0] * other[0],
        one[0] * other[1],
        one[1] * other[0],
        one[1] * other[1],
    ];
    // Nothing times what may be anything is nothing.
    let all = all.map(|x| if x.is_nan() { 0.0 } else { x });
    [
        all.into_iter().fold(f64::INFINITY, f64::min),
        all.into_iter().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// Of all powers of its values.
fn power([low, high]: Range, exponent: i32) -> Range {
    if exponent < 0 {
        return if low <= 0.0 && 0.0 <= high {
            OPEN
        } else {
            power([1.0 / high, 1.0 / low], -exponent)
        };
    }
    let ends = [low.powi(exponent), high.powi(exponent)];
    let least = if exponent % 2 == 0 && low <= 0.0 && 0.0 <= high {
        0.0
    } else {
        ends[0].min(ends[1])
    };
    [least, ends[0].max(ends[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_range(found: Range, expected: Range) {
        // Ends are products of whole numbers, exact in binary.
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
    }

    #[test]
    fn powers_and_products_hold_what_their_values_make() {
        assert_range(power([-2.0, 3.0], 2), [0.0, 9.0]);
        assert_range(power([-3.0, -2.0], 2), [4.0, 9.0]);
        assert_range(power([-3.0, 2.0], 3), [-27.0, 8.0]);
        assert_range(power([2.0, 4.0], -1), [0.25, 0.5]);
        assert_range(power([-4.0, -2.0], -2), [0.0625, 0.25]);
        assert_range(power([-1.0, 1.0], -1), OPEN);
        assert_range(product([-2.0, 3.0], [-5.0, 4.0]), [-15.0, 12.0]);
        assert_range(product([0.0, 0.0], OPEN), [0.0, 0.0]);
        assert_range(product([1.0, 2.0], OPEN), OPEN);
    }
}
