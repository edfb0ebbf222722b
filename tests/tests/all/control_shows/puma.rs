//! The simulated arm, its sensors, and motions for it.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::{Mutex, PoisonError};

use robot_model::control::Safety;
use robot_model::log::Log;
use robot_model::simulate::{
    Controller, Desired, Loop, Measured, Plant, Record, Sensors, SimulateError, Tolerances,
    Trajectory,
};
use robot_model::{State, Vector};
use robot_model_cli::interpreted::InterpretedPlant;
use robot_model_codegen::base::shape_values;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::parameter::Status;
use robot_model_tests::specs;

#[allow(clippy::pedantic, reason = "derived, not written")]
mod page {
    robot_model::include_robot!("puma560_stribeck");
}
pub use page::Puma560;

/// Effects beside rotors, viscous and Coulomb friction.
pub const DRY: &str = "";
pub const STRIBECK: &str = "stribeck on all;";
/// A hand or a wall at the wrist, for three seconds.
pub const PUSHED: &str = "external_force(start = 1, end = 4) on wrist_yaw;";
pub const PUSH: [f64; 3] = [20.0, -15.0, 25.0];

/// Rotor inertia, viscous coefficient and Coulomb torque of each joint: P. Corke's values at the motors (Robotics Toolbox,
/// `mdl_puma560`) with the gear ratio once or twice, both directions' Coulomb torques averaged.
const ROTOR: [f64; 6] = [0.784, 2.325, 0.577, 0.191, 0.171, 0.194];
const VISCOUS: [f64; 6] = [5.80, 9.50, 3.98, 0.412, 0.427, 0.216];
const COULOMB: [f64; 6] = [25.98, 10.62, 6.36, 1.068, 0.854, 0.554];

/// Breaking away takes so much more than sliding does, and from this speed on, rad/s, little of it is left. These are not
/// Corke's.
const RISE: f64 = 0.4;
pub const SPEED: f64 = 0.05;

/// Largest torques: Armstrong, Khatib & Burdick 1986, table 7.
pub const TORQUE: [f64; 6] = [97.6, 186.4, 89.4, 24.2, 20.1, 21.3];

/// Far from singular poses.
pub const POSE: [f64; 6] = [0.2, 0.8, 2.6, 0.3, 0.8, 0.1];

/// The spec with an effect in the place of the wrist's coupling, which is left out.
pub fn compiled(effect: &str) -> Compiled {
    let text = specs::named("pass/puma560").text;
    let text = text.replace("gear_coupling on (wrist_pitch, wrist_yaw);", effect);
    let model =
        robot_model_spec::load("puma560.robot", &text).unwrap_or_else(|errors| panic!("{errors}"));
    compile_model(&model)
}

/// The base parameters that the arm has, in their order.
pub fn truth(compiled: &Compiled) -> Vec<f64> {
    let value = |name: &str, status: Status| {
        if let Status::Nominal(value) | Status::Fixed(value) = status {
            return value;
        }
        let (joint, parameter) = name.split_once('.').expect("JOINT.EFFECT.PARAMETER");
        let joints = &compiled.model.joints;
        let joint = joints.iter().position(|other| other.name == joint);
        let joint = joint.expect("effects are on joints");
        match parameter {
            "motor_inertia.ia" => ROTOR[joint],
            "viscous_friction.fv" => VISCOUS[joint],
            "coulomb_friction.fc" => COULOMB[joint],
            "stribeck.fs" => RISE * COULOMB[joint],
            "external_force.fx" => PUSH[0],
            "external_force.fy" => PUSH[1],
            "external_force.fz" => PUSH[2],
            _ => panic!("no value for {name}"),
        }
    };
    let standard = compiled.standard.iter();
    let standard: Vec<f64> = standard.map(|p| value(&p.name, p.status)).collect();
    compiled.base.beta(&standard)
}

/// Derived once: most runs are shorter than that takes.
pub fn plant(effect: &'static str) -> InterpretedPlant {
    static PLANTS: Mutex<BTreeMap<&str, InterpretedPlant>> = Mutex::new(BTreeMap::new());
    let mut plants = PLANTS.lock().unwrap_or_else(PoisonError::into_inner);
    plants
        .entry(effect)
        .or_insert_with(|| derived(effect))
        .clone()
}

fn derived(effect: &str) -> InterpretedPlant {
    let compiled = compiled(effect);
    let beta = truth(&compiled);
    let mut shapes = shape_values(&compiled.model);
    for (shape, name) in shapes.iter_mut().zip(compiled.shape_names()) {
        if name.ends_with("stribeck.vs") {
            *shape = SPEED;
        }
    }
    InterpretedPlant::new(compiled, &beta, &shapes).expect("sound")
}

/// Bits of the encoders: a thousand counts a turn of the motors are about as many at the joints.
pub const BITS: i32 = 16;

/// A thousand samples a second; velocities pass a filter at a twentieth of that.
pub fn setting(seconds: f64, bits: i32, seed: u64) -> Loop {
    Loop {
        rate: 1000.0,
        log_rate: 500.0,
        delay: 1,
        duration: seconds,
        sensors: Sensors {
            encoder_step: TAU / 2_f64.powi(bits),
            torque_noise: 0.02,
            velocity_hz: 50.0,
            seed,
            ..Sensors::default()
        },
        tolerances: Tolerances {
            relative: 1e-6,
            absolute: 1e-9,
            ..Tolerances::default()
        },
        ..Loop::default()
    }
}

pub fn run(
    plant: impl Plant,
    setting: &Loop,
    motion: &Trajectory,
    law: impl FnMut(&State<6>, &State<6>) -> Vector<6>,
) -> Result<Record, SimulateError> {
    let found = setting.run(plant, &mut Law(law), motion, &mut |_| ());
    found.map(|(record, _)| record)
}

pub fn log(record: Record) -> Log {
    Log::from_samples("puma", record.time, record.q, record.tau).expect("samples are in order")
}

pub fn limits() -> Safety<6> {
    Safety::new().torque(TORQUE)
}

/// A law of typed states as a controller.
struct Law<F>(F);

impl<F: FnMut(&State<6>, &State<6>) -> Vector<6>> Controller for Law<F> {
    fn torque(&mut self, measured: &Measured<'_>, desired: &Desired, torque: &mut [f64]) {
        let vector = |values: &[f64]| Vector::<6>::from_column_slice(values);
        let now = State {
            time: measured.time,
            ..State::new(vector(measured.q), vector(measured.dq), Vector::zeros())
        };
        let wanted = State::new(
            vector(&desired.q),
            vector(&desired.dq),
            vector(&desired.ddq),
        );
        torque.copy_from_slice((self.0)(&now, &wanted).as_slice());
    }
}

/// Sums of sines about [`POSE`], amplitudes in rad and frequencies in Hz; each joint has its own phases and is a little faster
/// than the one before.
pub fn waves(tones: &[(f64, f64)], phase: f64, seconds: f64) -> Trajectory {
    const STEP: f64 = 0.01;
    let samples = (0_i32..).map(|k| STEP * f64::from(k));
    let time: Vec<f64> = samples.take_while(|t| *t < seconds + 2.0 * STEP).collect();
    let column = |joint: usize, order: i32| -> Vec<f64> {
        let value = |t: &f64| {
            let start = if order == 0 { POSE[joint] } else { 0.0 };
            let tones = tones.iter().enumerate();
            let waves = tones.map(|(k, (size, hz))| {
                let w = TAU * hz * (1.0 + 0.06 * joint as f64);
                let angle = w * t + phase + 1.9 * joint as f64 + 2.6 * k as f64;
                // Each derivative is a quarter turn ahead.
                size * w.powi(order) * (angle + 0.25 * TAU * f64::from(order)).sin()
            });
            start + waves.sum::<f64>()
        };
        time.iter().map(value).collect()
    };
    let [q, dq, ddq] = [0, 1, 2].map(|order| (0..6).map(|joint| column(joint, order)).collect());
    Trajectory::new(time, q, dq, ddq, Vec::new()).expect("samples are in order")
}

pub fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| {
        (sum + value * value, count + 1.0)
    });
    (sum / count).sqrt()
}
