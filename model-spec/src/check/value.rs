//! Constant expressions to numbers in SI units, with their dimension checked.

use proc_macro2::Span;
use syn::Ident;

use super::size;
use super::unit::{self, Dimension};
use crate::ast::{BinaryOp, Expr, ExprKind, Unit, Value};
use crate::diagnostic::Diagnostic;
use crate::model::Function;
use crate::suggest;

pub(super) type Checked<T> = Result<T, Diagnostic>;

/// A number in SI units. A bare number has no dimension of its own and takes the one that is expected.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quantity {
    pub(super) value: f64,
    pub(super) dimension: Option<Dimension>,
}

/// A word such as `standard_dh`.
pub(super) fn word(value: &Value) -> Option<String> {
    match value {
        Value::Scalar(Expr {
            kind: ExprKind::Name(name),
            ..
        }) => Some(name.to_string()),
        _ => None,
    }
}

/// One number of the expected dimension.
pub(super) fn scalar(value: &Value, expected: Dimension) -> Checked<f64> {
    in_dimension(single(value)?, expected)
}

/// One number of any dimension.
pub(super) fn any_scalar(value: &Value) -> Checked<f64> {
    Ok(quantity(value)?.value)
}

/// One number with its dimension.
pub(super) fn quantity(value: &Value) -> Checked<Quantity> {
    constant(single(value)?)
}

fn single(value: &Value) -> Checked<&Expr> {
    match value {
        Value::Scalar(expr) => Ok(expr),
        _ => Err(shape_of(value.span(), "one number", describe(value))),
    }
}

/// What a right-hand side is, in messages.
fn describe(value: &Value) -> &'static str {
    match value {
        Value::Scalar(Expr {
            kind: ExprKind::Name(_),
            ..
        }) => "a word",
        Value::Scalar(_) => "one number",
        Value::List(..) => "a list",
        Value::Range(..) => "a range",
    }
}

/// `N` numbers in brackets.
pub(super) fn vector<const N: usize>(value: &Value, expected: Dimension) -> Checked<[f64; N]> {
    let Value::List(items, span) = value else {
        return Err(shape_of(
            value.span(),
            &format!("{N} numbers in brackets"),
            describe(value),
        ));
    };
    if items.len() != N {
        return Err(shape_of(
            *span,
            &format!("{N} numbers in brackets"),
            &format!("{} numbers", items.len()),
        ));
    }
    let mut numbers = [0.0; N];
    for (number, item) in numbers.iter_mut().zip(items) {
        *number = in_dimension(item, expected)?;
    }
    Ok(numbers)
}

/// `low .. high`, the lower end first.
pub(super) fn range(value: &Value, expected: Dimension) -> Checked<(f64, f64)> {
    let Value::Range(low, high) = value else {
        return Err(shape_of(
            value.span(),
            "a range `low .. high`",
            describe(value),
        ));
    };
    let ends = (in_dimension(low, expected)?, in_dimension(high, expected)?);
    check_order(low, high, ends)?;
    Ok(ends)
}

/// The lower end of a range comes first.
pub(super) fn check_order(low: &Expr, high: &Expr, ends: (f64, f64)) -> Checked<()> {
    if ends.0 < ends.1 {
        return Ok(());
    }
    let span = crate::ast::join(low.span, high.span);
    let [first, second] = [(low, ends.0), (high, ends.1)].map(|(expr, end)| as_written(expr, end));
    Err(if ends.0 > ends.1 {
        let label = format!("`{first}` is above `{second}`");
        let help = format!("write the lower end first: `{second} .. {first}`");
        Diagnostic::new(span, "the range is empty", label).help(help)
    } else {
        let label = format!("both ends are `{first}`");
        Diagnostic::new(span, "the range is empty", label)
            .help("write a lower end and another above it")
    })
}

/// An expression in the units in which it is written; where its text is out of reach, its value in SI units.
fn as_written(expr: &Expr, value: f64) -> String {
    let text = expr.span.source_text();
    text.unwrap_or_else(|| value.to_string())
}

#[track_caller]
fn shape_of(span: Span, expected: &str, found: &str) -> Diagnostic {
    Diagnostic::new(span, format!("expected {expected}, found {found}"), "")
        .help(format!("write {expected}"))
}

/// The number of the expected dimension that an expression is.
pub(super) fn in_dimension(expr: &Expr, expected: Dimension) -> Checked<f64> {
    let quantity = constant(expr)?;
    match quantity.dimension {
        Some(found) if found != expected => Err(Diagnostic::new(
            expr.span,
            format!(
                "expected {}, found {}",
                expected.describe(),
                found.describe()
            ),
            format!("this is {}", found.describe()),
        )
        .help(format!(
            "write it in {}; a bare number is in SI units",
            expected.units()
        ))),
        found => {
            size::check(quantity.value, expected, found.is_none(), expr.span)?;
            Ok(quantity.value)
        }
    }
}

/// The value of an expression without parameters or signals.
pub(super) fn constant(expr: &Expr) -> Checked<Quantity> {
    let quantity = evaluate(expr)?;
    if quantity.value.is_finite() {
        if crate::transform::is_in_range(quantity.value) {
            return Ok(quantity);
        }
        return Err(Diagnostic::new(
            expr.span,
            "this value is too large or too small to compute with",
            format!("comes out as {:e}", quantity.value),
        )
        .help("write zero, or a value between 1e-30 and 1e30 in SI units"));
    }
    Err(Diagnostic::new(
        expr.span,
        "the value is not a finite number",
        format!("comes out as {}", quantity.value),
    )
    .help("do not divide by zero, and stay below 1e30"))
}

fn evaluate(expr: &Expr) -> Checked<Quantity> {
    match &expr.kind {
        ExprKind::Number(value, None) => Ok(Quantity {
            value: *value,
            dimension: None,
        }),
        ExprKind::Number(value, Some(unit)) => {
            let (factor, dimension) = find_unit(&unit.name)?;
            Ok(Quantity {
                value: in_unit(*value, factor, unit),
                dimension: Some(dimension.power(unit.exponent)),
            })
        }
        ExprKind::Name(name) => constant_name(name),
        ExprKind::Call(name, arguments) => call(name, arguments, expr.span),
        ExprKind::Neg(inner) => evaluate(inner).map(|q| Quantity {
            value: -q.value,
            ..q
        }),
        ExprKind::Binary(op, left, right) => binary(*op, evaluate(left)?, evaluate(right)?, expr),
        ExprKind::Choice(..) => Err(Diagnostic::new(
            expr.span,
            "an `if` is not allowed in a number",
            "belongs in an effect's equations",
        )
        .help("write the value itself")),
    }
}

/// Degrees are scaled as `value / 180 * pi` so that 90 deg is the double nearest to a quarter turn.
fn in_unit(value: f64, factor: f64, unit: &Unit) -> f64 {
    if unit.name == "deg" && unit.exponent == 1 {
        value / 180.0 * std::f64::consts::PI
    } else {
        value * factor.powi(unit.exponent)
    }
}

/// The unit behind a number.
pub(super) fn find_unit(unit: &Ident) -> Checked<(f64, Dimension)> {
    let name = unit.to_string();
    unit::find(&name).ok_or_else(|| {
        // Two letters look alike: the sign of micro, and the Greek letter.
        if let Some(rest) = name.strip_prefix(['\u{b5}', '\u{3bc}'])
            && unit::find(&format!("u{rest}")).is_some()
        {
            return Diagnostic::new(unit.span(), format!("unknown unit `{name}`"), "not a unit")
                .help(format!("write `u{rest}`"));
        }
        Diagnostic::new(unit.span(), format!("unknown unit `{name}`"), "not a unit").help(
            suggest::help(&name, unit::UNITS.iter().map(|(unit, ..)| *unit)),
        )
    })
}

/// A word behind a number where that word is a name that the expression may use: `0.5 m*l^2` with a parameter `m` is half a
/// meter to the letter, and half of `m` to the reader.
pub(super) fn unit_or_name(
    expr: &Expr,
    literal: f64,
    unit: &Unit,
    meant: &str,
    otherwise: &str,
) -> Diagnostic {
    let name = &unit.name;
    let power = match unit.exponent {
        1 => String::new(),
        exponent => format!("^{exponent}"),
    };
    let otherwise = match unit::find(&name.to_string()) {
        Some(_) => format!("; {otherwise}"),
        None => String::new(),
    };
    Diagnostic::new(
        expr.span,
        format!("`{name}` is a name here, but after a number it would be a unit"),
        format!("a unit, or the {meant}?"),
    )
    .help(format!(
        "write `{literal}*{name}{power}` for the {meant}{otherwise}"
    ))
}

/// `pi`, or a unit alone as in `m/s^2`.
fn constant_name(name: &Ident) -> Checked<Quantity> {
    let text = name.to_string();
    if text == "pi" {
        return Ok(Quantity {
            value: std::f64::consts::PI,
            dimension: None,
        });
    }
    unit::find(&text)
        .map(|(value, dimension)| Quantity {
            value,
            dimension: Some(dimension),
        })
        .ok_or_else(|| {
            Diagnostic::new(
                name.span(),
                format!("expected a number, found `{text}`"),
                "neither a number nor a unit",
            )
            .help(
                match suggest::nearest(&text, unit::UNITS.map(|(unit, ..)| unit)) {
                    Some(unit) => format!("write `{unit}`"),
                    None => "write a number, such as `0.3`, `90 deg` or `pi/2`".to_owned(),
                },
            )
        })
}

fn call(name: &Ident, arguments: &[Expr], span: Span) -> Checked<Quantity> {
    let function = super::words::function(name)?;
    let [argument] = arguments else {
        return Err(super::words::one_argument(name, arguments.len(), span));
    };
    let x = evaluate(argument)?;
    let value = function.apply(x.value);
    let keeps = function == Function::Abs;
    let takes_angle =
        matches!(function, Function::Sin | Function::Cos) && x.dimension == Some(Dimension::ANGLE);
    match x.dimension {
        None => Ok(Quantity {
            value,
            dimension: None,
        }),
        Some(_) if keeps => Ok(Quantity { value, ..x }),
        Some(_) if takes_angle => Ok(Quantity {
            value,
            dimension: None,
        }),
        Some(found) => Err(Diagnostic::new(
            argument.span,
            format!("`{name}` takes a plain number, found {}", found.describe()),
            "has a unit",
        )
        .help("divide by the unit first")),
    }
}

fn binary(op: BinaryOp, left: Quantity, right: Quantity, expr: &Expr) -> Checked<Quantity> {
    let dimension = match op {
        BinaryOp::Add | BinaryOp::Sub => match (left.dimension, right.dimension) {
            (Some(l), Some(r)) if l != r => {
                return Err(Diagnostic::new(
                    expr.span,
                    format!("{} and {} cannot be added", l.describe(), r.describe()),
                    "different dimensions",
                )
                .help("write both in units of one kind"));
            }
            (l, r) => l.or(r),
        },
        BinaryOp::Mul => product(left, right, 1),
        BinaryOp::Div => product(left, right, -1),
        BinaryOp::Pow => match (left.dimension, right.dimension) {
            (None, None) => None,
            (Some(dimension), None) => Some(dimension.power(small_integer(right.value, expr)?)),
            (_, Some(found)) => {
                return Err(Diagnostic::new(
                    expr.span,
                    format!(
                        "an exponent must be a plain number, found {}",
                        found.describe()
                    ),
                    "the exponent has a unit",
                )
                .help("remove the unit from the exponent"));
            }
        },
    };
    Ok(Quantity {
        value: op.apply(left.value, right.value),
        dimension: dimension.filter(|dimension| *dimension != Dimension::NONE),
    })
}

fn product(left: Quantity, right: Quantity, sign: i32) -> Option<Dimension> {
    if left.dimension.is_none() && right.dimension.is_none() {
        return None;
    }
    let left = left.dimension.unwrap_or(Dimension::NONE);
    Some(left.times(right.dimension.unwrap_or(Dimension::NONE), sign))
}

/// Exponent of a quantity with a unit.
fn small_integer(exponent: f64, expr: &Expr) -> Checked<i32> {
    let found = (-6..=6).find(|k| (f64::from(*k) - exponent).abs() < 1e-12);
    found.ok_or_else(|| {
        Diagnostic::new(
            expr.span,
            "a quantity with a unit needs a small whole exponent",
            format!("exponent {exponent}"),
        )
        .help("compute the power of the number, and write the unit after the result")
    })
}
