//! Which declared effects other descriptions of arms have a place for: known by their laws, not by their names.
//!
//! An effect on one joint whose torque is a sum of `p dq`, `p sign(dq)`, `p ddq`, `p q` and `p` is damping, friction, armature, and a
//! spring with its rest.

use robot_model_spec::export::{JointNumbers, Spring};
use robot_model_spec::model::{
    Act, BinaryOp, Effect, EffectDefinition, EffectExpr, EffectLeaf, Expr, Function, Model, Signal,
};
use robot_model_spec::parameter::Owner;

use super::Format;

/// What a parameter is multiplied by.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    Damping,
    Friction,
    Armature,
    Stiffness,
    Constant,
}

/// A term of a law: a number times a parameter of the effect times a part.
type Term = (f64, usize, Part);

/// The terms of an effect's law, where it is such a sum.
fn law(definition: &EffectDefinition) -> Option<Vec<Term>> {
    let ([torque], [], [_]) = (
        definition.torques.as_slice(),
        definition.acts.as_slice(),
        definition.joints.as_slice(),
    ) else {
        return None;
    };
    let mut terms = Vec::new();
    add_terms(&torque.value, 1.0, &mut terms)?;
    Some(terms)
}

fn add_terms(value: &EffectExpr, sign: f64, terms: &mut Vec<Term>) -> Option<()> {
    match value {
        Expr::Binary(op @ (BinaryOp::Add | BinaryOp::Sub), x, y) => {
            let other = if *op == BinaryOp::Add { sign } else { -sign };
            add_terms(x, sign, terms)?;
            add_terms(y, other, terms)
        }
        Expr::Neg(x) => add_terms(x, -sign, terms),
        product => {
            let mut factors = Factors::default();
            factors.multiply(product)?;
            let part = factors.part.unwrap_or(Part::Constant);
            terms.push((sign * factors.number, factors.parameter?, part));
            Some(())
        }
    }
}

/// A product, read factor by factor.
struct Factors {
    number: f64,
    parameter: Option<usize>,
    part: Option<Part>,
}

impl Default for Factors {
    fn default() -> Self {
        Self {
            number: 1.0,
            parameter: None,
            part: None,
        }
    }
}

impl Factors {
    /// Nothing where there is a factor of another kind, or one kind twice.
    fn multiply(&mut self, value: &EffectExpr) -> Option<()> {
        let part = match value {
            Expr::Binary(BinaryOp::Mul, x, y) => {
                self.multiply(x)?;
                return self.multiply(y);
            }
            Expr::Binary(BinaryOp::Div, x, y) => {
                self.number /= y.number(&|_| None)?;
                return self.multiply(x);
            }
            Expr::Neg(x) => {
                self.number = -self.number;
                return self.multiply(x);
            }
            Expr::Number(number) => {
                self.number *= number;
                return Some(());
            }
            Expr::Leaf(EffectLeaf::Linear(parameter)) => {
                return self.parameter.replace(*parameter).is_none().then_some(());
            }
            Expr::Leaf(EffectLeaf::Signal(Signal::Velocity, 0)) => Part::Damping,
            Expr::Leaf(EffectLeaf::Signal(Signal::Acceleration, 0)) => Part::Armature,
            Expr::Leaf(EffectLeaf::Signal(Signal::Position, 0)) => Part::Stiffness,
            Expr::Call(Function::Sign, x)
                if **x == Expr::Leaf(EffectLeaf::Signal(Signal::Velocity, 0)) =>
            {
                Part::Friction
            }
            _ => return None,
        };
        self.part.replace(part).is_none().then_some(())
    }
}

/// Whether a format has a place for an effect.
pub(super) fn is_said(effect: &Effect, format: Format) -> bool {
    let Some(terms) = law(&effect.definition) else {
        return false;
    };
    let has = |part: Part| terms.iter().any(|(.., other)| *other == part);
    let is_plain = match format {
        Format::Urdf => !(has(Part::Armature) || has(Part::Stiffness)),
        Format::Mjcf => true,
    };
    // A constant is where a spring has its rest; alone it is a torque that no joint has by itself.
    is_plain && (!has(Part::Constant) || has(Part::Stiffness))
}

/// Whether an effect is nothing but a body on a link that stays what it is: then it is in the link's.
pub(super) fn is_body(effect: &Effect) -> bool {
    let definition = &effect.definition;
    definition.torques.is_empty()
        && !definition.acts.is_empty()
        && definition
            .acts
            .iter()
            .all(|act| matches!(act, Act::Body { .. }))
}

/// What acts on each joint, with the values of all parameters.
pub(super) fn joints(
    model: &Model,
    format: Format,
    value: &dyn Fn(usize, usize) -> f64,
) -> Vec<JointNumbers> {
    let mut joints = vec![JointNumbers::default(); model.joints.len()];
    for (index, effect) in model.effects.iter().enumerate() {
        let (true, Some(terms)) = (is_said(effect, format), law(&effect.definition)) else {
            continue;
        };
        let of = |part: Part| {
            let own = terms.iter().filter(|(.., other)| *other == part);
            let own: Vec<f64> = own.map(|(x, p, _)| x * value(index, *p)).collect();
            (!own.is_empty()).then(|| own.iter().sum::<f64>())
        };
        let joint = &mut joints[effect.joints[0]];
        add(&mut joint.damping, of(Part::Damping));
        add(&mut joint.friction, of(Part::Friction));
        add(&mut joint.armature, of(Part::Armature));
        if let Some(stiffness) = of(Part::Stiffness).filter(|k| *k != 0.0) {
            // Two springs at a joint are one: `k1 (q - r1) + k2 (q - r2)`.
            let (old, at_zero) = joint
                .spring
                .map_or((0.0, 0.0), |s| (s.stiffness, -s.stiffness * s.rest));
            let at_zero = at_zero + of(Part::Constant).unwrap_or(0.0);
            let stiffness = old + stiffness;
            let rest = -at_zero / stiffness;
            joint.spring = Some(Spring { stiffness, rest });
        }
    }
    joints
}

fn add(sum: &mut Option<f64>, more: Option<f64>) {
    if let Some(more) = more {
        *sum = Some(sum.unwrap_or(0.0) + more);
    }
}

/// The ten parameters that an effect adds to the link of a joint; `None` where they are no plain sum.
pub(super) fn bodies(
    model: &Model,
    shapes: &[f64],
    value: &dyn Fn(usize, usize) -> f64,
) -> Vec<(usize, [f64; 10])> {
    let mut first_shape = 0;
    let mut bodies = Vec::new();
    for (index, effect) in model.effects.iter().enumerate() {
        let definition = &effect.definition;
        let own = &shapes[first_shape..first_shape + definition.shapes.len()];
        first_shape += definition.shapes.len();
        if !is_body(effect) {
            continue;
        }
        for act in &definition.acts {
            let Act::Body { joint, inertial } = act else {
                continue;
            };
            let numbers = inertial.iter().map(|entry| {
                number(definition, entry, &|leaf| match leaf {
                    EffectLeaf::Linear(p) => Some(value(index, *p)),
                    EffectLeaf::Shape(k) => Some(own[*k]),
                    _ => None,
                })
            });
            let ten: Option<Vec<f64>> = numbers.collect();
            if let Some(ten) = ten.and_then(|ten| ten.try_into().ok()) {
                bodies.push((effect.joints[*joint], ten));
            }
        }
    }
    bodies
}

/// A constant expression with its bindings.
fn number(
    definition: &EffectDefinition,
    value: &EffectExpr,
    known: &dyn Fn(&EffectLeaf) -> Option<f64>,
) -> Option<f64> {
    value.number(&|leaf| match leaf {
        EffectLeaf::Binding(k) => number(definition, &definition.bindings[*k].value, known),
        leaf => known(leaf),
    })
}

/// Whether an effect is nothing but the inertia of a rotor.
pub(super) fn is_rotor(effect: &Effect) -> bool {
    law(&effect.definition).is_some_and(|terms| {
        !terms.is_empty() && terms.iter().all(|(.., part)| *part == Part::Armature)
    })
}

/// Standard parameters of effects for which there is no place beside the links. What stands apart from links is what MJCF says.
pub(super) fn is_unsaid(model: &Model, has_rotors_apart: bool, owner: Owner) -> bool {
    let format = if has_rotors_apart {
        Format::Mjcf
    } else {
        Format::Urdf
    };
    match owner {
        Owner::Effect { effect, .. } => {
            let effect = &model.effects[effect];
            !is_said(effect, format) && !is_body(effect)
        }
        Owner::Link { .. } | Owner::Monomial(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(effects: &str, declared: &str) -> Model {
        let text = format!(
            "robot Arm {{ gravity = [0, 0, -9.81]; convention = standard_dh; joint j: revolute {{ a = 1 m; alpha = 0; d = 0; }} \
             effects {{ {declared} }} }} {effects}"
        );
        robot_model_spec::load("arm.robot", &text).unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn effects_are_known_by_their_laws() {
        let own =
            "effect film(j) { linear a >= 0, b; torque(j) = -(-2*a*dq(j)) - b*sign(dq(j))/2; }";
        let model = model(
            own,
            "film on all; viscous_friction on all; motor_inertia on all; joint_spring on all; torque_offset on all; stribeck on all;",
        );
        let said = |format: Format| {
            let effects = model.effects.iter();
            let said = effects.filter(|effect| is_said(effect, format));
            said.map(|effect| effect.definition.name.as_str())
                .collect::<Vec<_>>()
        };
        assert_eq!(said(Format::Urdf), ["film", "viscous_friction"]);
        let mjcf = ["film", "viscous_friction", "motor_inertia", "joint_spring"];
        assert_eq!(said(Format::Mjcf), mjcf);
        // Each parameter is ten times its effect's number and its own, from 1.
        let value = |effect: usize, parameter: usize| (10 * (effect + 1) + parameter + 1) as f64;
        let [joint] = joints(&model, Format::Mjcf, &value)[..] else {
            panic!("one joint");
        };
        assert_eq!(
            joint,
            JointNumbers {
                damping: Some(2.0 * 11.0 + 21.0),
                friction: Some(-6.0),
                armature: Some(31.0),
                spring: Some(Spring {
                    stiffness: 41.0,
                    rest: -42.0 / 41.0
                }),
            }
        );
    }
}
