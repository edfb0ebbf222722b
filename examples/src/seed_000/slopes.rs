//! Exact slopes of the equations and of motions: how fast the upright falls, and how well the slopes of a search are those of motions.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Adjustable, Instant, Integrator, Plant, Slopes, Tangent, Tolerances};

use super::data::Data;
use super::law::Law;
use super::motion::held;
use super::plant::Arm;
use super::truth::{ARM, RATE};
use crate::paper::Error;

/// The faster of the two rates at which the upright arm falls, 1/s, with one constant of friction.
///
/// # Errors
/// Mistakes of the spec.
pub fn upright_rate(alpha: f64, c: f64) -> Result<f64, Error> {
    let mut plant = Law::Linear.plant(&[alpha, ARM[1], c])?;
    let at = Instant {
        time: 0.0,
        q: &[0.0],
        dq: &[0.0],
        ddq: &[0.0],
        memory: &[],
        switches: &[],
        torque: &[0.0],
        inputs: &[],
    };
    let (mut torque, mut inertia) = (DVector::zeros(1), DMatrix::zeros(1, 1));
    plant.torque(&at, &mut torque, &mut inertia);
    let mut slopes = Slopes::zeros(&plant);
    plant.slopes(&at, &mut slopes);
    let [stiffness, damping] = [0, 1].map(|k| slopes.torque[k][(0, 0)] / inertia[(0, 0)]);
    Ok(0.5 * ((damping * damping - 4.0 * stiffness).sqrt() - damping))
}

/// By how much the exact slopes of the motion in model (5.2) differ from differences of hand-written motions, relative to the largest slope
/// of each unknown: `alpha`, `beta`, `c1`, `c2`, and the initial velocity.
///
/// # Errors
/// Where the simulator stops.
pub fn slope_errors(data: &Data) -> Result<[f64; 5], Error> {
    /// Shares of unknowns by which they are moved.
    const STEP: f64 = 1e-4;
    let start = data.start();
    let drive = &data.wave[data.window.clone()];
    let mut plant = Law::Directional.plant(&ARM)?;
    plant.prepare();
    let mut state = DMatrix::zeros(2, 6);
    state[(0, 4)] = 1.0;
    state[(1, 5)] = 1.0;
    let mut tangent = Tangent::new(&plant, state);
    let mut arm = Integrator::new(plant, &[start[0]], &[start[1]], Tolerances::default())?;
    let mut slopes = vec![tangent.state.row(0).into_owned()];
    for (k, v) in (1_u32..).zip(&drive[..drive.len() - 1]) {
        arm.drive(held(*v));
        arm.advance_with(f64::from(k) / RATE, &mut tangent)?;
        slopes.push(tangent.state.row(0).into_owned());
    }
    let by_hand = |unknown: usize, step: f64| -> Vec<f64> {
        let (mut values, mut state) = (ARM, start);
        match values.get_mut(unknown) {
            Some(value) => *value += step,
            None => state[1] += step,
        }
        let arm = Arm { values, dry: 0.0 };
        let angles = drive.iter().map(|v| {
            let now = state[0];
            state = arm.sample_later(state, *v);
            now
        });
        angles.collect()
    };
    Ok(std::array::from_fn(|unknown| {
        let step = STEP * ARM.get(unknown).copied().unwrap_or(1.0);
        let (low, high) = (by_hand(unknown, -step), by_hand(unknown, step));
        // The column of the initial position is not compared.
        let column = if unknown < 4 { unknown } else { 5 };
        let (mut error, mut largest) = (0.0_f64, 0.0_f64);
        for (slopes, (low, high)) in slopes.iter().zip(low.iter().zip(&high)) {
            let difference = (high - low) / (2.0 * step);
            error = error.max((slopes[column] - difference).abs());
            largest = largest.max(difference.abs());
        }
        error / largest
    }))
}
