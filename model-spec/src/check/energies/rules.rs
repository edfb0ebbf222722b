//! The rules of one statement: its dimensions, its degree in the rates, the products of parameters in it.

use super::dimension::{Dimensions, Inference};
use super::monomials::{self, Coefficient};
use super::rates;
use super::resolve::Resolved;
use super::{Checked, Fault, Statement};
use crate::model::Monomial;
use crate::polynomial::Polynomial;

/// What the rules find of one statement.
pub(super) struct Found {
    pub(super) dimensions: Dimensions,
    pub(super) degree: rates::Degree,
    pub(super) polynomial: Polynomial<Coefficient>,
}

/// The rules of expressions, with what is known of the bindings.
pub(super) struct Rules<'a> {
    pub(super) inference: &'a mut Inference,
    pub(super) degrees: &'a [rates::Degree],
    pub(super) expanded: &'a [Polynomial<Coefficient>],
}

impl Rules<'_> {
    pub(super) fn check(&mut self, statement: Statement, resolved: &Resolved) -> Checked<Found> {
        Ok(Found {
            dimensions: self.inference.infer(statement, resolved, self.expanded)?,
            degree: rates::degree(statement, &resolved.value, self.degrees, self.expanded)?,
            polynomial: monomials::expand(statement, &resolved.value, self.expanded)?,
        })
    }

    pub(super) fn energy(
        &mut self,
        statement: Statement,
        resolved: &Resolved,
        degree: u32,
    ) -> Checked<Polynomial<Coefficient>> {
        let found = self.check(statement, resolved)?;
        let what = if degree > 0 {
            "the kinetic energy"
        } else {
            "the potential energy"
        };
        if found.degree.is_some_and(|d| d != degree) {
            return Err(wrong_degree(statement, what, degree > 0));
        }
        self.inference
            .expect(statement, &found.dimensions, Dimensions::ENERGY, what)?;
        Ok(found.polynomial)
    }

    /// A coordinate of a point: a length, free of rates and of unknown parameters.
    pub(super) fn place(&mut self, statement: Statement, resolved: &Resolved) -> Checked<()> {
        let found = self.check(statement, resolved)?;
        let what = "the position of a point";
        if found.degree.is_some_and(|d| d != 0) {
            return Err(wrong_degree(statement, what, false));
        }
        if !found.polynomial.keys().all(Monomial::is_one) {
            return Err(Fault::new(
                statement,
                Vec::new(),
                "the position of a point has an unknown parameter",
                "its position is unknown",
                "make the lengths constants",
            ));
        }
        self.inference
            .expect(statement, &found.dimensions, [0.0, 1.0, 0.0, 0.0], what)
            .map_err(|mut fault| {
                // What most often has no unit is the length of a link.
                "a number inside an expression has no unit: make lengths constants, as in `constants l = 0.4 m;`"
                    .clone_into(&mut fault.help);
                fault
            })
    }
}

fn wrong_degree(statement: Statement, what: &str, quadratic: bool) -> Box<Fault> {
    if quadratic {
        Fault::new(
            statement,
            Vec::new(),
            format!("{what} is not quadratic in the rates"),
            "",
            "rates are written `dot(q)`; each term has a product of two",
        )
    } else {
        Fault::new(
            statement,
            Vec::new(),
            format!("{what} has rates in it"),
            "",
            "write it in coordinates alone",
        )
    }
}
