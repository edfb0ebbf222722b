//! Two effects that are to be told apart.
//!
//! `stribeck(vs = 0.1) on elbow: fs = 2`: an effect as a spec declares it, then what it is expected to be worth, or 1: the best motion
//! for an effect with one parameter does not depend on it. Both are declared in the spec, so that their columns are columns of the arm.
//! An effect without a linear parameter, `encoder_offset(offset = 0.02) on elbow`, has those of its shapes.

mod said;

use std::ops::Range;
use std::path::Path;

use robot_model::excite::{Criterion, Rivals};
use robot_model_codegen::{Compiled, DesignColumn, DesignColumns, RivalColumns, compile_model};
use robot_model_spec::Model;
use robot_model_spec::amend::{Amendment, amend};
use robot_model_spec::model::{Act, Effect, EffectLeaf, Signal};

use crate::output::names;
use crate::parameters::Known;
use crate::{Error, spec};

use said::{Sizes, said};

/// Two effects of a spec.
pub(super) struct Expected([OneOfTwo; 2]);

/// An effect with what is expected of it, by name.
struct OneOfTwo {
    /// Its place in the model.
    effect: usize,
    /// Its name, for messages.
    name: String,
    /// Linear parameters; none where its shapes are its columns.
    linear: Sizes,
    /// Whether linear parameters have sizes that were said; those that were not count as 1, and load no torque limit.
    is_sized: bool,
    /// Values of shapes that were said or are in the spec.
    shapes: Sizes,
    /// All its shapes.
    places: Range<usize>,
    /// Whether its torque depends on that of the arm.
    reads_load: bool,
}

/// The spec with both effects.
pub(super) fn rivals(
    path: &Path,
    first: &str,
    second: &str,
) -> Result<(Compiled, Expected), Error> {
    let text = spec::read_spec(path)?;
    rivals_of(&path.display().to_string(), &text, first, second)
}

/// Whether each parameter of two effects has a column of its own beside those of a spec's arm, so that a motion can be asked for: an effect
/// may be a part of the other, or of the arm.
///
/// # Errors
/// Those of the spec with both of them.
pub(crate) fn have_own_columns(
    source: &str,
    text: &str,
    first: &str,
    second: &str,
) -> Result<bool, Error> {
    let (compiled, Expected(both)) = rivals_of(source, text, first, second)?;
    let mut linear = both.iter().flat_map(|one| &one.linear);
    Ok(linear.all(|(name, _)| compiled.base.names.contains(name)))
}

fn rivals_of(
    source: &str,
    text: &str,
    first: &str,
    second: &str,
) -> Result<(Compiled, Expected), Error> {
    let said = [said(first)?, said(second)?];
    let declared = robot_model_spec::load(source, text)?;
    let amendments: Vec<Amendment> = said
        .iter()
        .map(|said| said.0.clone())
        .filter(|amendment| place(&declared, amendment).is_none())
        .collect();
    let alike = || {
        Error::Argument(format!(
            "`--separate` and `--from` are both `{}` on the same joints: give two different effects",
            said[0].0.effect
        ))
    };
    if said[0].0 == said[1].0 {
        return Err(alike());
    }
    let amended = amend(source, text, &amendments)?;
    let mut model = robot_model_spec::load(source, &amended)?;
    let [first, second] = &said;
    let both = [
        one(&model, &first.0, &first.1)?,
        one(&model, &second.0, &second.1)?,
    ];
    if both[0].effect == both[1].effect {
        return Err(alike());
    }
    // A shape that is given is a number in the equations: those that are columns are symbols.
    for one in both.iter().filter(|one| one.linear.is_empty()) {
        model.effects[one.effect].shapes.fill(None);
    }
    let compiled = spec::clear(compile_model(&model))?;
    Ok((compiled, Expected(both)))
}

/// An effect of a model, with what was said of it.
fn one(model: &Model, amendment: &Amendment, values: &[(String, f64)]) -> Result<OneOfTwo, Error> {
    let name = &amendment.effect;
    let index = place(model, amendment).ok_or_else(|| {
        Error::Argument(format!(
            "`{name}` is declared for each joint by itself: name one, as in `{name} on {}`",
            model.joints[0].name
        ))
    })?;
    let prefix = model.effect_name(index);
    let Effect {
        definition, shapes, ..
    } = &model.effects[index];
    let is_late = |act: &Act| matches!(act, Act::Delay { .. });
    if definition.moves_links() || definition.acts.iter().any(is_late) {
        return Err(Error::Argument(format!(
            "`{name}` displaces links or delays torques: no motion can be designed for it"
        )));
    }
    if definition.linear.is_empty() && shapes.is_empty() {
        return Err(Error::Argument(format!(
            "`{name}` has no unknown parameter"
        )));
    }
    let is_load = |leaf: &EffectLeaf| {
        let loads = [Signal::RigidTorque, Signal::MeasuredTorque];
        matches!(leaf, EffectLeaf::Signal(signal, _) if loads.contains(signal))
    };
    let rates = definition.states.iter();
    let rates = rates.map(|state| &definition.bindings[state.rate].value);
    let mut equations = definition.equations().chain(rates);
    let reads_load = equations.any(|value| definition.reads(value, &is_load));
    let linear: Vec<&str> = definition
        .linear
        .iter()
        .map(|parameter| parameter.name.as_str())
        .collect();
    let first = model.effects[..index].iter();
    let first: usize = first.map(|effect| effect.shapes.len()).sum();
    let in_spec = definition.shapes.iter().zip(shapes);
    let known = in_spec.filter_map(|(shape, value)| {
        let mut said = amendment.shapes.iter();
        let said = said.find(|(name, _)| *name == shape.name);
        let value = said.map(|said| said.1).or(*value)?;
        Some((format!("{prefix}.{}", shape.name), value))
    });
    Ok(OneOfTwo {
        effect: index,
        name: name.clone(),
        linear: sizes(&prefix, name, &linear, values)?,
        is_sized: !values.is_empty(),
        shapes: known.collect(),
        places: first..first + shapes.len(),
        reads_load: reads_load || linear.is_empty(),
    })
}

/// Linear parameters with what was said of them; 1 where nothing was.
fn sizes(
    prefix: &str,
    effect: &str,
    linear: &[&str],
    values: &[(String, f64)],
) -> Result<Sizes, Error> {
    let given: Vec<&str> = values.iter().map(|(name, _)| name.as_str()).collect();
    let is_other = linear.iter().any(|name| !given.contains(name)) || given.len() != linear.len();
    if linear.is_empty() && !given.is_empty() {
        return Err(Error::Argument(format!(
            "`{effect}` has no linear parameter: give its shapes, as in `{effect}(.. = 0.01) on ..`"
        )));
    }
    if !given.is_empty() && is_other {
        return Err(Error::Argument(format!(
            "`{effect}` has {}: give the expected value of each, as in `{effect} on ..: {} = 1`, or of none",
            names(linear),
            linear.join(" = 1, ")
        )));
    }
    let size = |name: &&str| {
        let given = values.iter().find(|(known, _)| known == name);
        (
            format!("{prefix}.{name}"),
            given.map_or(1.0, |given| given.1),
        )
    };
    Ok(linear.iter().map(size).collect())
}

/// The effect of a model that an amendment would declare; one whose shapes are open stands for any.
fn place(model: &Model, amendment: &Amendment) -> Option<usize> {
    let is_it = |declared: &Effect, may_be_open: bool| {
        let joints = declared.joints.iter();
        let joints = joints.map(|&joint| &model.joints[joint].name);
        let is_said = |(name, said): &(String, f64)| {
            let mut shapes = declared.definition.shapes.iter().zip(&declared.shapes);
            let found = shapes.find(|(shape, _)| shape.name == *name);
            found.is_some_and(|(_, value)| {
                value.map_or(may_be_open, |value| value.to_bits() == said.to_bits())
            })
        };
        declared.definition.name == amendment.effect
            && joints.eq(&amendment.joints)
            && amendment.shapes.iter().all(is_said)
    };
    let place = |may_be_open| {
        let mut effects = model.effects.iter();
        effects.rposition(|declared| is_it(declared, may_be_open))
    };
    place(false).or_else(|| place(true))
}

impl OneOfTwo {
    fn is_of_shapes(&self) -> bool {
        self.linear.is_empty()
    }
}

impl Expected {
    /// What the columns of both are, beside those of the arm.
    pub(super) fn columns(&self, compiled: &Compiled) -> RivalColumns {
        let of_shapes = self.0.iter().filter(|one| one.is_of_shapes());
        let linear = self.0.iter().flat_map(|one| &one.linear);
        let base = &compiled.base.names;
        RivalColumns {
            shapes: of_shapes.flat_map(|one| one.places.clone()).collect(),
            loaded: linear
                .filter_map(|(name, _)| base.iter().position(|base| base == name))
                .collect(),
        }
    }

    /// The criterion in the columns of the design.
    pub(super) fn criterion(
        &self,
        compiled: &Compiled,
        columns: &DesignColumns,
        known: &Known,
    ) -> Result<Criterion, Error> {
        let shape_names = compiled.shape_names();
        let place = |column: Option<DesignColumn>, name: &str, size: f64| {
            let found = column.and_then(|column| columns.columns.iter().position(|k| *k == column));
            found.map(|place| (place, size)).ok_or_else(|| {
                Error::Argument(format!(
                    "no motion of this arm separates `{name}`: it regroups with other parameters, or depends on more than the motion, such \
                     as time or channels"
                ))
            })
        };
        let places = |one: &OneOfTwo| -> Result<Vec<(usize, f64)>, Error> {
            if one.is_of_shapes() {
                let mut all = Vec::new();
                for shape in one.places.clone() {
                    let name = &shape_names[shape];
                    if known.guessed.contains(name) {
                        return Err(one.without_a_value(&shape_names[one.places.clone()]));
                    }
                    let column = Some(DesignColumn::Shape(shape));
                    all.push(place(column, name, known.shapes[shape])?);
                }
                return Ok(all);
            }
            let linear = one.linear.iter().map(|(name, size)| {
                let base = compiled.base.names.iter().position(|base| base == name);
                place(base.map(DesignColumn::Parameter), name, *size)
            });
            linear.collect()
        };
        Ok(Criterion::Separation(Rivals {
            effects: [places(&self.0[0])?, places(&self.0[1])?],
        }))
    }

    /// What is expected of shapes where both are there.
    pub(super) fn shapes(&self) -> Sizes {
        self.0.iter().flat_map(|one| one.shapes.clone()).collect()
    }

    /// Whether one of the torques depends on that of the arm.
    pub(super) fn read_load(&self) -> bool {
        self.0.iter().any(|one| one.reads_load)
    }

    /// Values of the arm that has the one and not the other, for each of both: shapes, and linear parameters that were said.
    pub(super) fn arms(&self, compiled: &Compiled) -> [Sizes; 2] {
        let shape_names = compiled.shape_names();
        [(0, 1), (1, 0)].map(|(own, other)| {
            let (own, other) = (&self.0[own], &self.0[other]);
            let mut values = self.shapes();
            if other.is_of_shapes() {
                let names = &shape_names[other.places.clone()];
                values.retain(|(name, _)| !names.contains(name));
                values.extend(names.iter().map(|name| (name.clone(), 0.0)));
            }
            if own.is_sized {
                values.extend(own.linear.iter().cloned());
            }
            values
        })
    }

    /// Parameters that were said or stand for 1: none of them is missing.
    pub(super) fn parameters(&self) -> impl Iterator<Item = &str> {
        let sized = self.0.iter().filter(|one| one.is_sized);
        sized.flat_map(|one| one.linear.iter().map(|(name, _)| name.as_str()))
    }
}

impl OneOfTwo {
    fn without_a_value(&self, shapes: &[String]) -> Error {
        let last = |name: &String| name.rsplit('.').next().unwrap_or_default().to_owned();
        let shapes: Vec<String> = shapes.iter().map(last).collect();
        let on = if shapes.is_empty() { "" } else { " on .." };
        Error::Argument(format!(
            "`{}` has no linear parameter: give its expected shape, as in `{}({} = 0.01){on}`",
            self.name,
            self.name,
            shapes.join(" = 0.01, ")
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_that_is_a_part_of_another_has_no_column_of_its_own() {
        let text = "robot A {
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint turn: revolute { a = 0.5; alpha = 0; d = 0; }
            effects { viscous_friction on all; }
        }";
        let told = |first: &str, second: &str| {
            have_own_columns("a.robot", text, first, second).expect("a spec with both")
        };
        assert!(told(
            "coulomb_friction on turn",
            "stribeck(vs = 0.1) on turn"
        ));
        // A spring whose rest is open has an offset in it; a rotor of the last joint is an inertia of the link.
        assert!(!told("torque_offset on turn", "joint_spring on turn"));
        assert!(!told("motor_inertia on turn", "stribeck(vs = 0.1) on turn"));
    }
}
