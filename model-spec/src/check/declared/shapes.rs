//! Values of shape parameters: of the sign that the law wants, in the unit that its doc says.

use proc_macro2::Span;

use crate::ast::{DeclaredEffect, Robot};
use crate::check::setting::Settings;
use crate::check::unit::{self, Dimension};
use crate::check::{Errors, value};
use crate::diagnostic::Diagnostic;
use crate::model::{EffectDefinition, ShapeParameter};

/// One value per shape parameter of the definition, where the declaration gives one.
pub(super) fn check_shapes(
    declared: &DeclaredEffect,
    definition: &EffectDefinition,
    errors: &mut Errors,
) -> Vec<Option<f64>> {
    let names: Vec<&str> = definition
        .shapes
        .iter()
        .map(|shape| shape.name.as_str())
        .collect();
    let owner = format!("effect `{}`", declared.name);
    let settings = if names.is_empty() {
        if let Some(setting) = declared.shapes.first() {
            errors.push(
                Diagnostic::new(
                    setting.key.span(),
                    format!("{owner} has no shape parameters"),
                    "",
                )
                .help(format!(
                    "write `{} on ..;`: linear parameters are identified, not declared",
                    declared.name
                )),
            );
        }
        return Vec::new();
    } else {
        Settings::new(&declared.shapes, &owner, &names, errors)
    };
    let read = |shape: &ShapeParameter| {
        let given = settings.get(&shape.name)?;
        let number = value::any_scalar(given);
        let in_range = number.and_then(|number| {
            let Some(wanted) = shape.misses(number) else {
                return Ok(number);
            };
            Err(Diagnostic::new(
                given.span(),
                format!("`{}` of {owner} is not {wanted}", shape.name),
                format!("is {number}"),
            )
            .help(format!(
                "write {wanted}; without a value it is identified within {} .. {}",
                shape.low, shape.high
            )))
        });
        Some(in_range)
    };
    let values: Vec<Option<Result<f64, Diagnostic>>> = definition.shapes.iter().map(read).collect();
    values
        .into_iter()
        .map(|value| value?.map_err(|error| errors.push(error)).ok())
        .collect()
}

/// Units behind values: those of the quantity that the parameter's doc says, on each of the joints. Where it says none a unit would be
/// taken on trust.
pub(super) fn check_units(
    robot: &Robot,
    declared: &DeclaredEffect,
    definition: &EffectDefinition,
    targets: &[(Vec<usize>, Span)],
    errors: &mut Errors,
) {
    for setting in &declared.shapes {
        let mut shapes = definition.shapes.iter();
        let Some(shape) = shapes.find(|shape| setting.key == shape.name) else {
            continue;
        };
        let Ok(value::Quantity {
            value: number,
            dimension: Some(found),
        }) = value::quantity(&setting.value)
        else {
            continue;
        };
        let Some(said) = Said::of(&shape.doc) else {
            if found != Dimension::NONE {
                errors.push(without_unit(declared, shape, setting.value.span(), number));
            }
            continue;
        };
        let misses = targets.iter().find_map(|(joints, _)| {
            let wanted = said.on(robot, joints);
            (!wanted.contains(&found)).then_some(wanted[0])
        });
        if let Some(Err(error)) = misses.map(|wanted| value::scalar(&setting.value, wanted)) {
            errors.push(error);
        }
    }
}

fn without_unit(
    declared: &DeclaredEffect,
    shape: &ShapeParameter,
    span: Span,
    number: f64,
) -> Diagnostic {
    let name = &shape.name;
    Diagnostic::new(
        span,
        format!(
            "`{name}` of effect `{}` has no unit in its definition",
            declared.name
        ),
        "has a unit",
    )
    .help(format!(
        "write the number alone, in SI units: `{name} = {number}`; values may have a unit only if the shape's comment ends in one, such as `, rad/s.`"
    ))
}

/// The quantity that the doc of a shape says, in the words of the standard effects: `Stribeck speed, rad/s (m/s for a prismatic joint).`
struct Said {
    revolute: Dimension,
    prismatic: Option<Dimension>,
}

impl Said {
    fn of(doc: &str) -> Option<Self> {
        let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
        let mut places = std::iter::once(0).chain(doc.match_indices(", ").map(|(at, _)| at + 2));
        places.find_map(|start| {
            let piece = &doc[start..];
            let end = piece.find(['(', ',', '.', ';']).unwrap_or(piece.len());
            let words = piece[..end].split(" since ").next()?;
            let of_slide = piece[end..].strip_prefix('(').and_then(|rest| {
                let (words, _) = rest.split_once(" for a prismatic joint)")?;
                quantity(words)
            });
            Some(Self {
                revolute: quantity(words)?,
                prismatic: of_slide,
            })
        })
    }

    /// Quantities that a value may be of on some joints. Kinds of coordinates are none of the text's.
    fn on(&self, robot: &Robot, joints: &[usize]) -> Vec<Dimension> {
        let slide = self.prismatic.unwrap_or(self.revolute);
        if joints.is_empty() {
            return vec![self.revolute];
        }
        let each = joints.iter().map(|&joint| match robot.joints.get(joint) {
            Some(joint) if joint.kind == "prismatic" => vec![slide],
            Some(_) => vec![self.revolute],
            None => vec![self.revolute, slide],
        });
        each.flatten().collect()
    }
}

/// `N m s/rad`: factors of units, with what is divided by behind a slash.
fn quantity(words: &str) -> Option<Dimension> {
    if words == "Seconds" {
        return Some(Dimension::TIME);
    }
    let mut product = None;
    for word in words.split_whitespace() {
        for (place, factor) in word.split('/').enumerate() {
            let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
            let dimension = match name {
                "1" => Dimension::NONE,
                name => unit::find(name)?.1.power(power.parse().ok()?),
            };
            let sign = if place == 0 { 1 } else { -1 };
            let before = product.unwrap_or(Dimension::NONE);
            product = Some(before.times(dimension, sign));
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn docs_say_quantities() {
        let said = |doc: &str| Said::of(doc).map(|said| (said.revolute, said.prismatic));
        let speeds = Some((Dimension::ANGULAR_SPEED, Some(Dimension::SPEED)));
        assert_eq!(
            said("Stribeck speed, rad/s (m/s for a\nprismatic joint)."),
            speeds
        );
        let stiffness = Dimension::TORQUE.times(Dimension::ANGLE, -1);
        let found = said("N m/rad (N/m for a prismatic joint).").expect("a stiffness");
        assert_eq!(found.0, stiffness);
        let time = Some((Dimension::TIME, None));
        assert_eq!(said("When it begins, s since the start of the log."), time);
        assert_eq!(
            said("Seconds; negative where the torque comes early."),
            time
        );
        assert_eq!(
            said("Half the width, of the gap, rad"),
            Some((Dimension::ANGLE, None))
        );
        for doc in [
            "",
            "A share of the excess.",
            "Periods per revolution (rad per m for a prismatic joint).",
            "Breakaway torque over that of sliding, less one.",
            "Relative fall per degree, 1/K.",
            "`(a - b)^2 / (a b)`",
        ] {
            assert_eq!(said(doc), None, "{doc}");
        }
    }

    /// What a reader of the standard effects sees as a unit is one.
    #[test]
    fn units_of_the_standard_effects_are_read() {
        let effects = crate::standard_effects().iter();
        let shapes = effects.flat_map(|effect| {
            let shapes = effect.shapes.iter();
            shapes.map(|shape| (format!("{}.{}", effect.name, shape.name), &shape.doc))
        });
        let without = shapes.filter(|(_, doc)| Said::of(doc).is_none());
        let without: Vec<String> = without.map(|(name, _)| name).collect();
        assert_eq!(
            without,
            [
                "cable_hysteresis.beta",
                "cable_hysteresis.n",
                "gravity_compensation_spring.apart",
                "lugre_presliding.rise",
                "position_dependent_friction.k",
                "recurring_force.start",
                "recurring_force.end",
                "temperature_viscous.beta",
                "torque_ripple.k",
            ]
        );
    }
}
