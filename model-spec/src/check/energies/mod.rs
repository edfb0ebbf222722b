//! Robots that say their energies: names, dimensions, degrees, and the products of parameters that torques are linear in.

mod dimension;
mod monomials;
mod rates;
mod resolve;

use proc_macro2::Span;
use syn::Ident;

use super::chain::{check_gain, check_limits};
use super::resolve::is_reserved;
use super::setting::Settings;
use super::{Errors, check_unique, value};
use crate::ast::{self, Robot, Value};
use crate::diagnostic::Diagnostic;
use crate::model::{Binding, Energies, Joint, JointKind, Limits, Parameter, Point};
use crate::polynomial::Polynomial;
use crate::suggest;
use dimension::{Dimensions, Inference};
use resolve::{Constant, Resolved, Scope};

/// A rule of energies that an expression breaks, before its place in the text is known.
struct Fault {
    statement: Statement,
    /// Operands from the whole expression to the offending part.
    path: Vec<usize>,
    message: String,
    label: String,
    /// A second part that the message is about.
    other: Option<(Vec<usize>, String)>,
    help: String,
}

/// Boxed: rules are passed far more often than broken.
type Checked<T> = Result<T, Box<Fault>>;

/// Which expression of the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Statement {
    /// A `let`, by its index.
    Binding(usize),
    /// `kinetic = ..;`
    Kinetic,
    /// `potential = ..;`
    Potential,
    /// A coordinate of a point.
    Point(usize, usize),
}

/// The settings that a robot has which says its energies.
pub(super) const SETTINGS: [&str; 2] = ["kinetic", "potential"];

/// Whether the robot is described by its energies.
pub(super) fn says_energies(robot: &Robot) -> bool {
    let energies = &robot.energies;
    !energies.coordinates.is_empty()
        || !energies.parameters.is_empty()
        || !energies.constants.is_empty()
        || !energies.bindings.is_empty()
        || !energies.points.is_empty()
        || !energies.limits.is_empty()
        || robot
            .settings
            .iter()
            .any(|s| SETTINGS.contains(&s.key.to_string().as_str()))
}

/// The coordinates and the energies; `None` behind an error.
pub(super) fn check_energies(
    robot: &Robot,
    settings: &Settings,
    errors: &mut Errors,
) -> Option<(Vec<Joint>, Energies)> {
    let before = errors.len();
    check_not_a_chain(robot, errors);
    check_names(robot, errors);
    let joints = check_coordinates(robot, errors);
    let kinds: Vec<JointKind> = joints.iter().map(|joint| joint.kind).collect();
    let mut inference = Inference::new(&kinds);
    let parameters = check_parameters(robot, &mut inference, errors);
    let constants = check_constants(robot, &mut inference, errors);
    let energies = Written {
        robot,
        kinetic: check_present(robot, settings, "kinetic", errors),
        potential: check_present(robot, settings, "potential", errors),
    };
    if errors.len() > before {
        return None;
    }
    let scope = Scope {
        coordinates: joints.iter().map(|joint| joint.name.clone()).collect(),
        parameters: parameters.iter().map(|p| p.name.clone()).collect(),
        constants,
        bindings: Vec::new(),
        later: robot
            .energies
            .bindings
            .iter()
            .map(|b| b.name.to_string())
            .collect(),
    };
    let energies = energies.check(scope, inference, parameters, errors)?;
    check_used(robot, &energies, errors);
    (errors.len() == before).then_some((joints, energies))
}

/// A robot is a chain or says its energies, not both.
fn check_not_a_chain(robot: &Robot, errors: &mut Errors) {
    let joint = robot.joints.first().map(|joint| &joint.name);
    let link = robot.links.first().map(|link| &link.name);
    let setting = |key: &str| robot.settings.iter().map(|s| &s.key).find(|k| *k == key);
    let chain = joint
        .or(link)
        .or(setting("convention"))
        .or(setting("gravity"));
    if let Some(chain) = chain {
        errors.push(
            Diagnostic::new(
                chain.span(),
                format!("robot `{}` says its energies and is a chain too", robot.name),
                "belongs to a chain",
            )
            .help(
                "describe the arm by joints and links, or by `coordinates`, `kinetic` and `potential`; gravity of energies is a \
                 constant of yours, such as `constants g = 9.81 m/s^2;`",
            ),
        );
    }
}

/// All names of the robot share one scope.
fn check_names(robot: &Robot, errors: &mut Errors) {
    let energies = &robot.energies;
    let names = || {
        let coordinates = energies.coordinates.iter().map(|c| &c.name);
        coordinates
            .chain(energies.parameters.iter().map(|p| &p.name))
            .chain(energies.constants.iter().map(|c| &c.name))
            .chain(energies.bindings.iter().map(|b| &b.name))
    };
    check_unique(names(), "name", errors);
    check_unique(energies.points.iter().map(|p| &p.name), "point", errors);
    check_unique(energies.limits.iter().map(|l| &l.name), "limits of", errors);
    let meant = |name: &&Ident| {
        let text = name.to_string();
        is_reserved(&text) || text == "dot" || text == "all" || text == "known"
    };
    for name in names().filter(meant) {
        errors.push(
            Diagnostic::new(
                name.span(),
                format!("`{name}` has a meaning in the language"),
                "reserved",
            )
            .help("choose another name"),
        );
    }
}

fn check_coordinates(robot: &Robot, errors: &mut Errors) -> Vec<Joint> {
    let energies = &robot.energies;
    if energies.coordinates.is_empty() {
        errors.push(
            Diagnostic::new(robot.name.span(), "the robot has no coordinates", "").help(
                "write `coordinates th1, th2;`; a length is `x: m`, everything else an angle",
            ),
        );
    }
    for limits in &energies.limits {
        let known = || energies.coordinates.iter().map(|c| c.name.to_string());
        let name = limits.name.to_string();
        if !known().any(|k| k == name) {
            let names: Vec<String> = known().collect();
            errors.push(
                Diagnostic::new(
                    limits.name.span(),
                    format!("the robot has no coordinate `{name}`"),
                    "unknown coordinate",
                )
                .help(suggest::help(&name, names.iter().map(String::as_str))),
            );
        }
    }
    energies
        .coordinates
        .iter()
        .map(|coordinate| check_coordinate(coordinate, &energies.limits, errors))
        .collect()
}

fn check_coordinate(
    coordinate: &ast::Coordinate,
    limits: &[ast::Limits],
    errors: &mut Errors,
) -> Joint {
    let kind = coordinate.unit.as_ref().and_then(|unit| {
        let dimension = value::constant(unit)
            .map_err(|error| errors.push(error))
            .ok()?
            .dimension;
        match dimension {
            Some(d) if d == super::unit::Dimension::LENGTH => Some(JointKind::Prismatic),
            Some(d) if d == super::unit::Dimension::ANGLE => Some(JointKind::Revolute),
            _ => {
                errors.push(
                    Diagnostic::new(
                        unit.span,
                        format!(
                            "coordinate `{}` is neither an angle nor a length",
                            coordinate.name
                        ),
                        "neither",
                    )
                    .help("write `x: m` for a length, or no unit for an angle"),
                );
                None
            }
        }
    });
    let kind = kind.unwrap_or(JointKind::Revolute);
    let own = limits.iter().find(|limits| limits.name == coordinate.name);
    let (limits, actuator_gain) = own.map_or((Limits::default(), 1.0), |own| {
        let owner = format!("`limits {}`", own.name);
        let keys = ["position", "velocity", "torque", "actuator_gain"];
        let settings = Settings::new(&own.settings, &owner, &keys, errors);
        (
            check_limits(&settings, kind, errors),
            check_gain(&settings, errors),
        )
    });
    Joint {
        name: coordinate.name.to_string(),
        kind,
        limits,
        actuator_gain,
        line: coordinate.name.span().start().line,
    }
}

fn check_parameters(
    robot: &Robot,
    inference: &mut Inference,
    errors: &mut Errors,
) -> Vec<Parameter> {
    let mut parameters = Vec::new();
    for parameter in &robot.energies.parameters {
        let mut quantity = |expr: &ast::Expr| {
            value::constant(expr)
                .map_err(|error| errors.push(error))
                .ok()
        };
        let unit = parameter.unit.as_ref().and_then(&mut quantity);
        let nominal = parameter.nominal.as_ref().and_then(&mut quantity);
        let written = nominal.and_then(|nominal| nominal.dimension);
        let dimensions = match (unit, written) {
            (Some(unit), Some(written)) if unit.dimension != Some(written) => {
                errors.push(two_dimensions(parameter, &written.describe()));
                inference.unknown()
            }
            (Some(unit), _) => unit.dimension.map(Dimensions::of).unwrap_or_default(),
            (None, Some(written)) => Dimensions::of(written),
            (None, None) => inference.unknown(),
        };
        inference.parameters.push(dimensions);
        parameters.push(Parameter {
            name: parameter.name.to_string(),
            doc: parameter.doc.clone(),
            nominal: nominal.map(|nominal| nominal.value),
        });
    }
    parameters
}

fn two_dimensions(parameter: &ast::Parameter, found: &str) -> Diagnostic {
    let place = parameter
        .nominal
        .as_ref()
        .map_or_else(Span::call_site, |n| n.span);
    Diagnostic::new(
        place,
        format!("the value of `{}` does not have its unit", parameter.name),
        format!("this is {found}"),
    )
    .help("write the value in the unit behind the name, or leave that unit away")
}

fn check_constants(robot: &Robot, inference: &mut Inference, errors: &mut Errors) -> Vec<Constant> {
    let mut constants = Vec::new();
    for constant in &robot.energies.constants {
        match value::constant(&constant.value) {
            Ok(quantity) => constants.push(Constant {
                name: constant.name.to_string(),
                value: quantity.value,
                dimensions: match quantity.dimension {
                    Some(dimension) => Dimensions::of(dimension),
                    None => inference.unknown(),
                },
            }),
            Err(error) => errors.push(error),
        }
    }
    constants
}

fn check_present<'a>(
    robot: &Robot,
    settings: &Settings<'a>,
    key: &str,
    errors: &mut Errors,
) -> Option<&'a ast::Expr> {
    match settings.get(key) {
        Some(Value::Scalar(expr)) => Some(expr),
        Some(other) => {
            errors.push(
                Diagnostic::new(other.span(), format!("`{key}` is one expression"), "").help(
                    format!("write `{key} = ..;` in coordinates, rates `dot(..)` and parameters"),
                ),
            );
            None
        }
        None => {
            errors.push(
                Diagnostic::new(
                    robot.name.span(),
                    format!("the robot does not say its {key} energy"),
                    format!("no `{key}`"),
                )
                .help(format!(
                    "write `{key} = ..;`, in joules; 0 where there is none"
                )),
            );
            None
        }
    }
}

/// What a robot that says its energies has written, name checks passed.
struct Written<'a> {
    robot: &'a Robot,
    kinetic: Option<&'a ast::Expr>,
    potential: Option<&'a ast::Expr>,
}

impl<'a> Written<'a> {
    fn check(
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
        expanded: &[Polynomial<monomials::Coefficient>],
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

/// What the rules find of one statement.
struct Found {
    dimensions: Dimensions,
    degree: rates::Degree,
    polynomial: Polynomial<monomials::Coefficient>,
}

/// The rules of expressions, with what is known of the bindings.
struct Rules<'a> {
    inference: &'a mut Inference,
    degrees: &'a [rates::Degree],
    expanded: &'a [Polynomial<monomials::Coefficient>],
}

impl Rules<'_> {
    fn check(&mut self, statement: Statement, resolved: &Resolved) -> Checked<Found> {
        Ok(Found {
            dimensions: self
                .inference
                .infer(statement, &resolved.value, &resolved.constants)?,
            degree: rates::degree(statement, &resolved.value, self.degrees)?,
            polynomial: monomials::expand(statement, &resolved.value, self.expanded)?,
        })
    }

    fn energy(
        &mut self,
        statement: Statement,
        resolved: &Resolved,
        degree: u32,
    ) -> Checked<Polynomial<monomials::Coefficient>> {
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
    fn place(&mut self, statement: Statement, resolved: &Resolved) -> Checked<()> {
        let found = self.check(statement, resolved)?;
        let what = "the position of a point";
        if found.degree.is_some_and(|d| d != 0) {
            return Err(wrong_degree(statement, what, false));
        }
        if !found.polynomial.keys().all(crate::model::Monomial::is_one) {
            return Err(Box::new(Fault {
                statement,
                path: Vec::new(),
                message: "the position of a point has an unknown parameter".to_owned(),
                label: "not known where it is".to_owned(),
                other: None,
                help: "make the lengths constants".to_owned(),
            }));
        }
        self.inference
            .expect(statement, &found.dimensions, [0.0, 1.0, 0.0], what)
    }
}

fn wrong_degree(statement: Statement, what: &str, quadratic: bool) -> Box<Fault> {
    let (message, help) = if quadratic {
        (
            format!("{what} is not quadratic in the rates"),
            "rates are written `dot(q)`; each term has a product of two",
        )
    } else {
        (
            format!("{what} has rates in it"),
            "write it in coordinates alone",
        )
    };
    Box::new(Fault {
        statement,
        path: Vec::new(),
        message,
        label: String::new(),
        other: None,
        help: help.to_owned(),
    })
}

/// What is declared is used.
fn check_used(robot: &Robot, energies: &Energies, errors: &mut Errors) {
    for (k, parameter) in robot.energies.parameters.iter().enumerate() {
        let used = energies
            .monomials
            .iter()
            .any(|monomial| monomial.factors.iter().any(|(index, _)| *index == k));
        if !used {
            errors.push(
                Diagnostic::new(
                    parameter.name.span(),
                    format!(
                        "parameter `{}` has no influence on any torque",
                        parameter.name
                    ),
                    "in no energy that changes",
                )
                .help("use it in an energy, or delete it"),
            );
        }
    }
}
