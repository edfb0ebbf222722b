//! Section 4.3: inverse dynamics with half of the friction, a square wave on joint 3.

use std::collections::VecDeque;

use robot_model::control::{ComputedTorque, Friction, Gains, Status};
use robot_model::{State, Vector};

use super::device::phantom;
use super::plant::{Plant, Three, bias};
use super::sensors::{ENCODER, RATE, Velocity, rounded, samples};
use super::truth::Pi;
use crate::paper::Error;

/// Period of the square wave, s, and its ends on joint 3, rad; the other joints stay at the pose.
const PERIOD: f64 = 4.0;
const ENDS: [f64; 2] = [0.15, 0.45];
const POSE: [f64; 2] = [0.0, 0.1];

/// Samples from a command to its torque. The paper has none; those of ours are what ends the gains where its own end.
const DELAY: usize = 8;

/// A velocity that is smaller is none: a filtered one never gets to zero.
const STANDSTILL: f64 = 1e-3;

/// The loop swings where a joint is still this fast, on average, at the end of a half period, rad/s.
const SWINGS: f64 = 0.1;

/// What a controller made of one period.
#[derive(Debug, Clone)]
pub struct Square {
    /// s
    pub time: Vec<f64>,
    /// Joint 3, rad.
    pub q3: Vec<f64>,
    /// What was asked of it.
    pub wanted: Vec<f64>,
    /// Mean of what is left at the ends of both half periods, percent of the step.
    pub steady_percent: f64,
    /// Root mean square of the error of joint 3, rad.
    pub rms: f64,
    /// Overshoot beyond the end, percent of the step, the larger one.
    pub overshoot_percent: f64,
    /// Whether it came to rest.
    pub is_stable: bool,
}

/// Runs the device of `truth` by a controller that knows `known`.
///
/// # Errors
/// Gains that are not positive.
pub fn square(truth: &Pi, known: &Pi, [kp, kd]: [f64; 2]) -> Result<Square, Error> {
    let frequency = kp.sqrt();
    let gains = Gains::<3>::new(frequency, 0.5 * kd / frequency);
    let friction = Friction::part(0.5).at_measured_velocity();
    let mut control = ComputedTorque::new(phantom(known), gains)?.with_friction(friction)?;
    let mut plant = Plant::new(*truth, [POSE[0], POSE[1], ENDS[0]]);
    let mut velocities = [Velocity::new(100.0); 3];
    let mut found = Square {
        time: Vec::new(),
        q3: Vec::new(),
        wanted: Vec::new(),
        steady_percent: 0.0,
        rms: 0.0,
        overshoot_percent: 0.0,
        is_stable: true,
    };
    let samples = samples(PERIOD);
    let step = ENDS[1] - ENDS[0];
    let mut waiting = VecDeque::from([None; DELAY]);
    let (mut late, mut ended) = (0.0_f64, [0.0_f64; 3]);
    for k in 0..samples {
        let t = k as f64 / RATE;
        let is_up = k < samples / 2;
        let end = if is_up { ENDS[1] } else { ENDS[0] };
        let q = plant.q().map(|q| rounded(q, ENCODER));
        let dq: Three = std::array::from_fn(|j| {
            let v = velocities[j].next(q[j]);
            if v.abs() < STANDSTILL { 0.0 } else { v }
        });
        let measured = State::new(Vector::from(q), Vector::from(dq), Vector::zeros());
        let desired = State::at_rest(Vector::from([POSE[0], POSE[1], end]));
        let command = control.torque(&measured, &desired);
        waiting.push_back(Some(command.torque));
        let torque: Three = waiting
            .pop_front()
            .flatten()
            .map_or_else(|| at_start(known), Into::into);
        let is_moving = plant.advance(&torque, 1.0 / RATE).is_ok();
        let true_q = plant.q();
        if command.status != Status::Normal || !is_moving || true_q.iter().any(|q| q.abs() > 3.0) {
            found.is_stable = false;
            break;
        }
        found.time.push(t);
        found.q3.push(true_q[2]);
        found.wanted.push(end);
        let error = end - true_q[2];
        found.rms += error * error / samples as f64;
        let beyond = if is_up { -error } else { error };
        found.overshoot_percent = found.overshoot_percent.max(100.0 * beyond / step);
        let half = (k % (samples / 2)) as f64 / (samples / 2) as f64;
        if half > 0.75 {
            late += error.abs();
            for (sum, v) in ended.iter_mut().zip(plant.dq()) {
                *sum += v * v;
            }
        }
    }
    let counted = 0.25 * samples as f64;
    found.rms = found.rms.sqrt();
    found.steady_percent = 100.0 * late / counted / step;
    found.is_stable &= ended.iter().all(|sum| (sum / counted).sqrt() < SWINGS);
    Ok(found)
}

/// Gravity at the start, until the first command arrives.
fn at_start(known: &Pi) -> Three {
    bias(known, &[POSE[0], POSE[1], ENDS[0]], &[0.0; 3])
}

/// Damping of the sweep, within the paper's 0.7 to 1.2.
const DAMPING: f64 = 1.0;

/// Where the sweep starts: beyond all gains of the paper.
const LEAST_GAIN: f64 = 1500.0;

/// Steps of 5 % at most.
const MOST_STEPS: i32 = 100;

/// The largest `K_P` in steps of 5 % with which the loop comes to rest; zero where it does not at the first. Beyond one at which it does not
/// none is looked for: steps are doubled until then, and halved between.
///
/// # Errors
/// Those of [`square`].
pub fn largest_gain(truth: &Pi, known: &Pi) -> Result<f64, Error> {
    let gain = |step: i32| LEAST_GAIN * 1.05_f64.powi(step);
    let is_stable = |step: i32| -> Result<bool, Error> {
        let kp = gain(step);
        Ok(square(truth, known, [kp, 2.0 * DAMPING * f64::sqrt(kp)])?.is_stable)
    };
    if !is_stable(0)? {
        return Ok(0.0);
    }
    let (mut stable, mut beyond) = (0, 1);
    while is_stable(beyond)? {
        if beyond == MOST_STEPS {
            return Ok(gain(beyond));
        }
        (stable, beyond) = (beyond, i32::min(2 * beyond, MOST_STEPS));
    }
    while beyond - stable > 1 {
        let middle = i32::midpoint(stable, beyond);
        if is_stable(middle)? {
            stable = middle;
        } else {
            beyond = middle;
        }
    }
    Ok(gain(stable))
}
