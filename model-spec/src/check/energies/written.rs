//! The expressions in the order of the text: each is resolved, checked by the rules, and known to those behind it.

use super::dimension::Inference;
use super::monomials::{self, Coefficient};
use super::rates;
use super::resolve::Scope;
use super::rules::Rules;
use super::{Checked, Statement};
use crate::ast::{self, Robot};
use crate::check::Errors;
use crate::diagnostic::Diagnostic;
use crate::model::{Binding, Energies, Parameter, Point};
use crate::polynomial::Polynomial;

/// What a robot that says its energies has written, name checks passed.
pub(super) struct Written<'a> {
    pub(super) robot: &'a Robot,
    pub(super) kinetic: Option<&'a ast::Expr>,
    pub(super) potential: Option<&'a ast::Expr>,
}

impl<'a> Written<'a> {
    pub(super) fn check(
        &self,
        mut scope: Scope,
        mut inference: Inference,
        parameters: Vec<Parameter>,
        errors: &mut Errors,
    ) -> Option<Energies> {
        let mut bindings = Vec::new();
        let mut degrees = Vec::new();
        let mut expanded = Vec::new();
        for (k, binding) in self.robot.energies.bindings.iter().enumerate() {
            scope.later.remove(0);
            let checked = scope.resolve(&binding.value, errors).and_then(|resolved| {
                let found = Rules {
                    inference: &mut inference,
                    degrees: &degrees,
                    expanded: &expanded,
                }
                .check(Statement::Binding(k), &resolved);
                self.report(found, errors)
                    .map(|found| (resolved.value, found))
            })?;
            let (value, found) = checked;
            inference.bindings.push(found.dimensions);
            degrees.push(found.degree);
            expanded.push(found.polynomial);
            scope.bindings.push(binding.name.to_string());
            bindings.push(Binding {
                name: binding.name.to_string(),
                value,
            });
        }
        let mut energy =
            |statement: Statement, expr: &ast::Expr, degree: u32, errors: &mut Errors| {
                let resolved = scope.resolve(expr, errors)?;
                let found = Rules {
                    inference: &mut inference,
                    degrees: &degrees,
                    expanded: &expanded,
                }
                .energy(statement, &resolved, degree);
                let found = self.report(found, errors)?;
                Some((resolved.value, found))
            };
        let kinetic = energy(Statement::Kinetic, self.kinetic?, 2, errors);
        let potential = energy(Statement::Potential, self.potential?, 0, errors);
        let points = self.check_points(&scope, &mut inference, &degrees, &expanded, errors);
        let ((kinetic, moving), (potential, resting)) = (kinetic?, potential?);
        Some(Energies {
            parameters,
            bindings,
            kinetic,
            potential,
            monomials: monomials::monomials(&moving, &resting),
            points: points?,
        })
    }

    fn check_points(
        &self,
        scope: &Scope,
        inference: &mut Inference,
        degrees: &[rates::Degree],
        expanded: &[Polynomial<Coefficient>],
        errors: &mut Errors,
    ) -> Option<Vec<Point>> {
        let mut points = Vec::new();
        for (k, point) in self.robot.energies.points.iter().enumerate() {
            if point.value.len() != 3 {
                errors.push(
                    Diagnostic::new(
                        point.name.span(),
                        format!(
                            "point `{}` has {} coordinates",
                            point.name,
                            point.value.len()
                        ),
                        "not three",
                    )
                    .help("write `point name = [x, y, z];`"),
                );
                return None;
            }
            let mut position = Vec::new();
            for (axis, expr) in point.value.iter().enumerate() {
                let resolved = scope.resolve(expr, errors)?;
                let found = Rules {
                    inference: &mut *inference,
                    degrees,
                    expanded,
                }
                .place(Statement::Point(k, axis), &resolved);
                self.report(found, errors)?;
                position.push(resolved.value);
            }
            points.push(Point {
                name: point.name.to_string(),
                position: position.try_into().ok()?,
            });
        }
        Some(points)
    }

    fn report<T>(&self, found: Checked<T>, errors: &mut Errors) -> Option<T> {
        found
            .map_err(|fault| {
                let expr = self.expression(fault.statement);
                let mut error =
                    Diagnostic::new(expr.at(&fault.path).span, fault.message, fault.label);
                if let Some((path, label)) = fault.other {
                    error = error.also(expr.at(&path).span, label);
                }
                errors.push(error.help(fault.help));
            })
            .ok()
    }

    fn expression(&self, statement: Statement) -> &'a ast::Expr {
        let present = "only checked where it is there";
        match statement {
            Statement::Binding(k) => &self.robot.energies.bindings[k].value,
            Statement::Kinetic => self.kinetic.expect(present),
            Statement::Potential => self.potential.expect(present),
            Statement::Point(k, axis) => &self.robot.energies.points[k].value[axis],
        }
    }
}
