//! Effects that are no torques, identified from simulated logs: the plant is the numeric twin of an arm that has the change in its
//! own spec, or stands and is timed otherwise than its log says.

use std::f64::consts::TAU;

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::identify::{Estimate, Identify};
use robot_model::log::Log;
use robot_model_cli::interpreted::{InterpretedArm, InterpretedMomentum};
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::Model;
use robot_model_spec::parameter::Status;
use robot_model_tests::states::{self, State};
use robot_model_tests::twin::Twin;

/// Of an encoder with 20 bits, rad.
const ENCODER_STEP: f64 = TAU / 1_048_576.0;
/// Standard deviation of a torque sample, N m.
const NOISE: f64 = 0.05;
const RATE_HZ: f64 = 500.0;
const SECONDS: f64 = 20.0;

/// Inertials of the three links.
const LINKS: [&str; 3] = [
    "mass = 4; com = [0, 0, -0.2]; inertia = [0.2, 0, 0, 0.2, 0, 0.05];",
    "mass = 5; com = [-0.2, 0.01, 0.03]; inertia = [0.04, 0.01, 0, 0.3, 0, 0.3];",
    "mass = 2; com = [-0.15, 0, 0.02]; inertia = [0.01, 0, 0.002, 0.06, 0, 0.06];",
];

/// A spec of an elbow arm; `status` is that of its links, `tip` replaces the last one.
fn spec(gravity: [f64; 3], status: &str, tip: &str, effects: &str) -> Compiled {
    let names = ["turn", "lift", "bend"];
    let links: Vec<String> = names
        .iter()
        .zip([LINKS[0], LINKS[1], tip])
        .map(|(name, inertial)| format!("link {name}: {status} {{ {inertial} }}"))
        .collect();
    let links = links.concat();
    let text = format!(
        "robot Elbow {{ gravity = {gravity:?}; convention = standard_dh; \
         joint turn: revolute {{ a = 0; alpha = 90 deg; d = 0.4; }} \
         joint lift: revolute {{ a = 0.5; alpha = 0; d = 0; }} \
         joint bend: revolute {{ a = 0.4; alpha = 0; d = 0; }} {links} effects {{ {effects} }} }}"
    );
    let model = robot_model_spec::load("elbow.robot", &text).unwrap_or_else(|e| panic!("{e}"));
    compile_model(&model)
}

const DOWN: [f64; 3] = [0.0, 0.0, -9.81];

fn declared(effects: &str) -> Compiled {
    spec(DOWN, "fixed", LINKS[2], effects)
}

/// The plant without effects, its links as numbers.
fn plant(gravity: [f64; 3], tip: &str) -> Model {
    spec(gravity, "fixed", tip, "").model
}

/// Where the links are: sums of sines, a few of them fast.
fn links_at(time: f64, seed: f64) -> State {
    let mut state = State {
        time,
        ..State::default()
    };
    for joint in 0..3_u8 {
        let (mut q, mut dq, mut ddq) = (0.0, 0.0, 0.0);
        for harmonic in 1..=5_u8 {
            let (k, j) = (f64::from(harmonic), f64::from(joint));
            let w = TAU * 0.13 * k * (1.0 + 0.07 * j);
            let (amplitude, phase) = (0.5 / k, seed + 1.7 * k * (1.0 + j));
            q += amplitude * (w * time + phase).sin();
            dq += amplitude * w * (w * time + phase).cos();
            ddq -= amplitude * w * w * (w * time + phase).sin();
        }
        state.q.push(q);
        state.dq.push(dq);
        state.ddq.push(ddq);
    }
    state
}

/// A log: `measure` has the positions and torques that are read while the links are in a state under a load.
fn log(model: &Model, seed: u64, measure: impl Fn(&State, &[f64]) -> (Vec<f64>, Vec<f64>)) -> Log {
    let standard = values(&compile_model(model));
    let twin = Twin::new(model, Vec::new());
    let mut random = states::generator(seed);
    let (mut time, mut q, mut tau) = (Vec::new(), vec![Vec::new(); 3], vec![Vec::new(); 3]);
    for k in 0..10_000 {
        let t = f64::from(k) / RATE_HZ;
        if t > SECONDS {
            break;
        }
        let state = links_at(t, seed as f64);
        let load = twin.rigid_torque(&standard, &state);
        let (positions, torques) = measure(&state, &load);
        time.push(t);
        for joint in 0..3 {
            q[joint].push((positions[joint] / ENCODER_STEP).round() * ENCODER_STEP);
            tau[joint].push(torques[joint] + NOISE * normal(&mut random));
        }
    }
    Log::from_samples("a plant", time, q, tau).expect("samples are in order")
}

/// What the spec fixes; effects' parameters are 0.
fn values(compiled: &Compiled) -> Vec<f64> {
    let parameters = compiled.standard.iter();
    parameters
        .map(|parameter| match parameter.status {
            Status::Fixed(value) => value,
            Status::Unknown | Status::Nominal(_) => 0.0,
        })
        .collect()
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Identified values by name, and the error on a log that was not fitted.
struct Found {
    estimate: Estimate,
    rmse: Vec<f64>,
}

impl Found {
    fn value(&self, name: &str) -> f64 {
        let shapes = self.estimate.shapes.iter();
        let linear = self.estimate.parameters.iter();
        linear
            .map(|p| (&p.name, p.value))
            .chain(shapes.map(|(name, value)| (name, *value)))
            .find(|(found, _)| *found == name)
            .unwrap_or_else(|| panic!("no `{name}` in\n{}", self.estimate))
            .1
    }

    /// What stays is the noise of the torque, with a part of it for encoder steps that accelerations see.
    fn leaves_noise_alone(&self, part: f64) {
        for rmse in &self.rmse {
            let bound = (1.0 + part) * NOISE;
            assert!(*rmse < bound, "{:?}\n{}", self.rmse, self.estimate);
        }
    }
}

fn identify(compiled: Compiled, log: impl Fn(u64) -> Log) -> Found {
    let arm = InterpretedArm::new(compiled);
    let estimate = Identify::default()
        .fit(&arm, &[log(1)])
        .expect("a log of the arm");
    let errors = estimate.errors(&arm, &log(2)).expect("a log of the arm");
    Found {
        estimate,
        rmse: errors.rmse,
    }
}

/// `|found - wanted| < part |wanted|`
fn close(found: f64, wanted: f64, part: f64) {
    assert!(
        (found - wanted).abs() < part * wanted.abs(),
        "{found} for {wanted}"
    );
}

fn as_logged(state: &State, load: &[f64]) -> (Vec<f64>, Vec<f64>) {
    (state.q.clone(), load.to_vec())
}

/// The tip with 0.8 kg at (0.05, 0, 0.06) of its frame: masses, first moments and inertias add.
#[test]
fn a_payload_is_weighed() {
    let (mass, at) = (0.8, [0.05, 0.0, 0.06]);
    let sum = 2.0 + mass;
    let com: Vec<f64> = [-0.15, 0.0, 0.02]
        .iter()
        .zip(at)
        .map(|(own, more)| (2.0 * own + mass * more) / sum)
        .collect();
    // About each center of mass, moved to the common one: the reduced mass at their distance.
    let (reduced, d) = (2.0 * mass / sum, [0.2, 0.0, 0.04]);
    let inertia = [
        0.01 + reduced * d[2] * d[2],
        0.0,
        0.002 - reduced * d[0] * d[2],
        0.06 + reduced * (d[0] * d[0] + d[2] * d[2]),
        0.0,
        0.06 + reduced * d[0] * d[0],
    ];
    let tip = format!("mass = {sum}; com = {com:?}; inertia = {inertia:?};");
    let model = plant(DOWN, &tip);
    for effect in ["payload", "link_inertial_error"] {
        let found = identify(declared(&format!("{effect} on bend;")), |seed| {
            log(&model, seed, as_logged)
        });
        found.leaves_noise_alone(0.15);
        let value = |element: &str| found.value(&format!("bend.{effect}.{element}"));
        close(value("m"), mass, 0.01);
        close(value("mx"), mass * at[0], 0.05);
        close(value("mz"), mass * at[2], 0.1);
    }
}

/// The twin holds the force by virtual work in the base frame.
#[test]
fn a_hand_on_the_tip_is_felt() {
    let effect = "external_force(start = 4, end = 9) on bend;";
    let touched = declared(effect);
    let push = [12.0, -7.0, 5.0];
    let twin = Twin::new(&touched.model, vec![4.0, 9.0]);
    let mut standard = values(&touched);
    let count = standard.len();
    standard[count - 3..].copy_from_slice(&push);
    let found = identify(touched.clone(), |seed| {
        log(&plant(DOWN, LINKS[2]), seed, |state, load| {
            let held = twin.effect_torque(&standard, state);
            let sum = load.iter().zip(held).map(|(l, h)| l + h);
            (state.q.clone(), sum.collect())
        })
    });
    // Where the hand comes and goes the torque jumps, which is not there on raw samples of a filtered model.
    found.leaves_noise_alone(0.5);
    for (name, push) in ["fx", "fy", "fz"].iter().zip(push) {
        let value = found.value(&format!("bend.external_force.{name}"));
        close(value, push, 0.02);
    }
}

#[test]
fn a_base_that_leans_is_found() {
    let (first, second) = (0.07_f64, -0.035_f64);
    // Gravity in the base frame, turned about x and then about the new y.
    let (a, b) = (first.sin_cos(), second.sin_cos());
    let gravity = [9.81 * a.1 * b.0, -9.81 * a.0, -9.81 * a.1 * b.1];
    let model = plant(gravity, LINKS[2]);
    let unknown = spec(
        DOWN,
        "nominal",
        LINKS[2],
        "base_tilt; viscous_friction on all;",
    );
    for compiled in [declared("base_tilt; viscous_friction on all;"), unknown] {
        let found = identify(compiled, |seed| log(&model, seed, as_logged));
        found.leaves_noise_alone(0.15);
        close(found.value("base_tilt.first"), first, 0.02);
        close(found.value("base_tilt.second"), second, 0.02);
    }
}

#[test]
fn a_zero_that_is_elsewhere_is_found() {
    let offset = 0.06;
    let model = plant(DOWN, LINKS[2]);
    let found = identify(declared("encoder_offset on bend;"), |seed| {
        log(&model, seed, |state, load| {
            let mut q = state.q.clone();
            q[2] += offset;
            (q, load.to_vec())
        })
    });
    found.leaves_noise_alone(0.15);
    close(found.value("bend.encoder_offset.offset"), offset, 0.01);
}

#[test]
fn a_late_torque_is_found() {
    let late = 0.0125;
    let model = plant(DOWN, LINKS[2]);
    let twin = Twin::new(&model, Vec::new());
    let standard = values(&compile_model(&model));
    let delayed = |seed: u64| {
        log(&model, seed, |state, _| {
            let before = links_at(state.time - late, seed as f64);
            (state.q.clone(), twin.rigid_torque(&standard, &before))
        })
    };
    let effects = "time_delay; viscous_friction on all;";
    for compiled in [declared(effects), spec(DOWN, "nominal", LINKS[2], effects)] {
        let found = identify(compiled, delayed);
        found.leaves_noise_alone(0.15);
        close(found.value("time_delay.delay"), late, 0.02);
    }
}

#[test]
fn a_spring_in_the_transmission_is_found() {
    let stiffness = 900.0;
    let model = plant(DOWN, LINKS[2]);
    let found = identify(declared("joint_elasticity on lift;"), |seed| {
        log(&model, seed, |state, load| {
            let mut q = state.q.clone();
            q[1] += load[1] / stiffness;
            (q, load.to_vec())
        })
    });
    // The spring is bent by the logged torque, noise and all.
    found.leaves_noise_alone(1.0);
    close(
        found.value("lift.joint_elasticity.stiffness"),
        stiffness,
        0.02,
    );
}

#[test]
fn play_between_motor_and_link_is_found() {
    let half_gap = 0.004;
    let model = plant(DOWN, LINKS[2]);
    let found = identify(declared("backlash on bend;"), |seed| {
        log(&model, seed, |state, load| {
            let mut q = state.q.clone();
            q[2] += half_gap * load[2].signum();
            (q, load.to_vec())
        })
    });
    close(found.value("bend.backlash.half_gap"), half_gap, 0.1);
}

/// What is constant is in the momentum form too, and what moves links is refused with the reason.
#[test]
fn the_filtered_form_has_what_is_constant() {
    let offset = 0.06;
    let model = plant(DOWN, LINKS[2]);
    let shifted = |seed| {
        log(&model, seed, |state, load| {
            let mut q = state.q.clone();
            q[2] += offset;
            (q, load.to_vec())
        })
    };
    let arm =
        InterpretedMomentum::new(declared("encoder_offset on bend; viscous_friction on all;"))
            .expect("offsets are constant");
    let estimate = Identify::default()
        .fit_filtered(&arm, &[shifted(1)], None)
        .expect("a log of the arm");
    close(estimate.shapes[0].1, offset, 0.01);

    let soft = declared("joint_elasticity on lift;");
    let refusal = InterpretedMomentum::new(soft.clone())
        .map(|_| ())
        .unwrap_err();
    assert_eq!(
        refusal.to_string(),
        "elbow.robot:1: `joint_elasticity` has no filtered form: it displaces a link depending on the motion; identify with `--form \
         acceleration`, or take the effect out"
    );
    let refusal = soft.check_instantaneous().unwrap_err().to_string();
    assert!(
        refusal.starts_with(
            "elbow.robot:1: `joint_elasticity` displaces a link depending on the motion, so"
        ),
        "{refusal}"
    );
}
