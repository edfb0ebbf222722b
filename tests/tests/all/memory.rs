//! Effects with a memory, and those that read a log: their physics, the emitted code, identification.

use std::f64::consts::TAU;

use robot_model::columns::Columns;
use robot_model::identify::{Identify, torque_of};
use robot_model::log::{Channel, Log};
use robot_model::motion::{Kinematics, Motion};
use robot_model::{FromParameters, Memory, RobotModel, Vector};
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;
use robot_model_tests::emitted;
use robot_model_tests::evaluate::{Interpreter, relative_difference};
use robot_model_tests::{specs, states};

use nalgebra::DMatrix;

/// A joint that no gravity loads, with effects.
fn joint(effects: &str, definitions: &str) -> InterpretedArm {
    let text = format!(
        "robot Rig {{ gravity = [0, 0, 0]; convention = standard_dh; \
         joint j: revolute {{ a = 0; alpha = 0; d = 0; }} effects {{ {effects} }} }} {definitions}"
    );
    let model = robot_model_spec::load("rig.robot", &text).unwrap_or_else(|e| panic!("{e}"));
    InterpretedArm::new(compile_model(&model))
}

/// A motion of one joint at a rate in Hz, from its position and its derivatives.
fn motion(rate: f64, seconds: f64, at: impl Fn(f64) -> [f64; 3]) -> Motion {
    let count = (0..).take_while(|&k| f64::from(k) / rate < seconds);
    let time: Vec<f64> = count.map(|k| f64::from(k) / rate).collect();
    let signal = |k: usize| vec![time.iter().map(|&t| at(t)[k]).collect()];
    let exact = Kinematics {
        q: signal(0),
        dq: signal(1),
        ddq: signal(2),
    };
    Motion {
        smooth: exact.clone(),
        wide: exact,
        time,
        ..Motion::default()
    }
}

/// Torque of the effects with the given values of their linear parameters, by name; others are 0.
fn torque(arm: &InterpretedArm, motion: &Motion, values: &[(&str, f64)]) -> Vec<f64> {
    let estimate: Vec<f64> = arm
        .unknowns()
        .iter()
        .map(|unknown| {
            let given = values.iter().find(|(name, _)| unknown.name == *name);
            given.map_or(0.0, |(_, value)| *value)
        })
        .collect();
    torque_of(arm, motion, &[], &estimate, 1).remove(0)
}

/// After any transient the bristles stand still: friction is Stribeck's curve.
#[test]
fn lugre_at_constant_speed_is_the_stribeck_curve() {
    let (fc, d, vs, rise) = (2.0, 0.01, 0.1, 0.6);
    let arm = joint("lugre_presliding(d = 0.01, vs = 0.1, rise = 0.6) on j;", "");
    for speed in [-1.3, -0.07, 0.02, 0.2, 2.5_f64] {
        let seconds = 60.0 * d / speed.abs();
        let rate = 500.0 / seconds;
        let motion = motion(rate, seconds, |t| [speed * t, speed, 0.0]);
        let values = [
            ("j.lugre_presliding.fc", fc),
            ("j.lugre_presliding.s1", 0.7),
        ];
        let found = *torque(&arm, &motion, &values).last().unwrap();
        let wanted = fc * (1.0 + rise * (-(speed / vs).powi(2)).exp()) * speed.signum();
        assert!((found - wanted).abs() < 1e-9, "{speed}: {found} {wanted}");
    }
}

/// Hysteresis takes energy out of every closed loop, and as much at any speed.
#[test]
fn loops_of_hysteresis_dissipate_at_any_speed() {
    for effect in [
        "dahl(d = 0.05) on j;",
        "cable_hysteresis(width = 0.1, beta = 0.75, n = 1.5) on j;",
        "lugre_presliding(d = 0.05, vs = 0.1, rise = 0) on j;",
    ] {
        let arm = joint(effect, "");
        let name = arm.unknowns().last().unwrap().name.clone();
        let name = name.replace(".s1", ".fc");
        let loop_energy = |hz: f64| {
            let rate = 4000.0 * hz;
            let w = TAU * hz;
            let motion = motion(rate, 3.0 / hz, |t| {
                [
                    0.2 * (w * t).sin(),
                    0.2 * w * (w * t).cos(),
                    -0.2 * w * w * (w * t).sin(),
                ]
            });
            let torque = torque(&arm, &motion, &[(&name, 1.0)]);
            // The third period: the first ones are not closed.
            let power = torque
                .iter()
                .zip(&motion.wide.dq[0])
                .map(|(tau, dq)| tau * dq / rate);
            power.skip(8000).take(4000).sum::<f64>()
        };
        let (slow, fast) = (loop_energy(0.1), loop_energy(3.0));
        // Coulomb friction would take 4 * 0.2 = 0.8 J, elasticity nothing.
        assert!((0.2..0.8).contains(&slow), "{effect}: {slow} J");
        assert!((slow - fast).abs() < 1e-9, "{effect}: {slow} {fast} J");
    }
}

const DAMPER: &str = "effect damper(j) { linear k >= 0; shape relaxation in 0.01 .. 10; state z; \
    dot(z) = dq(j) - z / relaxation; torque(j) = k * z; }";

/// A user's own effect with a memory, its shape free: identified from its log like a standard one.
#[test]
fn an_own_effect_with_a_memory_is_identified() {
    let machine = joint(
        "damper(relaxation = 0.4) on j; coulomb_friction on j;",
        DAMPER,
    );
    // Sums of sines without a common period.
    let waves = [(0.9, 0.37, 0.2), (0.5, 0.83, 1.1), (0.2, 1.9, 2.3)];
    let at = |t: f64| {
        let mut sum = [0.0; 3];
        for (amplitude, hz, phase) in waves {
            let (w, angle) = (TAU * hz, TAU * hz * t + phase);
            sum[0] += amplitude * angle.sin();
            sum[1] += amplitude * w * angle.cos();
            sum[2] -= amplitude * w * w * angle.sin();
        }
        sum
    };
    let motion = motion(500.0, 20.0, at);
    let truth = [
        ("j.izz", 0.3),
        ("j.damper.k", 6.0),
        ("j.coulomb_friction.fc", 0.5),
    ];
    let tau = torque(&machine, &motion, &truth);
    let log = Log::from_samples("machine", motion.time, motion.smooth.q, vec![tau])
        .unwrap_or_else(|error| panic!("{error}"));

    let arm = joint("damper on j; coulomb_friction on j;", DAMPER);
    let estimate = Identify::default()
        .fit(&arm, &[log])
        .unwrap_or_else(|error| panic!("{error}"));
    for (name, wanted) in truth {
        let found = estimate.parameters.iter().find(|p| p.name == name);
        let found = found.unwrap_or_else(|| panic!("no {name}")).value;
        assert!((found - wanted).abs() < 0.02 * wanted, "{name}: {found}");
    }
    let (name, value) = &estimate.shapes[0];
    assert_eq!(name, "j.damper.relaxation");
    // The search narrows the grid's intervals a hundred times.
    assert!((value - 0.4).abs() < 0.02, "{value}");
}

/// A declared effect asks for its column; with it the column is read.
#[test]
fn a_column_that_an_effect_reads_must_be_there() {
    let arm = joint("temperature_viscous on j; coulomb_friction on j;", "");
    assert_eq!(arm.inputs(), ["temperature"]);
    let motion = motion(200.0, 60.0, |t| {
        let w = 1.7;
        [(w * t).sin(), w * (w * t).cos(), -w * w * (w * t).sin()]
    });
    let temperature: Vec<f64> = motion
        .time
        .iter()
        .map(|t| 45.0 - 25.0 * (-t / 30.0).exp())
        .collect();
    let law = |k: usize| {
        let (dq, ddq) = (motion.smooth.dq[0][k], motion.smooth.ddq[0][k]);
        0.4 * ddq + 1.5 * (-0.03 * (temperature[k] - 20.0)).exp() * dq + 0.2 * dq.signum()
    };
    let tau: Vec<f64> = (0..motion.time.len()).map(law).collect();
    let mut log = Log::from_samples(
        "machine",
        motion.time.clone(),
        motion.smooth.q.clone(),
        vec![tau],
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let refused = Identify::default().fit(&arm, &[log.clone()]).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "machine: the log has no column `temperature`, which a declared effect of the spec reads; log it, or remove the effect from the spec"
    );
    log.extra.push(Channel {
        name: "temperature".to_owned(),
        values: temperature.clone(),
    });
    let estimate = Identify::default()
        .fit(&arm, &[log])
        .unwrap_or_else(|error| panic!("{error}"));
    let found = estimate
        .parameters
        .iter()
        .find(|p| p.name == "j.temperature_viscous.fv");
    let found = found.map(|p| p.value).unwrap();
    assert!((found - 1.5).abs() < 0.02, "{found}");
    assert!(
        (estimate.shapes[0].1 - 0.03).abs() < 0.002,
        "{:?}",
        estimate.shapes
    );
}

/// Rates and a step of every emitted arm with internal states: the interpreter's numbers. Its torque and regressors are
/// compared with those of all arms.
#[test]
fn emitted_states_agree_with_the_interpreter() {
    assert_states_agree::<emitted::memory::Memory, _, _, _, _, _, _>("pass/memory");
    assert_states_agree::<emitted::lugre_link::LugreLink, _, _, _, _, _, _>("pass/lugre_link");
    assert_eq!(
        emitted::memory::Memory::INPUTS,
        ["temperature", "current1", "current2"]
    );
}

fn assert_states_agree<
    R,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>(
    spec: &str,
) where
    R: Memory<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
        + FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
{
    let interpreter = Interpreter::new(specs::named(spec).compiled());
    let model = &interpreter.compiled.model;
    assert_eq!(R::STATES.as_slice(), model.states());
    assert_eq!(R::INPUTS.as_slice(), model.inputs());
    let mut random = states::generator(7);
    for _ in 0..20 {
        let standard = states::physical(&mut random, model);
        let state = states::state(&mut random, DOF);
        let load = interpreter.rigid_torque(&standard, &state);
        let wanted = interpreter.state_rates(&standard, &state, load.as_slice());
        let arm = R::from_standard(&Vector::from_column_slice(&standard));
        let typed = states::typed::<DOF, STATES, INPUTS>(&state);
        let column =
            |values: Vector<STATES>| DMatrix::from_column_slice(STATES, 1, values.as_slice());
        let rates = arm.state_rates(&typed);
        let difference = relative_difference(&column(rates), &wanted);
        assert!(difference < 1e-12, "{spec}: {difference}");
        // Against the classical Runge-Kutta method in steps too small for it to err, all else held.
        let (seconds, steps) = (2e-5, 200);
        let after = column(arm.memory_after(&typed, seconds));
        let mut z = column(typed.memory);
        let rate = |z: DMatrix<f64>| {
            let mut state = state.clone();
            state.states[..STATES].copy_from_slice(z.as_slice());
            interpreter.state_rates(&standard, &state, load.as_slice())
        };
        let h = seconds / f64::from(steps);
        for _ in 0..steps {
            let k1 = rate(z.clone());
            let k2 = rate(&z + &k1 * (0.5 * h));
            let k3 = rate(&z + &k2 * (0.5 * h));
            let k4 = rate(&z + &k3 * h);
            z += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
        }
        let change = (&z - column(typed.memory)).amax();
        let error = (after - z).amax();
        // Of second order where rates are not affine in the states, so in proportion to `seconds` squared.
        assert!(error < 1e-6 * change, "{spec}: {error} of {change}");
    }
}

/// Pages as a program includes them that needs nothing of them yet: no warning, in a private module of a binary.
#[deny(warnings)]
#[allow(clippy::pedantic, reason = "derived, not written")]
mod nothing_is_used {
    mod fixed_arm {
        robot_model::include_robot!("fixed_arm");
    }
    mod known_springs {
        robot_model::include_robot!("known_springs");
    }
    mod lugre_link {
        robot_model::include_robot!("lugre_link");
    }
    mod memory {
        robot_model::include_robot!("memory");
    }
    mod two_link {
        robot_model::include_robot!("two_link");
    }
    /// Beside the runtime's names, and one that is called as its trait.
    #[expect(unused_imports, reason = "a page names nothing that users import")]
    mod odd_angles {
        use robot_model::{FromParameters, Memory, RobotModel, State, memory, solve};
        robot_model::include_robot!("odd_angles");
    }
    mod lone_slide {
        robot_model::include_robot!("lone_slide");
    }
}
