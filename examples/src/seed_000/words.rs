//! The compiler's base parameters `1/beta`, `alpha/beta`, `c/beta` said in the paper's words `alpha`, `beta`, `c`.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Adjustable, Instant, Jumps, ParameterSlopes, Plant, Slopes};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::paper::Error;

/// Names of the rigid base parameters, as the compiler gives them.
pub const INERTIA: &str = "beta^-1";
/// The same.
pub const GRAVITY: &str = "alpha*beta^-1";

/// A plant whose parameters are `alpha`, `beta` and constants of friction: those of equation (2.4), over which the paper's search goes.
///
/// Steps of Levenberg and Marquardt depend on which words are used, so iterates are comparable in the same ones only.
#[derive(Debug, Clone)]
pub struct InWords {
    plant: InterpretedPlant,
    /// Places of `1/beta` and of `alpha/beta`.
    rigid: [usize; 2],
    /// Places of `c/beta`, in order.
    friction: Vec<usize>,
    values: Vec<f64>,
}

impl InWords {
    /// A plant with base parameters of these names, and `[alpha, beta, c..]`.
    ///
    /// # Errors
    /// Where the compiler has found other rigid parameters than `1/beta` and `alpha/beta`.
    pub fn new(plant: InterpretedPlant, names: &[String], values: &[f64]) -> Result<Self, Error> {
        let place = |name: &str| names.iter().position(|known| known == name);
        let (Some(inertia), Some(gravity)) = (place(INERTIA), place(GRAVITY)) else {
            return Err(format!("base parameters are {names:?}").into());
        };
        let rigid = [inertia, gravity];
        let mut found = Self {
            plant,
            friction: (0..names.len()).filter(|k| !rigid.contains(k)).collect(),
            rigid,
            values: values.to_vec(),
        };
        found.adjust(values);
        Ok(found)
    }

    /// The base parameters that these values make.
    #[must_use]
    pub fn base(&self) -> Vec<f64> {
        let (alpha, beta) = (self.values[0], self.values[1]);
        let mut base = vec![0.0; self.values.len()];
        base[self.rigid[0]] = 1.0 / beta;
        base[self.rigid[1]] = alpha / beta;
        for (&place, c) in self.friction.iter().zip(&self.values[2..]) {
            base[place] = c / beta;
        }
        base
    }

    /// `d base / d (alpha, beta, c..)`
    fn jacobian(&self) -> DMatrix<f64> {
        let beta = self.values[1];
        let base = self.base();
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

impl Adjustable for InWords {
    fn values(&self) -> Vec<f64> {
        self.values.clone()
    }

    fn prepare(&mut self) {
        self.plant.prepare();
    }

    fn adjust(&mut self, values: &[f64]) {
        self.values.copy_from_slice(values);
        self.plant.adjust(&self.base());
    }

    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
        self.plant.parameter_slopes(at, slopes);
        let jacobian = self.jacobian();
        for matrix in [&mut slopes.torque, &mut slopes.rates, &mut slopes.arguments] {
            *matrix = &*matrix * &jacobian;
        }
    }
}

impl Plant for InWords {
    fn dof(&self) -> usize {
        self.plant.dof()
    }

    fn switches(&self) -> usize {
        self.plant.switches()
    }

    fn is_affine(&self) -> bool {
        self.plant.is_affine()
    }

    fn is_timed(&self) -> bool {
        self.plant.is_timed()
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        self.plant.torque(at, torque, inertia);
    }

    fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) {
        self.plant.arguments(at, arguments);
    }

    fn jumps(&mut self, at: &Instant<'_>, jumps: &mut Jumps) {
        self.plant.jumps(at, jumps);
    }

    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        self.plant.slopes(at, slopes);
    }
}
