//! The arms that are measured: the rigid bodies of specs whose links have nominal values.

use std::path::{Path, PathBuf};

use robot_model_codegen::base::shape_values;
use robot_model_codegen::emit;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::model::{JointKind, Transform};
use robot_model_spec::parameter::Status;
use serde_json::{Value, json};

use crate::{Error, failed};

/// Arms that are measured, by the names of their specs.
pub const ROBOTS: [&str; 3] = ["puma560", "ur10", "panda"];

/// Functions that are measured, by their emitted names.
pub const FUNCTIONS: [&str; 6] = [
    "inverse_dynamics",
    "mass_matrix",
    "coriolis_matrix",
    "gravity",
    "regressor",
    "base_regressor",
];

/// The root of the repository, where its specs and its lock file are.
#[must_use]
pub fn workspace() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

/// One arm, with base parameters as arguments and with their values in its equations.
#[derive(Debug)]
pub struct Arm {
    /// Name of its spec.
    pub name: &'static str,
    /// Base parameters are arguments.
    pub runtime: Compiled,
    /// Base parameters are numbers.
    pub baked: Compiled,
    /// Values of the standard parameters, ten a link.
    pub standard: Vec<f64>,
    /// Values of the base parameters.
    pub beta: Vec<f64>,
}

impl Arm {
    /// Where its spec is.
    #[must_use]
    pub fn spec(name: &str) -> PathBuf {
        workspace()
            .join("tests/specs/pass")
            .join(name)
            .with_extension("robot")
    }

    /// Reads `tests/specs/pass/NAME.robot`.
    ///
    /// # Errors
    /// A spec that is not there, has mistakes or leaves parameters without a value.
    pub fn read(name: &'static str) -> Result<Self, Error> {
        let path = Self::spec(name);
        let text = std::fs::read_to_string(&path).map_err(|error| failed("read", &path, error))?;
        Self::rigid(name, &text)
    }

    /// The arm of a spec without its effects, which peers do not know.
    ///
    /// # Errors
    /// Mistakes in the spec, parameters without a value.
    pub fn rigid(name: &'static str, text: &str) -> Result<Self, Error> {
        let model = robot_model_spec::load(name, &without_effects(text))
            .map_err(|errors| Error::new(errors.to_string()))?;
        let runtime = compile_model(&model);
        let values = runtime
            .standard
            .iter()
            .map(|parameter| match parameter.status {
                Status::Fixed(value) | Status::Nominal(value) => Ok(value),
                Status::Unknown => Err(Error::new(format!(
                    "`{}` of `{name}` has no value: give the link's inertial in the spec",
                    parameter.name
                ))),
            });
        let standard = values.collect::<Result<Vec<f64>, Error>>()?;
        let beta = runtime.base.beta(&standard);
        let baked = runtime.baked(&beta, &shape_values(&model));
        let baked = baked.map_err(|error| Error::new(format!("{name}: {error}")))?;
        Ok(Self {
            name,
            runtime,
            baked,
            standard,
            beta,
        })
    }

    /// Degrees of freedom.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.runtime.dof()
    }

    /// Operations of an emitted function.
    ///
    /// # Errors
    /// The page has no such function.
    pub fn cost(compiled: &Compiled, function: &str) -> Result<emit::Cost, Error> {
        let costs = emit::costs(compiled);
        let found = costs.iter().find(|(name, _)| *name == function);
        found
            .map(|(_, cost)| *cost)
            .ok_or_else(|| Error::new(format!("the page has no function `{function}` to count")))
    }

    /// How many numbers a function returns.
    #[must_use]
    pub fn outputs(&self, function: &str) -> usize {
        let dof = self.dof();
        match function {
            "mass_matrix" | "coriolis_matrix" => dof * dof,
            "regressor" => dof * self.standard.len(),
            "base_regressor" => dof * self.beta.len(),
            _ => dof,
        }
    }

    /// The arm in numbers, for programs that write code from them: frames, inertials and the columns of the base regressor.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let model = &self.runtime.model;
        let chain = model.chain().expect("the measured arms are chains");
        let transform =
            |part: &Transform| json!({"rotation": part.rotation, "translation": part.translation});
        let links = chain.links.iter().zip(&model.joints);
        let links: Vec<Value> = links
            .zip(self.standard.chunks(10))
            .map(|((link, joint), inertial)| {
                json!({
                    "revolute": joint.kind == JointKind::Revolute,
                    "before": transform(&link.placement.before),
                    "axis": link.placement.axis,
                    "offset": link.placement.offset,
                    "after": transform(&link.placement.after),
                    "inertial": inertial,
                })
            })
            .collect();
        json!({
            "name": self.name,
            "gravity": chain.gravity,
            "links": links,
            "base_columns": self.runtime.base.kept,
        })
    }
}

/// The spec's text without its `effects { .. }`.
fn without_effects(text: &str) -> String {
    let Some((before, rest)) = text.split_once("effects {") else {
        return text.to_owned();
    };
    let after = rest.split_once('}').map_or("", |(_, after)| after);
    format!("{before}{after}")
}
