//! Slopes through memory against differences, and orbits against closed forms.

use robot_model::excite::Function;
use robot_model::motion::Kinematics;
use robot_model_codegen::{Compiled, Nominal, RivalColumns, compile_model};

use crate::interpreted::InterpretedFunction;

const PERIOD: f64 = 4.0;

/// Two joints that turn about one axis, with an effect on the second.
fn arm(effect: &str) -> Compiled {
    let text = format!(
        "effect slow(j) {{
            linear k;
            state z;
            dot(z) = (dq(j)^2 - z) / 600;
            torque(j) = k * z;
        }}
        effect swing(j) {{
            linear k;
            state x, v;
            dot(x) = v;
            dot(v) = 20 * (q(j) - x) - 0.3 * v - x^3;
            torque(j) = k * x;
        }}
        robot Table {{
            convention = standard_dh;
            gravity = [0, 0, 0];
            joint base: revolute {{ a = 0.4 m; alpha = 0; d = 0; }}
            joint tool: revolute {{ a = 0.3 m; alpha = 0; d = 0; }}
            effects {{ {effect} on tool; }}
        }}"
    );
    let model = robot_model_spec::load("table.robot", &text);
    compile_model(&model.unwrap_or_else(|error| panic!("{error}")))
}

/// A period of both joints that reverses several times.
fn motion(samples: usize) -> Kinematics {
    let wave = |order: u32, scale: f64| -> Vec<f64> {
        let omega = std::f64::consts::TAU / PERIOD;
        let turn = f64::from(order) * std::f64::consts::FRAC_PI_2;
        let at = |t: f64| {
            let waves = [(1.0, 0.3, 0.4), (2.0, 1.1, 0.25), (3.0, 2.0, 0.1)];
            let part = |(k, phase, size): (f64, f64, f64)| {
                size * (k * omega).powi(order.cast_signed()) * (k * omega * t + phase + turn).sin()
            };
            waves.into_iter().map(part).sum::<f64>() * scale
        };
        (0..samples)
            .map(|k| at(PERIOD * k as f64 / samples as f64))
            .collect()
    };
    let both = |order| vec![wave(order, 0.7), wave(order, 1.0)];
    Kinematics {
        q: both(0),
        dq: both(1),
        ddq: both(2),
    }
}

fn columns(compiled: &Compiled, shapes: &[f64]) -> InterpretedFunction {
    let nominal = Nominal {
        beta: vec![1.0; compiled.base.names.len()],
        shapes: shapes.to_vec(),
        turn: vec![0.01; 2],
    };
    let columns = compiled.design_columns(&nominal, &RivalColumns::default());
    assert!(columns.left_out.is_empty(), "{:?}", columns.left_out);
    InterpretedFunction::new(columns.function, 2, PERIOD)
}

#[test]
fn slopes_go_through_memory() {
    for (effect, shapes) in [
        ("dahl", vec![0.08]),
        ("lugre_presliding", vec![0.05, 0.2, 0.6]),
        ("cable_hysteresis", vec![0.2, 0.7, 1.5]),
        ("slow", vec![]),
        ("swing", vec![]),
    ] {
        let compiled = arm(effect);
        let function = columns(&compiled, &shapes);
        let at = motion(60);
        let values = function.values(&at);
        let weights: Vec<Vec<f64>> = values
            .iter()
            .enumerate()
            .map(|(k, output)| {
                let weight = |s: usize| (0.7 * s as f64 + 1.3 * k as f64).cos();
                (0..output.len()).map(weight).collect()
            })
            .collect();
        let sum = |motion: &Kinematics| -> f64 {
            let outputs = function.values(motion).into_iter().zip(&weights);
            let sums = outputs.map(|(values, weights)| {
                let pairs = values.iter().zip(weights);
                pairs.map(|(x, w)| x * w).sum::<f64>()
            });
            sums.sum()
        };
        let slopes = function.pullback(&at, &weights);
        for sample in [0, 7, 23, 31, 44, 59] {
            let moved = |by: f64| {
                let mut moved = at.clone();
                moved.dq[1][sample] += by;
                sum(&moved)
            };
            let h = 1e-6;
            let numeric = (moved(h) - moved(-h)) / (2.0 * h);
            let exact = slopes.dq[1][sample];
            assert!(
                (numeric - exact).abs() < 1e-5 * (1.0 + exact.abs()),
                "{effect} at {sample}: {numeric} {exact}"
            );
            let moved = |by: f64| {
                let mut moved = at.clone();
                moved.q[1][sample] += by;
                sum(&moved)
            };
            let numeric = (moved(h) - moved(-h)) / (2.0 * h);
            let exact = slopes.q[1][sample];
            assert!(
                (numeric - exact).abs() < 1e-5 * (1.0 + exact.abs()),
                "{effect} at {sample}: {numeric} {exact}"
            );
        }
    }
}

/// Far behind a reversal, Dahl's friction is `1 - 2 exp(-distance / d)` of sliding: the states of the first sample know the
/// period before.
#[test]
fn a_period_begins_as_the_last_one_ended() {
    let compiled = arm("dahl");
    let function = columns(&compiled, &[0.05]);
    let samples = 4000;
    let at = motion(samples);
    let friction = function.values(&at);
    // The only output that is at most 1 and reaches it.
    let is_share = |values: &&Vec<f64>| {
        let most = values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        (0.98..=1.0).contains(&most)
    };
    let z = friction
        .iter()
        .find(is_share)
        .expect("a column of Dahl's friction");
    let mut worst = 0.0_f64;
    for sample in 0..samples {
        let before = (sample + samples - 1) % samples;
        let travel = at.q[1][sample] - at.q[1][before];
        let sign = travel.signum();
        let wanted = sign + (z[before] - sign) * (-travel.abs() / 0.05).exp();
        worst = worst.max((z[sample] - wanted).abs());
    }
    assert!(worst < 1e-3, "{worst}");
}

/// A state that takes a hundred periods to settle is at its mean.
#[test]
fn a_slow_state_is_where_it_ends_up() {
    let function = columns(&arm("slow"), &[]);
    let at = motion(200);
    let mean = at.dq[1].iter().map(|v| v * v).sum::<f64>() / 200.0;
    let values = function.values(&at);
    let is_level = |values: &&Vec<f64>| values.iter().all(|z| (z - mean).abs() < 0.02 * mean);
    assert!(values.iter().any(|output| is_level(&output)), "{mean}");
}

/// What a search sees on few samples is what is verified on many, however short the distance over which friction builds up.
#[test]
fn few_samples_see_what_many_see() {
    for (effect, shapes) in [
        ("dahl", vec![2e-3]),
        ("lugre_presliding", vec![5e-3, 0.05, 0.6]),
        ("cable_hysteresis", vec![0.02, 0.5, 1.0]),
    ] {
        let function = columns(&arm(effect), &shapes);
        let square = |samples: usize| -> Vec<f64> {
            let values = function.values(&motion(samples));
            let mean = |x: &Vec<f64>| x.iter().map(|x| x * x).sum::<f64>() / samples as f64;
            values.iter().map(mean).collect()
        };
        let (few, many) = (square(200), square(4000));
        for (few, many) in few.iter().zip(&many) {
            assert!((few - many).abs() < 0.03 * many, "{effect}: {few} {many}");
        }
    }
}
