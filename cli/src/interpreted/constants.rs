//! Base parameters of a robot that says its energies, as functions of the spec's own constants.

use nalgebra::DMatrix;
use robot_model::simulate::Functions;
use robot_model_codegen::Compiled;
use robot_model_spec::parameter::Owner;

/// A product: unknowns by their places, with their exponents.
type Factors = Vec<(usize, i32)>;

/// A sum of products with coefficients.
type Terms = Vec<(f64, Factors)>;

/// A robot's unknowns as its spec names them: constants of energies, then parameters of effects, then open shapes.
///
/// Base parameters are sums of products of the constants, so motions may tell fewer than these.
#[derive(Debug, Clone)]
pub struct Constants {
    names: Vec<String>,
    nominal: Vec<Option<f64>>,
    /// Of each own parameter of the plant.
    terms: Vec<Terms>,
}

impl Constants {
    /// None of a chain, which has no constants.
    #[must_use]
    pub fn new(compiled: &Compiled) -> Option<Self> {
        let energies = compiled.model.energies()?;
        let own = energies.parameters.iter();
        let mut names: Vec<String> = own.clone().map(|constant| constant.name.clone()).collect();
        let mut nominal: Vec<Option<f64>> = own.map(|constant| constant.nominal).collect();
        let mut term = |k: usize| -> Factors {
            match compiled.standard[k].owner {
                Owner::Monomial(monomial) => energies.monomials[monomial].factors.clone(),
                Owner::Link { .. } | Owner::Effect { .. } => {
                    let name = &compiled.standard[k].name;
                    let known = names.iter().position(|other| other == name);
                    let place = known.unwrap_or_else(|| {
                        names.push(name.clone());
                        nominal.push(None);
                        names.len() - 1
                    });
                    vec![(place, 1)]
                }
            }
        };
        let bases = compiled.base.combinations.iter();
        let mut terms: Vec<Terms> = bases
            .map(|base| base.iter().map(|&(k, x)| (x, term(k))).collect())
            .collect();
        let shapes = compiled.shape_names();
        for shape in compiled.free_shapes() {
            terms.push(vec![(1.0, vec![(names.len(), 1)])]);
            names.push(shapes[shape].clone());
            nominal.push(None);
        }
        Some(Self {
            names,
            nominal,
            terms,
        })
    }

    /// Their names, in the order of the spec.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Values that the spec gives.
    #[must_use]
    pub fn nominal(&self) -> &[Option<f64>] {
        &self.nominal
    }
}

fn product(values: &[f64], factors: &[(usize, i32)]) -> f64 {
    let factors = factors.iter();
    factors.map(|&(k, power)| values[k].powi(power)).product()
}

impl Functions for Constants {
    fn own(&self, values: &[f64]) -> Vec<f64> {
        let sum = |terms: &Terms| {
            let terms = terms.iter();
            terms.map(|(x, factors)| x * product(values, factors)).sum()
        };
        self.terms.iter().map(sum).collect()
    }

    fn slopes(&self, values: &[f64]) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.terms.len(), values.len());
        for (row, terms) in self.terms.iter().enumerate() {
            for (x, factors) in terms {
                for (place, &(k, power)) in factors.iter().enumerate() {
                    let mut rest = factors.clone();
                    rest[place].1 -= 1;
                    slopes[(row, k)] += x * f64::from(power) * product(values, &rest);
                }
            }
        }
        slopes
    }
}

#[cfg(test)]
mod tests {
    use robot_model_codegen::compile_model;

    use super::*;

    const SWING: &str = "robot Swing {
        coordinates q1, q2;
        parameters m1 = 6 kg, I1 = 0.4 kg*m^2, m2 = 3 kg, l1 = 0.6 m, c1 = 0.3 m, c2 = 0.2 m;
        constants g = 9.81 m/s^2;
        let x = l1*sin(q1) + c2*sin(q1 + q2);
        let y = -l1*cos(q1) - c2*cos(q1 + q2);
        kinetic = (m1*c1^2 + I1)/2*dot(q1)^2 + m2/2*(dot(x)^2 + dot(y)^2);
        potential = g*(m2*y - m1*c1*cos(q1));
        effects { viscous_friction on all; }
    }";

    fn constants() -> (Compiled, Constants) {
        let model = robot_model_spec::load("swing.robot", SWING).expect("a spec");
        let compiled = compile_model(&model);
        let constants = Constants::new(&compiled).expect("it says its energies");
        (compiled, constants)
    }

    #[test]
    fn names_are_those_of_the_spec_and_of_its_effects() {
        let (_, constants) = constants();
        let viscous = ["q1.viscous_friction.fv", "q2.viscous_friction.fv"];
        let wanted = [&["m1", "I1", "m2", "l1", "c1", "c2"][..], &viscous].concat();
        assert_eq!(constants.names(), wanted);
        assert_eq!(constants.nominal()[4..7], [Some(0.3), Some(0.2), None]);
    }

    #[test]
    fn base_parameters_and_their_slopes_are_those_of_the_constants() {
        let (compiled, constants) = constants();
        let values = [6.0, 0.4, 3.0, 0.6, 0.3, 0.2, 0.7, 0.5];
        let own = constants.own(&values);
        let of = |name: &str| {
            let place = compiled.base.names.iter().position(|other| other == name);
            own[place.unwrap_or_else(|| panic!("{:?}", compiled.base.names))]
        };
        assert!((of("m2*c2") - 0.6).abs() < 1e-12);
        assert!((of("m1*c1r") - (1.8 + 1.8)).abs() < 1e-12);
        assert!((of("q2.viscous_friction.fv") - 0.5).abs() < 1e-12);
        let slopes = constants.slopes(&values);
        for k in 0..values.len() {
            let beside = |step: f64| {
                let mut values = values;
                values[k] += step;
                constants.own(&values)
            };
            let (low, high) = (beside(-1e-6), beside(1e-6));
            for row in 0..own.len() {
                let slope = (high[row] - low[row]) / 2e-6;
                assert!((slopes[(row, k)] - slope).abs() < 1e-8, "{row} {k}");
            }
        }
    }
}
