//! The functions of the motion that torques are sums of.

use std::collections::BTreeMap;

use crate::compiled::Compiled;
use crate::expr::{ExprId, Symbol};
use crate::interpreter::Program;
use crate::show::polynomial;

/// Functions of the motion with their names, `cos(q1 - q2) dq1^2`, free of parameters; in the order of their names.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Terms {
    /// As they stand in equations.
    pub names: Vec<String>,
    /// One output a function; reads `q, dq, ddq`.
    pub program: Program,
}

impl Compiled {
    /// The functions that the torques of all joints are sums of, once they are multiplied out, each without its number and its parameters.
    /// None of what an effect knows beside the motion. None at all where the torque of a joint takes more terms than a person would read.
    #[must_use]
    pub fn terms(&self) -> Terms {
        let mut dag = self.dag.clone();
        let names = self.names();
        let mut found: BTreeMap<String, ExprId> = BTreeMap::new();
        for &torque in &self.dynamics.inverse_dynamics {
            let Some(expanded) = polynomial::expand(&mut dag, torque, &names) else {
                found.clear();
                break;
            };
            for (name, function) in polynomial::functions(&mut dag, &expanded, &names) {
                let is_of_motion = dag
                    .symbols(&[function])
                    .iter()
                    .all(|symbol| matches!(symbol, Symbol::Q(_) | Symbol::Dq(_) | Symbol::Ddq(_)));
                if is_of_motion {
                    found.insert(name, function);
                }
            }
        }
        let (names, outputs): (Vec<String>, Vec<ExprId>) = found.into_iter().unzip();
        Terms {
            names,
            program: Program::new(&dag, &outputs),
        }
    }
}
