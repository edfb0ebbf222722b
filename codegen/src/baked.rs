//! Numbers of one arm, which go into its equations in place of symbols.

use std::fmt;

use crate::compiled::Compiled;

/// Where the numbers of an arm are from: the page says it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin {
    /// The file; its folder does not reach the page.
    pub file: String,
    /// Which parameters it gives.
    pub given: Given,
    /// How many of them the spec gave, as the file did not.
    pub from_spec: usize,
}

/// Parameters that a set of numbers is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Given {
    /// Standard parameters, or what they are products of.
    Standard,
    /// Base parameters, as an identification gives them.
    Base,
}

impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Standard => "standard parameters",
            Self::Base => "base parameters",
        })
    }
}

/// Why numbers are not those of an arm.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum BakeError {
    /// There are more or fewer than parameters.
    Count {
        /// Which parameters.
        what: &'static str,
        /// Numbers.
        found: usize,
        /// Parameters.
        wanted: usize,
    },
    /// An infinity, or no number.
    NotFinite {
        /// The parameter.
        name: String,
        /// What was given.
        value: f64,
    },
    /// A shape parameter for which its effect's law does not hold.
    Shape {
        /// The parameter.
        name: String,
        /// What was given.
        value: f64,
        /// What it has to be.
        wanted: &'static str,
    },
}

impl fmt::Display for BakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count {
                what,
                found,
                wanted,
            } => write!(
                f,
                "{found} numbers for {wanted} {what}; give one for each, in their order"
            ),
            Self::NotFinite { name, value } => {
                write!(f, "`{name}` is {value}; it must be a finite number")
            }
            Self::Shape {
                name,
                value,
                wanted,
            } => write!(f, "`{name}` is {value}; it must be {wanted}"),
        }
    }
}

impl std::error::Error for BakeError {}

impl Compiled {
    /// Whether these are numbers of an arm: one for each base parameter, one for each shape parameter.
    ///
    /// # Errors
    /// By name what is not finite, a shape for which its effect's law does not hold, too many or too few numbers.
    pub fn check_numbers(&self, beta: &[f64], shapes: &[f64]) -> Result<(), BakeError> {
        let shape_names = self.shape_names();
        for (what, names, numbers) in [
            ("base parameters", &self.base.names, beta),
            ("shape parameters", &shape_names, shapes),
        ] {
            if names.len() != numbers.len() {
                return Err(BakeError::Count {
                    what,
                    found: numbers.len(),
                    wanted: names.len(),
                });
            }
            if let Some((name, &value)) = names.iter().zip(numbers).find(|(_, x)| !x.is_finite()) {
                let name = name.clone();
                return Err(BakeError::NotFinite { name, value });
            }
        }
        let effects = self.model.effects.iter();
        let declared = effects.flat_map(|effect| &effect.definition.shapes);
        let shapes = shape_names.iter().zip(declared).zip(shapes);
        for ((name, shape), &value) in shapes {
            if let Some(wanted) = shape.misses(value) {
                return Err(BakeError::Shape {
                    name: name.clone(),
                    value,
                    wanted,
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::BakeError;
    use crate::compiled::{Compiled, compile_model};

    fn cart() -> Compiled {
        let spec = "robot Cart { gravity = [0, 0, -9.81]; convention = origin; joint rail: prismatic { xyz = [0, 0, 0]; \
                    axis = [1, 0, 0]; link = cart; } effects { stribeck on rail; } }";
        let model = robot_model_spec::load("cart.robot", spec);
        compile_model(&model.unwrap_or_else(|errors| panic!("{errors}")))
    }

    #[test]
    fn what_is_no_number_of_an_arm_is_refused_by_name() {
        let cart = cart();
        let said = |beta: &[f64], shapes: &[f64]| {
            let baked: Result<Compiled, BakeError> = cart.baked(beta, shapes);
            baked.expect_err("no arm").to_string()
        };
        assert!(cart.baked(&[3.0, 5.0], &[0.1]).is_ok());
        let cases: [(&[f64], &[f64], &str); 5] = [
            (
                &[3.0],
                &[0.1],
                "1 numbers for 2 base parameters; give one for each, in their order",
            ),
            (
                &[3.0, 5.0],
                &[],
                "0 numbers for 1 shape parameters; give one for each, in their order",
            ),
            (
                &[f64::NAN, 5.0],
                &[0.1],
                "`cart.m` is NaN; it must be a finite number",
            ),
            (
                &[3.0, 5.0],
                &[f64::INFINITY],
                "`rail.stribeck.vs` is inf; it must be a finite number",
            ),
            (
                &[3.0, 5.0],
                &[0.0],
                "`rail.stribeck.vs` is 0; it must be a positive number",
            ),
        ];
        for (beta, shapes, wanted) in cases {
            assert_eq!(said(beta, shapes), wanted);
        }
    }
}
