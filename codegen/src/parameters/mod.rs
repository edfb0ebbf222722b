//! Values of an arm by name, from a file and from its spec: what `--parameters` of the command line reads, and a build script.
//!
//! A file is a JSON object of names and values, or what `identify --json` writes: `{"parameters":[{"name","value"}]}`.
//! Names are those of standard parameters, of all base parameters, or of the unknown constants of a robot that says its energies.

pub mod file;
pub mod json;
mod physical;

use std::collections::BTreeMap;
use std::fmt;

use robot_model_spec::parameter::Status;
use robot_model_spec::suggest::nearest;
use robot_model_spec::words::{counted, names};

use crate::baked::Given;
use crate::base::shape_values;
use crate::compiled::Compiled;

pub use physical::no_body;

/// Values for everything in an arm that is not a number yet.
#[derive(Debug)]
#[non_exhaustive]
pub struct Values {
    /// Base parameters.
    pub beta: Vec<f64>,
    /// One per standard parameter, as [`Compiled::parameter_values`] gives them.
    pub parameters: Vec<f64>,
    /// One per shape parameter of the declared effects.
    pub shapes: Vec<f64>,
    /// Standard parameters, `None` each where no torque depends on it; none at all where the file gives base parameters.
    pub standard: Option<Vec<Option<f64>>>,
    /// What the file gives.
    pub given: Given,
    /// Parameters whose nominal value in the spec was taken, as the file gives none.
    pub from_spec: Vec<String>,
}

/// Values as far as they are known.
#[derive(Debug)]
#[non_exhaustive]
pub struct Known {
    /// Base parameters; what has no value counts as 0.
    pub beta: Vec<f64>,
    /// Shape parameters.
    pub shapes: Vec<f64>,
    /// Names of what has no value.
    pub missing: Vec<String>,
    /// Names of shapes that have their first value.
    pub guessed: Vec<String>,
}

/// Why values are not those of an arm.
#[derive(Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ValuesError {
    /// Parameters that neither the file nor the spec has a value for.
    NoValue(Vec<String>),
    /// Names that no parameter of the arm has, and what is said of them.
    Unknown {
        /// The names.
        names: Vec<String>,
        /// What is said of them, with the nearest that the arm has.
        reason: String,
    },
    /// Another reason, which names the parameter.
    Other(String),
}

/// The names without a value, all of them, as a file to be filled in.
impl fmt::Display for ValuesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoValue(missing) => {
                let short: Vec<&str> = missing.iter().map(String::as_str).collect();
                let entries = missing.iter().map(|name| format!("\"{name}\": .."));
                let entries: Vec<String> = entries.collect();
                write!(
                    f,
                    "no value for {}; give it in a file of parameters: {{{}}}",
                    names(&short),
                    entries.join(", ")
                )
            }
            Self::Unknown { reason, .. } | Self::Other(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for ValuesError {}

impl From<String> for ValuesError {
    fn from(reason: String) -> Self {
        Self::Other(reason)
    }
}

/// Values by name, and those of the spec where none is given, as far as there are some.
///
/// # Errors
/// Names that no parameter has, and values that contradict the spec.
pub fn known(compiled: &Compiled, given: &BTreeMap<String, f64>) -> Result<Known, ValuesError> {
    let base_names = &compiled.base.names;
    let shape_names = compiled.shape_names();
    let (mut missing, mut from_spec) = (Vec::new(), Vec::new());
    let mut guessed = Vec::new();
    let shapes = shapes(compiled, given, &mut guessed)?;
    let beta = if !base_names.is_empty() && base_names.iter().all(|name| given.contains_key(name)) {
        base_names.iter().map(|name| given[name]).collect()
    } else {
        let linear = given.keys().filter(|name| !shape_names.contains(name));
        let linear: Vec<&str> = linear.map(String::as_str).collect();
        check_names(compiled, &linear)?;
        let given = products(compiled, given, &mut from_spec)?;
        let standard = standard(compiled, &given, &mut missing, &mut from_spec)?;
        let standard: Vec<f64> = standard.iter().map(|value| value.unwrap_or(0.0)).collect();
        compiled.base.beta(&standard)
    };
    Ok(Known {
        beta,
        shapes,
        missing,
        guessed,
    })
}

/// Values by name, and those of the spec where none is given; with sentences about what no arm has among them.
///
/// # Errors
/// Parameters without a value, names that no parameter has, and values that contradict the spec or are none of an arm.
pub fn values(
    compiled: &Compiled,
    given: &BTreeMap<String, f64>,
) -> Result<(Values, Vec<String>), ValuesError> {
    let shape_names = compiled.shape_names();
    let base_names = &compiled.base.names;
    let linear: Vec<&str> = given
        .keys()
        .filter(|name| !shape_names.contains(name))
        .map(String::as_str)
        .collect();
    // Regrouped base parameters have names of their own; they stand for all standard parameters or for none.
    let is_base = !base_names.is_empty()
        && linear.len() == base_names.len()
        && base_names.iter().all(|name| given.contains_key(name));
    let (mut missing, mut from_spec) = (Vec::new(), Vec::new());
    let (beta, all, doubts) = if is_base {
        let beta: Vec<f64> = base_names.iter().map(|name| given[name]).collect();
        let doubts = physical::of_base(compiled, &beta);
        (beta, None, doubts)
    } else {
        check_names(compiled, &linear)?;
        let given = products(compiled, given, &mut from_spec)?;
        let standard = standard(compiled, &given, &mut missing, &mut from_spec)?;
        let doubts = physical::of_standard(compiled, &standard);
        let numbers: Vec<f64> = standard.iter().map(|value| value.unwrap_or(0.0)).collect();
        (compiled.base.beta(&numbers), Some(standard), doubts)
    };
    let shapes = shapes(compiled, given, &mut missing)?;
    if !missing.is_empty() {
        return Err(ValuesError::NoValue(missing));
    }
    let checked = compiled.check_numbers(&beta, &shapes);
    checked.map_err(|error| error.to_string())?;
    let values = Values {
        parameters: compiled.parameter_values(&beta),
        beta,
        shapes,
        standard: all,
        given: if is_base {
            Given::Base
        } else {
            Given::Standard
        },
        from_spec,
    };
    Ok((values, doubts))
}

/// Whether names are those of standard parameters or of what these are products of.
fn check_names(compiled: &Compiled, given: &[&str]) -> Result<(), ValuesError> {
    let robot = &compiled.model.name;
    let standard = compiled.standard.iter().map(|parameter| &parameter.name);
    let factors = compiled.model.energies().into_iter();
    let factors = factors.flat_map(|energies| energies.parameters.iter().map(|x| &x.name));
    let accepted: Vec<&str> = standard.chain(factors).map(String::as_str).collect();
    let base: Vec<&str> = compiled.base.names.iter().map(String::as_str).collect();
    let is_accepted = |name: &&str| accepted.contains(name);
    let is_base = |name: &&str| base.contains(name);

    let known = given.iter().copied();
    let unknown: Vec<&str> = known
        .filter(|name| !is_accepted(name) && !is_base(name))
        .collect();
    if !unknown.is_empty() {
        let shapes = compiled.shape_names();
        let all = accepted.iter().chain(&base).copied();
        let all = all.chain(shapes.iter().map(String::as_str));
        let few = unknown.iter().take_while(|_| unknown.len() <= 3);
        let near: Option<Vec<&str>> = few.map(|name| nearest(name, all.clone())).collect();
        let meant = match near.as_deref() {
            Some(near @ [_]) => format!("; is {} meant?", names(near)),
            Some(near @ [_, ..]) => format!("; are {} meant?", names(near)),
            // Most names of another arm are those of no parameter here.
            _ if 2 * unknown.len() > given.len() => {
                "; the file seems to be for another arm: name the spec that it was identified with"
                    .to_owned()
            }
            _ => {
                let mut all: Vec<&str> = all.collect();
                all.sort_unstable();
                all.dedup();
                format!("; it has {}", names(&all))
            }
        };
        return Err(ValuesError::Unknown {
            reason: format!("{robot} has no parameter {}{meant}", names(&unknown)),
            names: unknown.into_iter().map(str::to_owned).collect(),
        });
    }
    let mut regrouped = given.iter().filter(|name| !is_accepted(name)).peekable();
    if regrouped.peek().is_none() {
        return Ok(());
    }
    let regrouped: Vec<&str> = regrouped.copied().collect();
    let lacks: Vec<&str> = base
        .iter()
        .copied()
        .filter(|x| !given.contains(x))
        .collect();
    let besides: Vec<&str> = given.iter().copied().filter(|x| !is_base(x)).collect();
    let part = |what: &str, list: &[&str]| match list {
        [] => String::new(),
        list => format!(", {what} {}", names(list)),
    };
    let (are, ones) = match regrouped[..] {
        [_] => ("is a base parameter", "base parameters"),
        _ => ("are base parameters", "these"),
    };
    Err(format!(
        "{} {are}, and {ones} are accepted only as a whole set, with no others: {robot} has {}{}{}; give standard parameters by name, or a result \
         of `identify` for this spec",
        names(&regrouped),
        counted(base.len(), "base parameter"),
        part("the file lacks", &lacks),
        part("and also has", &besides),
    )
    .into())
}

/// A value for every shape parameter; `missing` takes the names of those without.
fn shapes(
    compiled: &Compiled,
    given: &BTreeMap<String, f64>,
    missing: &mut Vec<String>,
) -> Result<Vec<f64>, String> {
    let mut shapes = shape_values(&compiled.model);
    let free = compiled.free_shapes();
    for (k, name) in compiled.shape_names().into_iter().enumerate() {
        match given.get(&name) {
            Some(value) if free.contains(&k) => shapes[k] = *value,
            Some(value) if differ(*value, shapes[k]) => {
                return Err(format!(
                    "`{name}` is {value} here and {} in the spec",
                    shapes[k]
                ));
            }
            None if free.contains(&k) => missing.push(name),
            _ => {}
        }
    }
    Ok(shapes)
}

/// Values of standard parameters: those given, and the products of a robot's own parameters where it says its energies.
fn products(
    compiled: &Compiled,
    given: &BTreeMap<String, f64>,
    from_spec: &mut Vec<String>,
) -> Result<BTreeMap<String, f64>, String> {
    let mut values = given.clone();
    let Some(energies) = compiled.model.energies() else {
        return Ok(values);
    };
    let factor = |k: usize| {
        let parameter = &energies.parameters[k];
        given.get(&parameter.name).copied().or(parameter.nominal)
    };
    for monomial in &energies.monomials {
        let factors = monomial.factors.iter();
        let product: Option<f64> = factors
            .map(|&(k, exponent)| Some(factor(k)?.powi(exponent)))
            .product();
        let name = energies.monomial_name(monomial);
        match (product, given.get(&name)) {
            (Some(product), Some(value)) if differ(*value, product) => {
                return Err(format!(
                    "`{name}` is {value} here, but the values of its factors make {product}"
                ));
            }
            (Some(product), None) => {
                let factors = monomial.factors.iter();
                let factors = factors.map(|&(k, _)| &energies.parameters[k].name);
                from_spec.extend(factors.filter(|&name| !given.contains_key(name)).cloned());
                values.insert(name, product);
            }
            (Some(product), Some(_)) => {
                values.insert(name, product);
            }
            (None, _) => {}
        }
    }
    from_spec.sort_unstable();
    from_spec.dedup();
    Ok(values)
}

/// A value for every standard parameter that some torque depends on; `missing` takes the names of those without, `from_spec`
/// those of nominal values.
///
/// # Errors
/// A value that contradicts the spec.
pub fn standard(
    compiled: &Compiled,
    given: &BTreeMap<String, f64>,
    missing: &mut Vec<String>,
    from_spec: &mut Vec<String>,
) -> Result<Vec<Option<f64>>, String> {
    let mut values = Vec::with_capacity(compiled.standard.len());
    for (k, parameter) in compiled.standard.iter().enumerate() {
        let name = &parameter.name;
        let matters = !compiled.base.unidentifiable.contains(&k);
        values.push(match (given.get(name).copied(), parameter.status) {
            (Some(value), Status::Fixed(fixed)) if differ(value, fixed) => {
                return Err(format!(
                    "`{name}` is {value} here and fixed to {fixed} in the spec"
                ));
            }
            (Some(value), _) | (None, Status::Fixed(value)) => Some(value),
            (None, Status::Nominal(value)) => {
                if matters {
                    from_spec.push(name.clone());
                }
                Some(value)
            }
            (None, Status::Unknown) => {
                if matters {
                    missing.push(name.clone());
                }
                None
            }
        });
    }
    Ok(values)
}

/// More than rounding apart.
fn differ(left: f64, right: f64) -> bool {
    (left - right).abs() > 1e-12 * left.abs().max(right.abs())
}
