//! The compiler's base parameters `1/beta`, `alpha/beta`, `c/beta` said in the paper's words `alpha`, `beta`, `c`.

use nalgebra::DMatrix;
use robot_model::simulate::{Functions, Through};
use robot_model_cli::interpreted::InterpretedPlant;
use robot_model_codegen::Compiled;

use crate::paper::Error;

/// Names of the rigid base parameters, as the compiler gives them.
pub const INERTIA: &str = "beta^-1";
/// The same.
pub const GRAVITY: &str = "alpha*beta^-1";

/// A plant whose parameters are `alpha`, `beta` and constants of friction: those of equation (2.4), over which the paper's search goes.
///
/// Steps of Levenberg and Marquardt depend on which words are used, so iterates are comparable in the same ones only.
pub type InWords = Through<InterpretedPlant, Words>;

/// The plant of a spec at `[alpha, beta, c..]`.
///
/// # Errors
/// Where the compiler has found other rigid parameters than `1/beta` and `alpha/beta`.
pub fn in_words(spec: Compiled, values: &[f64]) -> Result<InWords, Error> {
    let words = Words::of(&spec.base.names)?;
    let plant = InterpretedPlant::new(spec, &words.own(values), &[])?;
    Ok(Through::new(plant, words, values.to_vec()))
}

/// Base parameters as functions of `[alpha, beta, c..]`.
#[derive(Debug, Clone)]
pub struct Words {
    /// Places of `1/beta` and of `alpha/beta`.
    rigid: [usize; 2],
    /// Places of `c/beta`, in order.
    friction: Vec<usize>,
}

impl Words {
    /// Of base parameters of these names.
    fn of(names: &[String]) -> Result<Self, Error> {
        let place = |name: &str| names.iter().position(|known| known == name);
        let (Some(inertia), Some(gravity)) = (place(INERTIA), place(GRAVITY)) else {
            return Err(format!("base parameters are {names:?}").into());
        };
        let rigid = [inertia, gravity];
        Ok(Self {
            friction: (0..names.len()).filter(|k| !rigid.contains(k)).collect(),
            rigid,
        })
    }
}

impl Functions for Words {
    fn own(&self, values: &[f64]) -> Vec<f64> {
        let (alpha, beta) = (values[0], values[1]);
        let mut base = vec![0.0; values.len()];
        base[self.rigid[0]] = 1.0 / beta;
        base[self.rigid[1]] = alpha / beta;
        for (&place, c) in self.friction.iter().zip(&values[2..]) {
            base[place] = c / beta;
        }
        base
    }

    fn slopes(&self, values: &[f64]) -> DMatrix<f64> {
        let beta = values[1];
        let base = self.own(values);
        let mut slopes = DMatrix::zeros(base.len(), base.len());
        for (place, value) in base.iter().enumerate() {
            slopes[(place, 1)] = -value / beta;
        }
        slopes[(self.rigid[1], 0)] = 1.0 / beta;
        for (k, &place) in self.friction.iter().enumerate() {
            slopes[(place, 2 + k)] = 1.0 / beta;
        }
        slopes
    }
}
