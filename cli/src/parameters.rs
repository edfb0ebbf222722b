//! Parameter files and the values that a spec holds itself.
//!
//! A file is a JSON object of names and values, or what `identify --json` writes: `{"parameters":[{"name","value"}]}`.
//! Names are those of standard parameters, of all base parameters, or of the unknown constants of a robot that says its energies.

use std::collections::BTreeMap;
use std::path::Path;

use robot_model_codegen::Compiled;
use robot_model_codegen::base::shape_values;
use robot_model_spec::model::ShapeParameter;
use robot_model_spec::parameter::Status;
use robot_model_spec::suggest::nearest;
use serde::Deserialize;

use crate::Error;
use crate::spec::read_text;

/// Values for everything in an arm that is not a number yet.
#[derive(Debug)]
pub(crate) struct Values {
    /// One per standard parameter, as [`Compiled::parameter_values`] gives them.
    pub parameters: Vec<f64>,
    /// One per shape parameter of the declared effects.
    pub shapes: Vec<f64>,
}

/// The two forms of a parameter file.
#[derive(Deserialize)]
#[serde(untagged)]
enum File {
    Identified {
        parameters: Vec<Parameter>,
        #[serde(default)]
        unexcited: Vec<String>,
    },
    Plain(BTreeMap<String, Option<f64>>),
}

#[derive(Deserialize)]
struct Parameter {
    name: String,
    /// None where an identification could not tell it from others.
    value: Option<f64>,
}

/// Reads a parameter file.
fn read(path: &Path) -> Result<BTreeMap<String, f64>, Error> {
    let text = read_text(path)?;
    // The two forms are tried on a value that is known to be JSON, so that a slip of the pen is told with its line.
    let json: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| Error::json(path, &error))?;
    let file = File::deserialize(json).map_err(|_| {
        Error::json(path, &"write `{\"NAME\": VALUE, ..}` or `{\"parameters\": [{\"name\": .., \"value\": ..}, ..]}`")
    })?;
    let (given, unexcited) = match file {
        File::Plain(values) => (values, Vec::new()),
        File::Identified {
            parameters,
            unexcited,
        } => {
            let mut values = BTreeMap::new();
            for Parameter { name, value } in parameters {
                if values.insert(name.clone(), value).is_some() {
                    return Err(Error::json(
                        path,
                        &format!("parameter `{name}` stands there twice"),
                    ));
                }
            }
            (values, unexcited)
        }
    };
    measured(path, &given, &unexcited)
}

/// All values, where every one of them was measured: a zero in place of one that was not is wrong on every other motion.
fn measured(
    path: &Path,
    given: &BTreeMap<String, Option<f64>>,
    unexcited: &[String],
) -> Result<BTreeMap<String, f64>, Error> {
    let mut values = BTreeMap::new();
    let mut without: Vec<&str> = unexcited.iter().map(String::as_str).collect();
    for (name, value) in given {
        match value {
            Some(value) => {
                values.insert(name.clone(), *value);
            }
            None if !without.contains(&name.as_str()) => without.push(name),
            None => {}
        }
    }
    if without.is_empty() {
        return Ok(values);
    }
    let reason = format!(
        "the logs did not separate {} from other parameters, so the file holds no value that is valid on another motion; \
         identify on logs that move the joints concerned, or give values in a file of your own",
        list(&without)
    );
    Err(Error::json(path, &reason))
}

/// Values from a file, and from the spec where the file has none or there is no file.
pub(crate) fn resolve(compiled: &Compiled, file: Option<&Path>) -> Result<Values, Error> {
    let (given, source) = match file {
        Some(path) => (read(path)?, path.display().to_string()),
        None => (BTreeMap::new(), compiled.model.source.clone()),
    };
    let fault = |reason: String| Error::Argument(format!("{source}: {reason}"));

    let shape_names = compiled.shape_names();
    let standard_names: Vec<&str> = compiled
        .standard
        .iter()
        .map(|parameter| parameter.name.as_str())
        .collect();
    let base_names: Vec<&str> = compiled.base.names.iter().map(String::as_str).collect();
    let is_shape = |name: &str| shape_names.iter().any(|shape| shape == name);
    let linear = given.keys().map(String::as_str);
    let linear: Vec<&str> = linear.filter(|name| !is_shape(name)).collect();
    // Regrouped base parameters have names of their own; they stand for all standard parameters or for none.
    let is_base = !base_names.is_empty()
        && linear.len() == base_names.len()
        && base_names.iter().all(|name| linear.contains(name));
    let known = if is_base {
        &base_names
    } else {
        &standard_names
    };
    let products = if is_base {
        BTreeMap::new()
    } else {
        products(compiled, &given).map_err(fault)?
    };
    let is_factor = |name: &str| {
        let energies = compiled.model.energies();
        !is_base && energies.is_some_and(|e| e.parameters.iter().any(|p| p.name == name))
    };
    let unknown: Vec<&str> = linear
        .iter()
        .copied()
        .filter(|name| !known.contains(name) && !is_factor(name))
        .collect();
    if !unknown.is_empty() {
        let all_base = unknown.iter().all(|name| base_names.contains(name));
        let why = match unknown.as_slice() {
            _ if all_base => {
                "; base parameters are accepted only as a whole set, and with no others".to_owned()
            }
            [only] => {
                let names = standard_names.iter().chain(&base_names).copied();
                match nearest(only, names.chain(shape_names.iter().map(String::as_str))) {
                    Some(name) => format!("; is `{name}` meant?"),
                    None => String::new(),
                }
            }
            _ => String::new(),
        };
        return Err(fault(format!(
            "{} has no parameter {}{why}",
            compiled.model.name,
            list(&unknown)
        )));
    }

    let mut missing = Vec::new();
    let beta = if is_base {
        base_names.iter().map(|name| given[*name]).collect()
    } else {
        let standard = standard(compiled, &products, &mut missing).map_err(fault)?;
        compiled.base.beta(&standard)
    };
    let mut shapes = shape_values(&compiled.model);
    let effects = compiled.model.effects.iter();
    let declared: Vec<&ShapeParameter> = effects.flat_map(|e| &e.definition.shapes).collect();
    let free = compiled.free_shapes();
    for (k, name) in shape_names.iter().enumerate() {
        match given.get(name) {
            Some(value) if free.contains(&k) => {
                if let Some(wanted) = declared[k].misses(*value) {
                    return Err(fault(format!("`{name}` is {value}; it has to be {wanted}")));
                }
                shapes[k] = *value;
            }
            Some(value) if differ(*value, shapes[k]) => {
                return Err(fault(format!(
                    "`{name}` is {value} here and {} in the spec",
                    shapes[k]
                )));
            }
            None if free.contains(&k) => missing.push(name.as_str()),
            _ => {}
        }
    }
    if !missing.is_empty() {
        return Err(fault(no_value(&missing)));
    }
    Ok(Values {
        parameters: compiled.parameter_values(&beta),
        shapes,
    })
}

/// Values of standard parameters: those given, and the products of a robot's own parameters where it says its energies.
fn products(
    compiled: &Compiled,
    given: &BTreeMap<String, f64>,
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
            (Some(product), _) => {
                values.insert(name, product);
            }
            (None, _) => {}
        }
    }
    Ok(values)
}

/// A value for every standard parameter that some torque depends on; `missing` takes the names of those without.
fn standard<'a>(
    compiled: &'a Compiled,
    given: &BTreeMap<String, f64>,
    missing: &mut Vec<&'a str>,
) -> Result<Vec<f64>, String> {
    let mut values = vec![0.0; compiled.standard.len()];
    for (k, parameter) in compiled.standard.iter().enumerate() {
        values[k] = match (given.get(&parameter.name).copied(), parameter.status) {
            (Some(value), Status::Fixed(fixed)) if differ(value, fixed) => {
                return Err(format!(
                    "`{}` is {value} here and fixed to {fixed} in the spec",
                    parameter.name
                ));
            }
            (Some(value), _) | (None, Status::Nominal(value) | Status::Fixed(value)) => value,
            (None, Status::Unknown) => {
                if !compiled.base.unidentifiable.contains(&k) {
                    missing.push(parameter.name.as_str());
                }
                0.0
            }
        };
    }
    Ok(values)
}

/// The names, all of them, as a file to be filled in.
fn no_value(names: &[&str]) -> String {
    let entries: Vec<String> = names.iter().map(|name| format!("\"{name}\": ..")).collect();
    format!(
        "no value for {}; give it in a file with `--parameters`: {{{}}}",
        list(names),
        entries.join(", ")
    )
}

/// More than rounding apart.
fn differ(left: f64, right: f64) -> bool {
    (left - right).abs() > 1e-12 * left.abs().max(right.abs())
}

/// Names in backticks; a long list keeps its first twelve.
fn list(names: &[&str]) -> String {
    const SHOWN: usize = 12;
    let mut text: Vec<String> = names
        .iter()
        .take(SHOWN)
        .map(|name| format!("`{name}`"))
        .collect();
    if names.len() > SHOWN {
        text.push(format!("and {} more", names.len() - SHOWN));
    }
    text.join(", ")
}
