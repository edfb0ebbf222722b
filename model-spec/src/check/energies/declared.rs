//! What energies are made of: coordinates with their limits, parameters and constants with their units.

use proc_macro2::Span;
use syn::Ident;

use super::dimension::{Dimensions, Inference};
use super::resolve::Constant;
use crate::ast::{self, BinaryOp, ExprKind, Robot};
use crate::check::chain::{Gain, check_gain, check_limits, check_number};
use crate::check::setting::Settings;
use crate::check::unit::{self, Dimension};
use crate::check::value::Quantity;
use crate::check::{Errors, value};
use crate::diagnostic::Diagnostic;
use crate::model::{Joint, JointKind, Limits, Parameter};
use crate::suggest;

/// Written out, an energy of a chain of so many links has more terms than anybody would write.
const MOST_COORDINATES: usize = 24;

pub(super) fn check_coordinates(robot: &Robot, errors: &mut Errors) -> Vec<Joint> {
    let energies = &robot.energies;
    if energies.coordinates.is_empty() {
        errors.push(
            Diagnostic::new(robot.name.span(), "the robot has no coordinates", "").help(
                "write `coordinates th1, th2;`; a length is `x: m`, everything else an angle",
            ),
        );
    }
    check_number(
        energies.coordinates.iter().map(|c| &c.name),
        MOST_COORDINATES,
        "coordinates",
        errors,
    );
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
        let dimension = unit_of(&coordinate.name, unit)
            .map_err(|error| errors.push(error))
            .ok()?
            .dimension;
        match dimension {
            Some(d) if d == Dimension::LENGTH => Some(JointKind::Prismatic),
            Some(d) if d == Dimension::ANGLE => Some(JointKind::Revolute),
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
    let (limits, gain) = own.map_or((Limits::default(), Gain::NONE), |own| {
        let owner = format!("`limits {}`", own.name);
        let keys = [
            "position",
            "velocity",
            "acceleration",
            "torque",
            "actuator_gain",
        ];
        let settings = Settings::new(&own.settings, &owner, &keys, errors);
        (
            check_limits(&settings, kind, errors),
            check_gain(&settings, kind, errors),
        )
    });
    Joint {
        name: coordinate.name.to_string(),
        kind,
        limits,
        actuator_gain: gain.value,
        actuator_gain_unit: gain.unit,
        line: coordinate.name.span().start().line,
    }
}

pub(super) fn check_parameters(
    robot: &Robot,
    inference: &mut Inference,
    errors: &mut Errors,
) -> Vec<Parameter> {
    let mut parameters = Vec::new();
    for parameter in &robot.energies.parameters {
        let mut found = |quantity: Result<Quantity, Diagnostic>| {
            quantity.map_err(|error| errors.push(error)).ok()
        };
        let unit = parameter.unit.as_ref();
        let unit = unit.map(|unit| unit_of(&parameter.name, unit));
        let unit = unit.and_then(&mut found);
        let help = "write its value in numbers, or use a `let` if it depends on other names";
        let nominal = parameter.nominal.as_ref();
        let nominal = nominal.map(|expr| number_of(expr, robot, help));
        let nominal = nominal.and_then(&mut found);
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

/// The unit behind a declared name. It says a dimension: logs, parameter files and results are in SI units, so one with a scale
/// would be believed and not obeyed.
fn unit_of(name: &Ident, unit: &ast::Expr) -> Result<Quantity, Diagnostic> {
    let quantity = value::constant(unit)?;
    #[expect(clippy::float_cmp, reason = "the scale of SI units is exactly one")]
    if quantity.value == 1.0 {
        return Ok(quantity);
    }
    let si = quantity.dimension.unwrap_or(Dimension::NONE).in_si();
    let help = if si.is_empty() {
        "write the name alone".to_owned()
    } else {
        format!("write `{name}: {si}`")
    };
    Err(Diagnostic::new(
        unit.span,
        format!("the unit of `{name}` is not an SI unit: logs, parameter files and results are in SI units"),
        format!("is {} {si}", quantity.value),
    )
    .help(help))
}

/// A number with its unit. Names of the robot have no place in it; behind a quantity, as in `5 N/m`, a name is a unit
/// whatever else it is called.
fn number_of(expr: &ast::Expr, robot: &Robot, help: &str) -> Result<Quantity, Diagnostic> {
    let energies = &robot.energies;
    let is_declared = |name: &Ident| {
        let mut names = energies
            .constants
            .iter()
            .map(|constant| &constant.name)
            .chain(energies.parameters.iter().map(|p| &p.name))
            .chain(energies.coordinates.iter().map(|c| &c.name))
            .chain(energies.bindings.iter().map(|b| &b.name));
        names.any(|declared| declared == name)
    };
    let Some(name) = name_in(expr, &is_declared) else {
        return value::constant(expr);
    };
    Err(Diagnostic::new(
        name.span(),
        format!("expected a number, found `{name}`"),
        "a name of the robot",
    )
    .help(help))
}

/// The first name that `wanted` knows and that is not the unit of a quantity.
fn name_in<'a>(expr: &'a ast::Expr, wanted: &dyn Fn(&Ident) -> bool) -> Option<&'a Ident> {
    match &expr.kind {
        ExprKind::Number(..) | ExprKind::Choice(..) => None,
        ExprKind::Name(name) => wanted(name).then_some(name),
        ExprKind::Call(_, arguments) => arguments.iter().find_map(|x| name_in(x, wanted)),
        ExprKind::Neg(x) => name_in(x, wanted),
        ExprKind::Binary(_, x, y) => {
            let behind = if is_quantity(expr) { None } else { Some(y) };
            name_in(x, wanted).or_else(|| name_in(behind?, wanted))
        }
    }
}

/// `5 N`, `5 N/m`, `0.3 kg*m^2`
fn is_quantity(expr: &ast::Expr) -> bool {
    let is_unit = |unit: &ast::Expr| {
        let base = match &unit.kind {
            ExprKind::Binary(BinaryOp::Pow, base, _) => base,
            _ => unit,
        };
        matches!(&base.kind, ExprKind::Name(name) if unit::find(&name.to_string()).is_some())
    };
    match &expr.kind {
        ExprKind::Number(_, unit) => unit.is_some(),
        ExprKind::Binary(BinaryOp::Mul | BinaryOp::Div, x, y) => is_quantity(x) && is_unit(y),
        _ => false,
    }
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
    .help("write the value in the unit after the name, or remove that unit")
}

pub(super) fn check_constants(
    robot: &Robot,
    inference: &mut Inference,
    errors: &mut Errors,
) -> Vec<Constant> {
    let mut constants = Vec::new();
    for constant in &robot.energies.constants {
        let name = &constant.name;
        let help = format!("write `let {name} = ..;`: a `let` may use other names");
        match number_of(&constant.value, robot, &help) {
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
