//! The standard effects against their laws, written out by hand: what a name means does not change unseen.

use robot_model_spec::model::EffectDefinition;
use robot_model_spec::standard_effects;
use robot_model_tests::expression::{Scope, value};

/// Two joints `j`, `k`: position, velocity, acceleration, load; linear parameters `p`, shape `s`.
struct At {
    q: [f64; 2],
    dq: [f64; 2],
    ddq: [f64; 2],
    load: [f64; 2],
    p: [f64; 3],
    s: f64,
}

type Law = fn(&At) -> f64;

/// Torque on the effect's first joint. Friction is positive where the joint moves in positive direction: it is what the
/// motor has to supply.
const LAWS: [(&str, Law); 13] = [
    ("asymmetric_coulomb", |at| at.p[0] * at.dq[0].signum().abs()),
    ("asymmetric_viscous", |at| at.p[0] * at.dq[0].abs()),
    ("coulomb_friction", |at| at.p[0] * at.dq[0].signum()),
    ("cubic_viscous", |at| {
        at.p[0] * at.dq[0] * at.dq[0] * at.dq[0]
    }),
    ("gear_coupling", |at| {
        at.p[0] * at.ddq[1] + at.p[1] * at.dq[1] + at.p[2] * (at.dq[0] + at.dq[1]).signum()
    }),
    ("joint_spring", |at| at.p[0] * at.q[0] + at.p[1]),
    ("load_dependent_friction", |at| {
        at.p[0] * at.load[0].abs() * at.dq[0].signum()
    }),
    ("motor_inertia", |at| at.p[0] * at.ddq[0]),
    ("quadratic_viscous", |at| {
        at.p[0] * at.dq[0] * at.dq[0].abs()
    }),
    ("stribeck", |at| {
        at.p[0] * (-at.dq[0] * at.dq[0] / (at.s * at.s)).exp() * at.dq[0].signum()
    }),
    ("torque_offset", |at| at.p[0]),
    ("torque_ripple", |at| {
        at.p[0] * (at.s * at.q[0]).cos() + at.p[1] * (at.s * at.q[0]).sin()
    }),
    ("viscous_friction", |at| at.p[0] * at.dq[0]),
];

/// Both directions of motion, and speeds that differ in sign between the joints.
fn states() -> Vec<At> {
    let signs = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    signs
        .into_iter()
        .map(|(first, second)| At {
            q: [0.7 * second, -0.4],
            dq: [0.3 * first, 0.5 * second],
            ddq: [1.1, -2.3 * first],
            load: [-8.0 * second, 5.0],
            p: [1.7, 0.6, 0.9],
            s: 0.4,
        })
        .collect()
}

fn torque(definition: &EffectDefinition, at: &At, joints: &[usize], formal: usize) -> f64 {
    let scope = Scope {
        linear: &at.p,
        shapes: &[at.s],
        joints,
        signals: [&at.q, &at.dq, &at.ddq, &at.load],
        time: 0.0,
    };
    let equations = definition.torques.iter();
    equations
        .filter(|equation| equation.joint == formal)
        .map(|equation| value(&equation.value, &scope))
        .sum()
}

#[test]
fn every_standard_effect_follows_its_law() {
    let definitions = standard_effects();
    let names: Vec<&str> = definitions.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(
        names,
        LAWS.map(|(name, _)| name),
        "one law per standard effect, by name"
    );
    for (definition, (name, law)) in definitions.iter().zip(LAWS) {
        for at in states() {
            let (found, wanted) = (torque(definition, &at, &[0, 1], 0), law(&at));
            // A handful of roundings.
            assert!(
                (found - wanted).abs() < 1e-14,
                "{name}: {found} and {wanted}"
            );
        }
    }
}

/// Both joints feel the one motor between them alike: swapping the joints swaps the torques.
#[test]
fn gear_coupling_acts_on_both_joints_alike() {
    let definitions = standard_effects();
    let coupling = definitions
        .iter()
        .find(|d| d.name == "gear_coupling")
        .unwrap();
    for at in states() {
        let second = torque(coupling, &at, &[0, 1], 1);
        let swapped = torque(coupling, &at, &[1, 0], 0);
        assert!((second - swapped).abs() < 1e-14, "{second} and {swapped}");
    }
}
