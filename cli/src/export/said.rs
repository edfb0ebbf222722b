//! What is said of an arm that is written: which of its values the parameters tell, and what the format has no place for.

use robot_model_codegen::Compiled;
use robot_model_spec::model::{Inertial, JointKind, LinearParameter, Link, Model};
use robot_model_spec::parameter::{InertialElement, Owner};

use super::Format;
use super::passive::{is_body, is_rotor, is_said, joints};
use super::standard::Standard;
use crate::interpreted::Moved;
use crate::output::{names, significant};

/// Of a link, by names of its ten: what is told alone, what only in sums, what is of no influence.
struct Told<'a> {
    alone: Vec<&'a str>,
    in_sums: Vec<&'a str>,
    without_influence: Vec<&'a str>,
}

impl<'a> Told<'a> {
    fn of(compiled: &'a Compiled, link: usize) -> Self {
        let mut told = Self {
            alone: Vec::new(),
            in_sums: Vec::new(),
            without_influence: Vec::new(),
        };
        let base = &compiled.base;
        for (k, parameter) in compiled.standard.iter().enumerate() {
            if !matches!(parameter.owner, Owner::Link { link: own, .. } if own == link) {
                continue;
            }
            let name = parameter.name.as_str();
            // The sum of a kept parameter has the kept one and what is regrouped into it.
            let sum = base.kept.iter().position(|kept| *kept == k);
            let is_alone = sum.is_some_and(|sum| base.combinations[sum].len() == 1);
            if base.unidentifiable.contains(&k) {
                told.without_influence.push(name);
            } else if is_alone {
                told.alone.push(name);
            } else {
                told.in_sums.push(name);
            }
        }
        told
    }
}

/// A sentence about the values of a link; empty where they are all told or as they were given.
pub(super) fn remark(compiled: &Compiled, standard: &Standard, link: usize) -> String {
    let Some(chain) = compiled.model.chain() else {
        return String::new();
    };
    let own = &chain.links[link];
    if standard.is_given || matches!(own.inertial, Inertial::Fixed(_)) {
        return String::new();
    }
    let told = Told::of(compiled, link);
    if told.alone.len() == InertialElement::ALL.len() {
        return String::new();
    }
    let nearest = match own.inertial {
        Inertial::Nominal(_) => "the spec's nominal values",
        _ => "a substitute body, as the spec has no nominal values",
    };
    let parts = [
        ("identified only in sums", &told.in_sums),
        ("without influence on any torque", &told.without_influence),
        ("identified", &told.alone),
    ];
    let parts = parts.iter().filter(|(_, list)| !list.is_empty());
    let parts: Vec<String> = parts
        .map(|(what, list)| format!("{what}: {}", short(list)))
        .collect();
    format!(
        "one of many sets with the same dynamics, nearest to {nearest}; {}",
        parts.join("; ")
    )
}

/// `m, mx` of `fore.m`, `fore.mx`
fn short(list: &[&str]) -> String {
    let plain = list
        .iter()
        .map(|name| name.rsplit('.').next().unwrap_or(name));
    plain.collect::<Vec<_>>().join(", ")
}

/// How many base parameters are named.
const NAMED: usize = 4;

/// A sentence about base parameters that no arm has, those that are farthest off first.
pub(super) fn moved(standard: &Standard) -> Option<String> {
    let moved = &standard.moved;
    let named = moved.iter().take(NAMED).map(Moved::said);
    let named: Vec<String> = named.collect();
    let more = match moved.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(", and {more} more by less"),
    };
    (!named.is_empty()).then(|| {
        format!(
            "no physically possible arm has these values; a near one is written, with {}{more}; `identify --method physical` finds the \
             possible arm that fits the logs best",
            named.join(", ")
        )
    })
}

/// Effects for which the format has no place, with their values.
pub(super) fn not_written(
    compiled: &Compiled,
    standard: &[f64],
    shapes: &[f64],
    format: Format,
) -> Vec<String> {
    let model = &compiled.model;
    let mut first_shape = 0;
    let mut left_out = Vec::new();
    for (index, effect) in model.effects.iter().enumerate() {
        let definition = &effect.definition;
        let own = &shapes[first_shape..first_shape + definition.shapes.len()];
        first_shape += definition.shapes.len();
        // Rotors are told by joints.
        if is_said(effect, format) || is_body(effect) || is_rotor(effect) {
            continue;
        }
        let linear = compiled.standard.iter().zip(standard);
        let linear = linear.filter_map(|(parameter, value)| match parameter.owner {
            Owner::Effect {
                effect: other,
                parameter,
            } if other == index => {
                let known: &LinearParameter = &definition.linear[parameter];
                Some((&known.name, *value))
            }
            _ => None,
        });
        let linear: Vec<(&String, f64)> = linear.collect();
        // What is not there, or was put into links that do the same, is not lost.
        if !linear.is_empty() && linear.iter().all(|(_, value)| *value == 0.0) {
            continue;
        }
        let shapes = definition
            .shapes
            .iter()
            .map(|shape| &shape.name)
            .zip(own.iter().copied());
        let values = linear.into_iter().chain(shapes);
        let values: Vec<String> = values
            .map(|(name, value)| format!("{name} = {}", significant(value, 5)))
            .collect();
        left_out.push(format!(
            "`{}` ({})",
            model.effect_name(index),
            values.join(", ")
        ));
    }
    left_out
}

/// Links whose remark says that they are one of many.
pub(super) fn not_alone(compiled: &Compiled, remarks: &[String]) -> Option<String> {
    let links = compiled
        .model
        .chain()
        .into_iter()
        .flat_map(|chain| &chain.links);
    let links = links.zip(remarks).filter(|(_, remark)| !remark.is_empty());
    let (nominal, others): (Vec<_>, Vec<_>) =
        links.partition(|(link, _)| matches!(link.inertial, Inertial::Nominal(_)));
    let list = |links: &[(&Link, &String)]| {
        let links: Vec<&str> = links.iter().map(|(link, _)| link.name.as_str()).collect();
        names(&links)
    };
    let of = [
        (nominal, "nearest to the nominal values"),
        (others, "as the spec has no nominal values"),
    ];
    let of = of.iter().filter(|(links, _)| !links.is_empty());
    let of: Vec<String> = of
        .map(|(links, which)| {
            format!(
                "for {} one of many sets with the same dynamics, {which}",
                list(links)
            )
        })
        .collect();
    (!of.is_empty()).then(|| {
        format!(
            "the parameters do not determine every inertial value; the file has {} (its comments list the names)",
            of.join(", ")
        )
    })
}

/// A sentence about links with another mass than the given one.
pub(super) fn masses(standard: &Standard) -> Option<String> {
    let others = standard.masses.iter().map(|(link, both)| {
        let [given, written] = both.map(|mass| significant(mass, 4));
        format!("`{link}` {written} kg in place of {given} kg")
    });
    let others: Vec<String> = others.collect();
    (!others.is_empty()).then(|| {
        format!(
            "some masses differ from the nominal ones, since torques determine only sums with them, or links with them would be physically \
             impossible: {}",
            others.join(", ")
        )
    })
}

/// A sentence about rotors that stand apart from the links, where a format has no place for them.
pub(super) fn rotors(model: &Model, value: &dyn Fn(usize, usize) -> f64) -> Option<String> {
    let all = joints(model, Format::Mjcf, value);
    let rotors = model.joints.iter().zip(all).filter_map(|(joint, numbers)| {
        let inertia = numbers.armature.filter(|inertia| *inertia != 0.0)?;
        let unit = match joint.kind {
            JointKind::Revolute => "kg m^2",
            JointKind::Prismatic => "kg",
        };
        Some(format!(
            "`{}` {} {unit}",
            joint.name,
            significant(inertia, 4)
        ))
    });
    let rotors: Vec<String> = rotors.collect();
    (!rotors.is_empty()).then(|| {
        format!(
            "the inertia of rotors, for which a URDF has no place, is in no link; give it to your simulator as armature of the joints: {}; where a log \
             determines a rotor only in a sum with its link, only the sum is right",
            rotors.join(", ")
        )
    })
}

/// By how many times a moment of inertia leaves the nominal one before it is told.
const FAR: f64 = 10.0;

/// Moments of inertia below this share of the largest of a link are nothing, as that of a rod about itself is.
const NOTHING: f64 = 1e-2;

/// A sentence about links whose principal moments of inertia are far from the nominal ones.
pub(super) fn inertias(compiled: &Compiled, standard: &[f64]) -> Option<String> {
    let links = compiled.model.chain()?.links.iter();
    let tens = standard.chunks_exact(InertialElement::ALL.len());
    let far = links.zip(tens).filter_map(|(link, ten)| {
        let Inertial::Nominal(nominal) = link.inertial else {
            return None;
        };
        let given = principal_moments(nominal)?;
        let written = principal_moments(ten.try_into().ok()?)?;
        let least = NOTHING * given[2].max(written[2]);
        let mut pairs = given.iter().zip(&written);
        let is_far = pairs.any(|(given, written)| {
            let (small, large) = (given.min(*written), given.max(*written));
            large > FAR * small.max(least)
        });
        let [given, written] = [given, written].map(|moments| {
            let moments = moments.map(|moment| significant(moment, 3));
            moments.join(", ")
        });
        is_far.then(|| {
            format!(
                "`{}` {written} kg m^2 in place of {given} kg m^2",
                link.name
            )
        })
    });
    let far: Vec<String> = far.collect();
    (!far.is_empty()).then(|| {
        format!(
            "some moments of inertia about the center of mass are more than {FAR} times larger or smaller than the nominal ones; check those, \
             and whether effects such as `motor_inertia` are declared: {}",
            far.join(", ")
        )
    })
}

/// Moments of inertia about the principal axes through the center of mass, the least first.
fn principal_moments(ten: [f64; 10]) -> Option<[f64; 3]> {
    let spread = robot_model::Inertial::from(ten).second_moments()?;
    let spread = spread.symmetric_eigenvalues();
    let mut moments = [0, 1, 2].map(|axis| (spread.sum() - spread[axis]).max(0.0));
    moments.sort_by(f64::total_cmp);
    Some(moments)
}
