//! The standard effects against their laws, written out by hand: what a name means does not change unseen.

use robot_model_spec::model::EffectDefinition;
use robot_model_spec::standard_effects;
use robot_model_tests::expression::{Scope, value};

/// Two joints `j`, `k`: position, velocity, acceleration, load and measured torque.
struct At {
    q: [f64; 2],
    dq: [f64; 2],
    ddq: [f64; 2],
    load: [f64; 2],
    /// Linear parameters.
    p: [f64; 10],
    /// Shape parameters.
    s: [f64; 3],
    measured: [f64; 2],
    input: [f64; 1],
    /// The internal state.
    z: [f64; 1],
}

type Law = fn(&At) -> f64;

const TIME: f64 = 3.7;

/// `dz/dt` of bristles whose deflection is measured in that of sliding.
fn lugre_rate(at: &At) -> f64 {
    let (d, vs, rise) = (at.s[0], at.s[1], at.s[2]);
    let g = 1.0 + rise * (-at.dq[0] * at.dq[0] / (vs * vs)).exp();
    (at.dq[0] - at.dq[0].abs() * at.z[0] / g) / d
}

/// Torque on the effect's first joint. Friction is positive where the joint moves in positive direction: it is what the
/// motor has to supply.
const LAWS: [(&str, Law); 26] = [
    ("asymmetric_coulomb", |at| at.p[0] * at.dq[0].signum().abs()),
    ("asymmetric_viscous", |at| at.p[0] * at.dq[0].abs()),
    ("cable_hysteresis", |at| at.p[0] * at.z[0]),
    ("coulomb_friction", |at| at.p[0] * at.dq[0].signum()),
    ("cubic_viscous", |at| {
        at.p[0] * at.dq[0] * at.dq[0] * at.dq[0]
    }),
    ("dahl", |at| at.p[0] * at.z[0]),
    ("dry_friction_drift", |at| {
        at.p[0] * (-TIME / at.s[0]).exp_m1() / (-60.0 / at.s[0]).exp_m1() * at.dq[0].signum()
    }),
    ("gear_coupling", |at| {
        at.p[0] * at.ddq[1] + at.p[1] * at.dq[1] + at.p[2] * (at.dq[0] + at.dq[1]).signum()
    }),
    ("gravity_compensation_spring", |at| {
        // `K (L - l0) dL/dq` from its lengths, which make the unknowns.
        let (ratio, q0) = (at.s[0] + 2.0, at.s[1]);
        let a_over_b = 0.5 * (ratio + (ratio * ratio - 4.0).sqrt());
        let (a, b) = (a_over_b.sqrt(), 1.0 / a_over_b.sqrt());
        let (stiffness, rest) = (at.p[0] / (a * b), at.p[1] / at.p[0] * (a * b).sqrt());
        let angle = at.q[0] - q0;
        let length = (a * a + b * b + 2.0 * a * b * angle.cos()).sqrt();
        let slope = -a * b * angle.sin() / length;
        stiffness * (length - rest) * slope
    }),
    ("joint_spring", |at| at.p[0] * at.q[0] + at.p[1]),
    ("load_dependent_friction", |at| {
        at.p[0] * at.load[0].abs() * at.dq[0].signum()
    }),
    ("lugre_presliding", |at| {
        let rate = lugre_rate(at);
        at.p[0] * at.z[0] + at.p[1] * at.s[0] * rate
    }),
    ("motor_inertia", |at| at.p[0] * at.ddq[0]),
    ("parameter_drift", |at| {
        at.p[0] * (-TIME / at.s[0]).exp_m1() / (-60.0 / at.s[0]).exp_m1() * at.dq[0]
    }),
    ("position_dependent_friction", |at| {
        let amplitude = at.p[0].hypot(at.p[1]);
        let phase = (-at.p[1]).atan2(at.p[0]);
        amplitude * (at.s[0] * at.q[0] + phase).cos() * at.dq[0].signum()
    }),
    ("quadratic_viscous", |at| {
        at.p[0] * at.dq[0] * at.dq[0].abs()
    }),
    ("rokae", |at| {
        let v = at.dq[0];
        let dry = if v > 0.0 { at.p[0] } else { at.p[1] };
        if v.abs() < at.s[0] {
            (v / at.s[0]).abs() * dry * v.signum()
        } else {
            dry * v.signum() + at.p[2] * v + at.p[3] * v.powi(2) + at.p[4] * v.powi(3)
        }
    }),
    ("rokae_continuous", |at| {
        let v = at.dq[0];
        let dry = if v > 0.0 { at.p[0] } else { at.p[1] };
        dry * (v.abs() / at.s[0]).min(1.0) * v.signum()
            + at.p[2] * v
            + at.p[3] * v.powi(2)
            + at.p[4] * v.powi(3)
    }),
    ("stribeck", |at| {
        at.p[0] * (-at.dq[0] * at.dq[0] / (at.s[0] * at.s[0])).exp() * at.dq[0].signum()
    }),
    ("temperature_viscous", |at| {
        at.p[0] * (-at.s[0] * (at.input[0] - 20.0)).exp() * at.dq[0]
    }),
    ("torque_gain", |at| at.p[0] * at.load[0]),
    ("torque_offset", |at| at.p[0]),
    ("torque_ripple", |at| {
        at.p[0] * (at.s[0] * at.q[0]).cos() + at.p[1] * (at.s[0] * at.q[0]).sin()
    }),
    ("torque_saturation", |at| {
        let (command, v0) = (at.measured[0], at.s[1]);
        let falling = 1.0 - (at.dq[0] * command.signum()).max(0.0) / v0;
        let most = at.s[0] * falling.max(0.0);
        at.p[0] * (command - command.clamp(-most, most))
    }),
    ("transmission_efficiency", |at| {
        // `driving = 1/eta - 1`, `driven = 1 - eta`.
        if at.load[0] * at.dq[0] > 0.0 {
            at.p[0] * at.load[0]
        } else {
            -at.p[1] * at.load[0]
        }
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
            // One speed above the smallest shape parameter, one below.
            dq: [(1.8 + 1.5 * second) * first, 0.5 * second],
            ddq: [1.1, -2.3 * first],
            load: [-8.0 * second, 5.0],
            p: [1.7, 0.6, 0.9, -0.4, 0.2, 1.3, -0.7, 2.2, 0.1, 3.1],
            s: [2.25 + 0.15 * first, 3.3 - 2.5 * first, 1.5],
            measured: [-7.0 * second, 3.0],
            input: [31.0],
            z: [0.6 * second],
        })
        .collect()
}

fn scope<'a>(definition: &'a EffectDefinition, at: &'a At, joints: &'a [usize]) -> Scope<'a> {
    Scope {
        linear: &at.p,
        shapes: &at.s,
        joints,
        signals: [&at.q, &at.dq, &at.ddq, &at.load, &at.measured],
        inputs: &at.input,
        states: &at.z,
        bindings: &definition.bindings,
        time: TIME,
    }
}

fn torque(definition: &EffectDefinition, at: &At, joints: &[usize], formal: usize) -> f64 {
    let scope = scope(definition, at, joints);
    let equations = definition.torques.iter();
    equations
        .filter(|equation| equation.joint == formal)
        .map(|equation| value(&equation.value, &scope))
        .sum()
}

#[test]
fn every_standard_effect_follows_its_law() {
    let torques = standard_effects().iter().filter(|d| d.acts.is_empty());
    let definitions: Vec<_> = torques.collect();
    let names: Vec<&str> = definitions.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(
        names,
        LAWS.map(|(name, _)| name),
        "one law per standard effect that is a torque, by name"
    );
    for (definition, (name, law)) in definitions.iter().zip(LAWS) {
        for at in states() {
            let (found, wanted) = (torque(definition, &at, &[0, 1], 0), law(&at));
            // A handful of roundings.
            assert!(
                (found - wanted).abs() < 1e-14 * (1.0 + wanted.abs()),
                "{name}: {found} and {wanted}"
            );
        }
    }
}

type Acts = fn(&At) -> Vec<f64>;

/// What the others change: position of the link less that of the joint, force, inertial parameters, angles of the base, seconds.
const ACTS: [(&str, Acts); 9] = [
    ("backlash", |at| vec![-at.s[0] * at.load[0].signum()]),
    ("base_tilt", |at| vec![at.s[0], at.s[1]]),
    ("encoder_offset", |at| vec![-at.s[0]]),
    ("external_force", |at| {
        let touched = at.s[0] <= TIME && TIME < at.s[1];
        at.p[..3]
            .iter()
            .map(|f| if touched { *f } else { 0.0 })
            .collect()
    }),
    ("joint_elasticity", |at| vec![-at.load[0] / at.s[0]]),
    ("link_inertial_error", |at| at.p.to_vec()),
    ("payload", |at| at.p.to_vec()),
    ("recurring_force", |at| {
        let [start, end, _] = at.s;
        let phase = at.input[0];
        let touched = if start <= end {
            start <= phase && phase < end
        } else {
            start <= phase || phase < end
        };
        at.p[..3]
            .iter()
            .map(|f| if touched { *f } else { 0.0 })
            .collect()
    }),
    ("time_delay", |at| vec![at.s[0]]),
];

#[test]
fn every_standard_effect_that_is_no_torque_follows_its_law() {
    let others = standard_effects().iter().filter(|d| !d.acts.is_empty());
    let definitions: Vec<_> = others.collect();
    let names: Vec<&str> = definitions.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(names, ACTS.map(|(name, _)| name));
    for (definition, (name, law)) in definitions.iter().zip(ACTS) {
        assert!(definition.torques.is_empty() && definition.acts.len() == 1);
        for at in states() {
            let scope = scope(definition, &at, &[0, 1]);
            let values = definition.acts[0].values();
            let found: Vec<f64> = values.map(|x| value(x, &scope)).collect();
            let wanted = law(&at);
            assert_eq!(found.len(), wanted.len(), "{name}");
            for (found, wanted) in found.iter().zip(wanted) {
                // A handful of roundings.
                let bound = 1e-14 * (1.0 + wanted.abs());
                assert!(
                    (found - wanted).abs() < bound,
                    "{name}: {found} and {wanted}"
                );
            }
        }
    }
}

/// Rates of the internal states.
const RATES: [(&str, Law); 3] = [
    ("cable_hysteresis", |at| {
        // In the usual form, `dw/dt = dq (1 - |w|^n (B sign(dq w) + C))` of `w = width z`.
        let (width, beta, n) = (at.s[0], at.s[1], at.s[2]);
        let (b, c) = (beta / width.powf(n), (1.0 - beta) / width.powf(n));
        let w = width * at.z[0];
        at.dq[0] * (1.0 - w.abs().powf(n) * (b * (at.dq[0] * w).signum() + c)) / width
    }),
    ("dahl", |at| {
        at.dq[0] / at.s[0] * (1.0 - at.z[0] * at.dq[0].signum())
    }),
    ("lugre_presliding", lugre_rate),
];

#[test]
fn every_state_follows_its_law() {
    let with_states = standard_effects().iter().filter(|d| !d.states.is_empty());
    let definitions: Vec<_> = with_states.collect();
    let names: Vec<&str> = definitions.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(names, RATES.map(|(name, _)| name));
    for (definition, (name, law)) in definitions.iter().zip(RATES) {
        for at in states() {
            let rate = &definition.bindings[definition.states[0].rate].value;
            let (found, wanted) = (value(rate, &scope(definition, &at, &[0, 1])), law(&at));
            // A handful of roundings.
            assert!(
                (found - wanted).abs() < 1e-14 * (1.0 + wanted.abs()),
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
