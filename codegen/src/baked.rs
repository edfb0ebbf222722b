//! Equations of one arm: with numbers for its parameters.

use crate::compiled::{Compiled, base_values};
use crate::dynamics::energy;
use crate::dynamics::{self, Computed, Value};
use crate::expr::Dag;
use crate::lumps;

/// The equations of motion with numbers for all linear parameters: terms of parameters that are zero are gone, products of
/// numbers are numbers. Shape parameters that the spec leaves open stay symbols.
#[derive(Debug, Clone)]
pub struct Baked {
    /// Where the equations live.
    pub dag: Dag,
    /// The equations.
    pub computed: Computed,
}

impl Compiled {
    /// The arm whose base parameters are `beta`, in their order. The derivation runs with the numbers, so its ways are chosen
    /// for them.
    #[must_use]
    pub fn baked(&self, beta: &[f64]) -> Baked {
        let mut values = base_values(&self.standard, &self.base);
        for (&k, &value) in self.base.kept.iter().zip(beta) {
            values[k] = Value::Number(value);
        }
        let mut dag = Dag::new();
        let dof = self.dof();
        let energies = self.model.energies();
        let lumps = energies.and_then(|energies| lumps::collect(&mut dag, energies, dof));
        let form = match lumps {
            Some(lumps) => Some(lumps.form),
            None => energies.map(|energies| energy::written(&mut dag, energies, dof)),
        };
        let computed = dynamics::compute(&mut dag, &self.model, form.as_ref(), &values);
        Baked { dag, computed }
    }
}
