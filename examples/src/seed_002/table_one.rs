//! Table I, asked whether an arm can have it.

use std::collections::BTreeMap;

use robot_model_cli::audit::{Check, audit};
use robot_model_codegen::Compiled;

use super::arm::truth;
use super::truth::TABLE_1;
use crate::paper::Error;

/// Table I by name; `fc2` as printed, or as the magnitude that equation 3 wants.
#[must_use]
pub fn printed(as_magnitude: bool) -> BTreeMap<String, f64> {
    let mut values = BTreeMap::new();
    for (name, row) in TABLE_1 {
        for (joint, value) in (1..).zip(row) {
            let is_turned = as_magnitude && name == "rokae.fc2";
            let value = if is_turned { value.abs() } else { value };
            values.insert(format!("j{joint}.{name}"), value);
        }
    }
    values
}

/// The arm that is simulated here, its friction that of Table I or the same without square and cube.
#[must_use]
pub fn ours(with_cubes: bool) -> BTreeMap<String, f64> {
    let mut values = truth();
    if !with_cubes {
        for (name, value) in &mut values {
            if ["rokae.fv2", "rokae.fv3"]
                .iter()
                .any(|end| name.ends_with(end))
            {
                *value = 0.0;
            }
        }
    }
    values
}

/// What the audit says of values, check by check.
#[derive(Debug, Clone)]
pub struct Audited(Vec<Check>);

impl Audited {
    /// Asks.
    ///
    /// # Errors
    /// Values without a parameter of the arm's.
    pub fn of(compiled: &Compiled, values: &BTreeMap<String, f64>) -> Result<Self, Error> {
        Ok(Self(audit(compiled, values)?))
    }

    /// What speaks against the values in one check.
    #[must_use]
    pub fn findings(&self, check: &str) -> &[String] {
        let mut checks = self.0.iter();
        checks
            .find(|one| one.name == check)
            .map_or(&[], |one| &one.findings)
    }

    /// Speed from which on a joint's friction drives it, rad/s.
    #[must_use]
    pub fn drives_from(&self, joint: usize) -> Option<f64> {
        let name = format!("`j{}`", joint + 1);
        let mut findings = self.findings("friction").iter();
        let said = findings.find(|said| said.contains(&name))?;
        let (_, number) = said.split_once(" from ")?;
        number.split(' ').next()?.parse().ok()
    }
}
