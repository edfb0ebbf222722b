//! The arm led by hand (equation 31), with what was identified by two of the methods.

use std::array;
use std::f64::consts::TAU;

use robot_model::control::HandGuiding;
use robot_model::effects::{CoulombFriction, MotorInertia, Rokae, ViscousFriction};
use robot_model::identify::Estimate;
use robot_model::{FromParameters, Link, RobotModel, State, Vector};

use super::experiment::{CYCLE, RIPPLE_2, STEPS, Sensors, delivered};
use super::plant::{Joints, Moving, gravity_torque};
use crate::paper::Error;

/// Friction of the publication.
#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(file = "src/seed_002/rokae.robot")]
pub struct Modified {
    /// Link and joint 1.
    pub j1: Link<(Rokae, MotorInertia)>,
    /// Link and joint 2.
    pub j2: Link<(Rokae, MotorInertia)>,
    /// Link and joint 3.
    pub j3: Link<(Rokae, MotorInertia)>,
    /// Link and joint 4.
    pub j4: Link<(Rokae, MotorInertia)>,
    /// Link and joint 5.
    pub j5: Link<(Rokae, MotorInertia)>,
    /// Link and joint 6.
    pub j6: Link<(Rokae, MotorInertia)>,
}

/// Conventional friction.
#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(file = "src/seed_002/conventional.robot")]
pub struct Conventional {
    /// Link and joint 1.
    pub j1: Link<(CoulombFriction, ViscousFriction, MotorInertia)>,
    /// Link and joint 2.
    pub j2: Link<(CoulombFriction, ViscousFriction, MotorInertia)>,
    /// Link and joint 3.
    pub j3: Link<(CoulombFriction, ViscousFriction, MotorInertia)>,
    /// Link and joint 4.
    pub j4: Link<(CoulombFriction, ViscousFriction, MotorInertia)>,
    /// Link and joint 5.
    pub j5: Link<(CoulombFriction, ViscousFriction, MotorInertia)>,
    /// Link and joint 6.
    pub j6: Link<(CoulombFriction, ViscousFriction, MotorInertia)>,
}

/// `K_d`, N m s/rad.
const DAMPING: Joints = [2.0, 2.0, 1.0, 0.2, 0.2, 0.1];

/// A hand that leads each joint and hardly gives way: inertias, kg m^2, and a frequency, rad/s, of a critically damped spring.
const INERTIA: Joints = [4.0, 5.0, 2.0, 0.4, 0.3, 0.13];
const FREQUENCY: f64 = 60.0;

/// Where the arm is led: from this pose and back, so far, after it has stood for so long.
const POSE: Joints = [0.1, 0.35, -0.4, 0.2, 0.6, 0.1];
const WAY: Joints = [0.25, 0.15, 0.3, 0.3, 0.25, 0.3];
const STANDS: f64 = 1.0;
const SECONDS: f64 = 11.0;
const WAY_SECONDS: f64 = 10.0;

/// What is slow, rad/s.
pub const SLOW: f64 = 0.01;

/// One guided motion.
#[derive(Debug, Clone, Default)]
pub struct Guided {
    /// s
    pub time: Vec<f64>,
    /// Velocity, torque of the hand and of the motor; of each joint.
    pub velocity: [Vec<f64>; 6],
    /// Torque of the hand, N m.
    pub hand: [Vec<f64>; 6],
    /// Torque of the motor, N m.
    pub motor: [Vec<f64>; 6],
    /// What is compensated less gravity, N m, where the arm stands at the start and nothing moves yet.
    pub at_rest: Joints,
    /// Torque of the hand while it holds the arm there, N m, in the mean: beside what gravity is off by it holds against the dry friction that
    /// is compensated for a creep.
    pub holding: Joints,
}

impl Guided {
    /// Torque of the hand on a joint, N m root mean square, where the joint is slow or where it is not.
    #[must_use]
    pub fn effort(&self, joint: usize, is_slow: bool) -> f64 {
        let pairs = self.hand[joint].iter().zip(&self.velocity[joint]);
        let of = pairs.filter(|(_, v)| (v.abs() <= SLOW) == is_slow);
        let squares: Vec<f64> = of.map(|(torque, _)| torque * torque).collect();
        (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
    }
}

/// Position and velocity where the hand wants the arm.
fn path(t: f64) -> [Joints; 2] {
    let w = TAU / WAY_SECONDS;
    let t = (t - STANDS).max(0.0);
    [
        array::from_fn(|k| POSE[k] + 0.5 * WAY[k] * (1.0 - (w * t).cos())),
        array::from_fn(|k| 0.5 * WAY[k] * w * (w * t).sin()),
    ]
}

/// An arm with the base parameters of an estimate.
///
/// # Panics
/// If the estimate is of another arm.
#[must_use]
pub fn identified<A, const S: usize, const B: usize, const H: usize>(estimate: &Estimate) -> A
where
    A: FromParameters<6, S, B, H>,
{
    let value = |name: &str| {
        let mut parameters = estimate.parameters.iter();
        let found = parameters.find(|parameter| parameter.name == name);
        found.expect("the same spec").value
    };
    A::from_base(&Vector::from(A::BASE_PARAMETERS.map(value)))
}

/// Leads the simulated arm, which is compensated by the model of `arm`.
///
/// # Errors
/// None are expected: dampings are positive.
pub fn guide<A, const S: usize, const B: usize, const H: usize>(arm: A) -> Result<Guided, Error>
where
    A: RobotModel<6, S, B, H>,
{
    let mut control = HandGuiding::new(arm, DAMPING)?;
    let mut now = Moving {
        q: POSE,
        dq: [0.0; 6],
    };
    let mut sensors = Sensors::new(&now.q);
    let mut guided = Guided::default();
    let hand = |t: f64, now: &Moving| -> Joints {
        let [q, dq] = path(t);
        array::from_fn(|k| {
            let (p, d) = (FREQUENCY * FREQUENCY, 2.0 * FREQUENCY);
            INERTIA[k] * (p * (q[k] - now.q[k]) + d * (dq[k] - now.dq[k]))
        })
    };
    let mut t = 0.0;
    while t < SECONDS {
        sensors.read(&now.q);
        let measured = State::new(
            Vector::from(sensors.q),
            Vector::from(sensors.dq),
            Vector::zeros(),
        );
        let motor: Joints = control.torque(&measured).torque.into();
        if guided.time.is_empty() {
            let (gravity, motor) = (gravity_torque(&POSE), delivered(motor, &POSE, RIPPLE_2[0]));
            guided.at_rest = array::from_fn(|k| motor[k] - gravity[k]);
        }
        guided.time.push(t);
        let pulled = hand(t, &now);
        for k in 0..6 {
            guided.velocity[k].push(now.dq[k]);
            guided.hand[k].push(pulled[k]);
            guided.motor[k].push(motor[k]);
        }
        now = now.after(CYCLE, STEPS, &|since, now| {
            let (pulled, motor) = (hand(t + since, now), delivered(motor, &now.q, RIPPLE_2[0]));
            array::from_fn(|k| motor[k] + pulled[k])
        });
        t += CYCLE;
    }
    let standing = guided.time.iter().take_while(|t| **t < STANDS).count();
    guided.holding =
        array::from_fn(|k| guided.hand[k][..standing].iter().sum::<f64>() / standing as f64);
    Ok(guided)
}
