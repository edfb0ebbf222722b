//! Two effects that are to be told apart, as the command line says them.
//!
//! `stribeck(vs = 0.1) on elbow: fs = 2`: an effect as a spec declares it, then what it is expected to be worth, or 1: the best motion
//! for an effect with one parameter does not depend on it. Both are declared in the spec, so that their columns are columns of the arm.

use std::path::Path;

use robot_model::excite::{Criterion, Rivals};
use robot_model_codegen::{Compiled, DesignColumns, compile_model};
use robot_model_spec::Model;
use robot_model_spec::amend::{Amendment, amend};
use robot_model_spec::model::{Act, Effect, EffectLeaf, Signal};

use crate::output::names;
use crate::{Error, spec};

/// Two effects of a spec.
pub(super) struct Expected([OneOfTwo; 2]);

/// An effect with what its columns are expected to be worth, by name.
struct OneOfTwo {
    /// Its place in the model.
    effect: usize,
    /// Linear parameters; shapes of an effect that has none.
    sizes: Vec<(String, f64)>,
    /// Whether linear parameters have sizes that were said; those that were not count as 1, and load no torque limit.
    is_sized: bool,
    /// Places of the shapes whose slopes are its columns.
    shapes: Vec<usize>,
    /// Whether its torque depends on that of the arm.
    reads_load: bool,
}

/// The spec with both effects.
pub(super) fn rivals(
    path: &Path,
    first: &str,
    second: &str,
) -> Result<(Compiled, Expected), Error> {
    let source = path.display().to_string();
    let said = [said(first)?, said(second)?];
    if said[0].0 == said[1].0 {
        return Err(Error::Argument(format!(
            "`--separate` and `--from` are both `{}` on the same joints: nothing tells an effect from itself",
            said[0].0.effect
        )));
    }
    let text = spec::read_text(path)?;
    let declared = robot_model_spec::load(&source, &text)?;
    let amendments: Vec<Amendment> = said
        .iter()
        .map(|said| said.0.clone())
        .filter(|amendment| place(&declared, amendment).is_none())
        .collect();
    let amended = amend(&source, &text, &amendments)?;
    let mut model = robot_model_spec::load(&source, &amended)?;
    let [first, second] = &said;
    let both = [
        one(&model, &first.0, &first.1)?,
        one(&model, &second.0, &second.1)?,
    ];
    // A shape that is given is a number in the equations: those that are columns are symbols.
    for one in both.iter().filter(|one| !one.shapes.is_empty()) {
        model.effects[one.effect].shapes.fill(None);
    }
    let compiled = spec::clear(compile_model(&model))?;
    Ok((compiled, Expected(both)))
}

/// An effect of a model, with what was said of its linear parameters.
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
    let is_load = |leaf: &EffectLeaf| {
        let loads = [Signal::RigidTorque, Signal::MeasuredTorque];
        matches!(leaf, EffectLeaf::Signal(signal, _) if loads.contains(signal))
    };
    let mut equations = definition.equations();
    let reads_load = equations.any(|value| definition.reads(value, &is_load));
    let linear = definition.linear.iter();
    let linear: Vec<&str> = linear.map(|parameter| parameter.name.as_str()).collect();
    if !linear.is_empty() {
        return Ok(OneOfTwo {
            effect: index,
            sizes: sizes(&prefix, name, &linear, values)?,
            is_sized: !values.is_empty(),
            shapes: Vec::new(),
            reads_load,
        });
    }
    let is_late = |act: &Act| matches!(act, Act::Delay { .. });
    if definition.moves_links() || definition.acts.iter().any(is_late) {
        return Err(Error::Argument(format!(
            "`{name}` moves links along a motion, or makes torques late: no motion is designed for it"
        )));
    }
    let first = model.effects[..index].iter();
    let first: usize = first.map(|effect| effect.shapes.len()).sum();
    let names: Vec<&str> = definition
        .shapes
        .iter()
        .map(|shape| shape.name.as_str())
        .collect();
    let pairs = names.iter().zip(shapes);
    let pairs = pairs.filter_map(|(shape, value)| Some((format!("{prefix}.{shape}"), (*value)?)));
    let sizes: Vec<(String, f64)> = pairs.collect();
    if sizes.len() < shapes.len() || !values.is_empty() {
        let on = if definition.joints.is_empty() {
            ""
        } else {
            " on .."
        };
        return Err(Error::Argument(format!(
            "`{name}` has no parameter that the torque is linear in: say what it is expected to be, as in `{name}({} = 0.01){on}`",
            names.join(" = 0.01, ")
        )));
    }
    let count = shapes.len();
    Ok(OneOfTwo {
        effect: index,
        sizes,
        is_sized: false,
        shapes: (first..first + count).collect(),
        reads_load: true,
    })
}

/// Linear parameters with what was said of them; 1 where nothing was.
fn sizes(
    prefix: &str,
    effect: &str,
    linear: &[&str],
    values: &[(String, f64)],
) -> Result<Vec<(String, f64)>, Error> {
    let given: Vec<&str> = values.iter().map(|(name, _)| name.as_str()).collect();
    let is_other = linear.iter().any(|name| !given.contains(name)) || given.len() != linear.len();
    if !given.is_empty() && is_other {
        return Err(Error::Argument(format!(
            "`{effect}` has {}: say what each is expected to be, as in `{effect} on ..: {} = 1`",
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

/// The effect of a model that an amendment would declare.
fn place(model: &Model, amendment: &Amendment) -> Option<usize> {
    model.effects.iter().rposition(|declared| {
        let joints = declared.joints.iter();
        let joints = joints.map(|&joint| &model.joints[joint].name);
        let shapes = declared.definition.shapes.iter().zip(&declared.shapes);
        let shapes = shapes.filter_map(|(shape, value)| Some((shape.name.as_str(), (*value)?)));
        let shapes: Vec<(&str, f64)> = shapes.collect();
        let is_said = |(name, value): &(String, f64)| shapes.contains(&(name.as_str(), *value));
        declared.definition.name == amendment.effect
            && joints.eq(&amendment.joints)
            && amendment.shapes.iter().all(is_said)
    })
}

impl Expected {
    /// The criterion in the columns of the design.
    pub(super) fn criterion(
        &self,
        compiled: &Compiled,
        columns: &DesignColumns,
    ) -> Result<Criterion, Error> {
        let place = |(name, size): &(String, f64)| {
            let mut known = columns.columns.iter();
            let found = known.position(|column| column.name(compiled) == *name);
            found.map(|place| (place, *size)).ok_or_else(|| {
                Error::Argument(format!(
                    "no motion of this arm tells `{name}` apart by a column of its own: it regroups with other parameters, or follows from more than the motion, as time and channels are"
                ))
            })
        };
        let places = |one: &OneOfTwo| -> Result<Vec<(usize, f64)>, Error> {
            one.sizes.iter().map(place).collect()
        };
        Ok(Criterion::Separation(Rivals {
            effects: [places(&self.0[0])?, places(&self.0[1])?],
        }))
    }

    /// Shapes whose slopes are columns, by their index.
    pub(super) fn shapes(&self) -> Vec<usize> {
        self.0.iter().flat_map(|one| one.shapes.clone()).collect()
    }

    /// What these are expected to be.
    pub(super) fn shape_values(&self) -> Vec<(String, f64)> {
        let of_shapes = self.0.iter().filter(|one| !one.shapes.is_empty());
        of_shapes.flat_map(|one| one.sizes.clone()).collect()
    }

    /// Whether one of the torques depends on that of the arm.
    pub(super) fn read_load(&self) -> bool {
        self.0.iter().any(|one| one.reads_load)
    }

    /// What each is expected to be worth, where that was said.
    pub(super) fn sizes(&self) -> [Vec<(String, f64)>; 2] {
        [&self.0[0], &self.0[1]].map(|one| {
            if one.is_sized {
                one.sizes.clone()
            } else {
                Vec::new()
            }
        })
    }
}

/// An effect with what its parameters are worth.
fn said(text: &str) -> Result<(Amendment, Vec<(String, f64)>), Error> {
    let refused = || {
        Error::Argument(format!(
            "`{text}` is no effect with its size: write `stribeck(vs = 0.1) on elbow: fs = 2`"
        ))
    };
    let (declaration, sizes) = match text.split_once(':') {
        Some((declaration, sizes)) => (declaration, Some(sizes)),
        None => (text, None),
    };
    let (head, joints) = match declaration.split_once(" on ") {
        Some((head, joints)) => (head, joints),
        None => (declaration, ""),
    };
    let (effect, shapes) = match head.trim().split_once('(') {
        Some((effect, shapes)) => (effect, shapes.trim().strip_suffix(')').ok_or_else(refused)?),
        None => (head, ""),
    };
    let joints = joints.trim().trim_start_matches('(').trim_end_matches(')');
    let joints = joints
        .split(',')
        .map(str::trim)
        .filter(|joint| !joint.is_empty());
    let amendment = Amendment {
        effect: effect.trim().to_owned(),
        joints: joints.map(str::to_owned).collect(),
        shapes: pairs(shapes).ok_or_else(refused)?,
    };
    let sizes = match sizes {
        Some(sizes) => pairs(sizes)
            .filter(|sizes| !sizes.is_empty())
            .ok_or_else(refused)?,
        None => Vec::new(),
    };
    Ok((amendment, sizes))
}

/// `a = 1, b = 2`
fn pairs(text: &str) -> Option<Vec<(String, f64)>> {
    let parts = text
        .split(',')
        .map(str::trim)
        .filter(|part| !part.is_empty());
    parts
        .map(|part| {
            let (name, value) = part.split_once('=')?;
            let value: f64 = value.trim().parse().ok()?;
            value.is_finite().then(|| (name.trim().to_owned(), value))
        })
        .collect()
}
