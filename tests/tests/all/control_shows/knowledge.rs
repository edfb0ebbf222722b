//! What a controller may know of the arm.

use std::sync::LazyLock;

use rand::RngExt as _;
use robot_model::control::{ComputedTorque, Gains};
use robot_model::identify::Identify;
use robot_model::log::Log;
use robot_model::{FromParameters as _, RobotModel as _, Vector};
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_tests::states::generator;

use super::puma::{
    BITS, DRY, Puma560, SPEED, compiled, limits, log, plant, run, setting, truth, waves,
};

/// How far CAD values are off.
const OFF: f64 = 0.15;

/// Base parameters by name; those that are not among them are zero. One Stribeck speed for all joints, rad/s.
#[derive(Debug, Clone)]
pub struct Knowledge {
    beta: Vec<(String, f64)>,
    speed: f64,
}

impl Knowledge {
    /// The arm without Stribeck friction as it is.
    pub fn exact() -> Self {
        static EXACT: LazyLock<Knowledge> = LazyLock::new(|| {
            let compiled = compiled(DRY);
            let names = compiled.base.names.iter().cloned();
            Knowledge {
                beta: names.zip(truth(&compiled)).collect(),
                speed: SPEED,
            }
        });
        EXACT.clone()
    }

    /// Every base parameter off by 15 % of it, upwards where `is_more` says so.
    ///
    /// Base parameters are all that a torque depends on. The same share of the standard ones would be another error in every
    /// choice of link frames: about the far end of the upper arm it would be several times the arm's inertia.
    pub fn cad(mut is_more: impl FnMut() -> bool) -> Self {
        let mut cad = Self::exact();
        for (_, value) in &mut cad.beta {
            *value *= if is_more() { 1.0 + OFF } else { 1.0 - OFF };
        }
        cad
    }

    /// Upwards and downwards by chance.
    pub fn mixed_cad(seed: u64) -> Self {
        let mut random = generator(seed);
        Self::cad(|| random.random_bool(0.5))
    }

    /// From logs of the arm, with the sum of the joints' residuals in percent.
    fn fit(effect: &str, logs: &[Log]) -> (Self, f64) {
        let arm = InterpretedArm::new(compiled(effect));
        let estimate = Identify::default().fit(&arm, logs);
        let estimate = estimate.unwrap_or_else(|error| panic!("{error}"));
        let parameters = estimate.parameters.iter();
        let beta = parameters.map(|p| (p.name.clone(), p.value)).collect();
        let known = Self { beta, speed: SPEED };
        (known, estimate.relative_percent.iter().sum())
    }

    /// With viscous and Coulomb friction.
    pub fn identified(logs: &[Log]) -> Self {
        Self::fit(DRY, logs).0
    }

    /// With Stribeck friction too; its speed is that of three which explains the logs best.
    pub fn identified_with_stribeck(logs: &[Log]) -> Self {
        let fits = [0.03, 0.06, 0.12].map(|speed| {
            let (known, residual) = Self::fit(&format!("stribeck(vs = {speed}) on all;"), logs);
            (Self { speed, ..known }, residual)
        });
        let best = fits.into_iter().min_by(|x, y| x.1.total_cmp(&y.1));
        best.expect("there are three").0
    }

    pub fn arm(&self) -> Puma560 {
        let names = Puma560::BASE_PARAMETERS;
        for (name, _) in &self.beta {
            assert!(names.contains(&name.as_str()), "{name}");
        }
        let value = |name: &str| {
            let found = self.beta.iter().find(|(own, _)| own == name);
            found.map_or(0.0, |(_, value)| *value)
        };
        let beta = Vector::from(names.map(value));
        Puma560::from_parameters(&Puma560::standard_of(&beta), &Vector::repeat(self.speed))
    }

    /// Computed torque with a natural frequency of the errors, rad/s.
    pub fn computed_torque(&self, frequency: f64) -> ComputedTorque<Puma560, 6> {
        ComputedTorque::new(self.arm(), Gains::critically_damped(frequency))
            .and_then(|control| control.with_safety(limits()))
            .expect("positive gains and limits")
    }
}

/// Amplitudes in rad and frequencies in Hz of a motion to identify from: up to 2 rad/s and 6 rad/s^2.
pub const EXCITING: &[(f64, f64)] = &[(0.5, 0.11), (0.3, 0.27), (0.2, 0.53), (0.08, 0.97)];

/// A log to identify from: the arm is moved with what is known before, CAD values.
pub fn experiment(
    effect: &'static str,
    tones: &[(f64, f64)],
    seconds: f64,
    bits: i32,
    seed: u64,
) -> Log {
    let mut control = Knowledge::mixed_cad(1).computed_torque(20.0);
    let motion = waves(tones, 0.7 * seed as f64, seconds);
    let setting = setting(seconds, bits, seed);
    let record = run(plant(effect), &setting, &motion, |now, wanted| {
        control.torque(now, wanted).torque
    });
    log(record.expect("a motion"))
}

/// Of the arm without Stribeck friction.
pub static IDENTIFIED: LazyLock<Knowledge> =
    LazyLock::new(|| Knowledge::identified(&[experiment(DRY, EXCITING, 12.0, BITS, 1)]));
