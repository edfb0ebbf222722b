//! Effects with a memory, and those that read a log: their physics, the emitted code, identification.

use std::f64::consts::TAU;

use robot_model::columns::Columns;
use robot_model::identify::{Identify, torque_of};
use robot_model::log::{Channel, Log};
use robot_model::motion::{Kinematics, Motion};
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;
use robot_model_tests::emitted::memory;
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
        "machine: the log has no column `temperature`, which a declared effect of the spec reads; log it, or take the \
         effect out of the spec"
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

/// The free functions of an arm whose effects remember: the interpreter's numbers.
#[test]
fn emitted_functions_of_effects_with_a_memory_agree_with_the_interpreter() {
    let interpreter = Interpreter::new(specs::named("pass/memory").compiled());
    let model = &interpreter.compiled.model;
    assert_eq!(model.inputs(), ["temperature", "current1", "current2"]);
    let mut random = states::generator(7);
    for _ in 0..20 {
        let standard = states::physical(&mut random, model);
        let state = states::state(&mut random, 2);
        let forms = interpreter.forms(&standard, &state);
        let load: Vec<f64> = interpreter
            .rigid_torque(&standard, &state)
            .as_slice()
            .to_vec();
        let rates = interpreter.state_rates(&standard, &state, &load);
        let array = |values: &[f64]| -> [f64; 2] { [values[0], values[1]] };
        let (q, dq, ddq) = (array(&state.q), array(&state.dq), array(&state.ddq));
        let measured = array(&state.measured_torque);
        let inputs: [f64; 3] = std::array::from_fn(|k| state.inputs[k]);
        let memory: [f64; 4] = std::array::from_fn(|k| state.states[k]);
        let beta = memory::base_parameters(&std::array::from_fn(|k| standard[k]));
        let tau = memory::inverse_dynamics(&q, &dq, &ddq, &measured, &inputs, &memory, &beta);
        let regressor = memory::base_regressor(&q, &dq, &ddq, &measured, &inputs, &memory);
        let close = |found: DMatrix<f64>, wanted: &DMatrix<f64>| {
            let difference = relative_difference(&found, wanted);
            assert!(difference < 1e-12, "{difference}");
        };
        close(DMatrix::from_row_slice(2, 1, &tau), &forms.inverse_dynamics);
        let rows: Vec<f64> = regressor.iter().flatten().copied().collect();
        close(
            DMatrix::from_row_slice(2, beta.len(), &rows),
            &forms.base_regressor,
        );
        let free = interpreter.compiled.free_shapes();
        let shapes: [f64; 2] = std::array::from_fn(|k| interpreter.shapes[free[k]]);
        let found = memory::state_rates(&q, &dq, &ddq, &memory, &shapes);
        close(DMatrix::from_row_slice(4, 1, &found), &rates);
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
}
