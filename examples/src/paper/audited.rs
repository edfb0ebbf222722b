//! What the tool's audit says of parameters, check by check.

use std::collections::BTreeMap;

use robot_model_cli::audit::{Check, audit};
use robot_model_codegen::Compiled;

use super::Error;

/// All checks of one set of parameters.
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

    /// A check by its name.
    #[must_use]
    pub fn check(&self, name: &str) -> Option<&Check> {
        self.0.iter().find(|check| check.name == name)
    }

    /// What speaks against the values in one check.
    #[must_use]
    pub fn findings(&self, check: &str) -> &[String] {
        self.check(check).map_or(&[], |check| &check.findings)
    }

    /// What a check has a number of this kind of: links, joints or parameters.
    #[must_use]
    pub fn told_of(&self, check: &str, what: &str) -> Vec<&str> {
        let quantities = self.check(check).into_iter();
        let quantities = quantities.flat_map(|check| &check.quantities);
        let own = quantities.filter(|quantity| quantity.what == what);
        own.filter_map(|quantity| quantity.of.as_deref()).collect()
    }

    /// All that a check has a number of.
    #[must_use]
    pub fn told(&self, check: &str) -> Vec<&str> {
        let quantities = self.check(check).into_iter();
        let quantities = quantities.flat_map(|check| &check.quantities);
        quantities
            .filter_map(|quantity| quantity.of.as_deref())
            .collect()
    }

    /// Speed from which on a joint's friction drives it, rad/s.
    #[must_use]
    pub fn drives_from(&self, joint: &str) -> Option<f64> {
        self.check("friction")?.quantity("driven_from", Some(joint))
    }

    /// Least eigenvalue of the inertia over the workspace, kg m^2; no number where there is no such check.
    #[must_use]
    pub fn least_eigenvalue(&self) -> f64 {
        let inertia = self.check("inertia");
        let least = inertia.and_then(|check| check.quantity("least_eigenvalue", None));
        least.unwrap_or(f64::NAN)
    }
}
