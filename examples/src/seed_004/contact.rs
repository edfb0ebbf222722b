//! Section 4.4: the force at the end point from the torques of the motors.

use nalgebra::{DMatrix, Matrix3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use robot_model::control::ContactForce;
use robot_model::signal::{Bands, FirstOrder, prepare};
use robot_model::{Points as _, State, Vector};

use super::device::phantom;
use super::fits::STIFF;
use super::plant::{Plant, Three, tip_jacobian};
use super::rig;
use super::sines::{ROOM, Sines, poses};
use super::truth::{CORNER, LINKS, Pi, table_1};
use crate::paper::{Error, normal};

/// Seconds of the run, and those at its ends that are not looked at.
const SECONDS: f64 = 14.0;
const BORDER: f64 = 2.0;

/// Largest force of the hand along each axis, N, and how fast it changes, rad/s.
const HAND: Three = [0.6, 0.8, 0.5];
const RHYTHM: Three = [1.1, 1.7, 2.3];

/// White noise of the force sensor, N, and how it is turned about the vertical against the frame of the device.
const NOISE: f64 = 0.01;
const TURNED: f64 = 0.4;

/// Smallest singular value that is inverted, m.
const THRESHOLD: f64 = 0.01;

/// Force of the hand.
fn hand(t: f64) -> Three {
    std::array::from_fn(|j| HAND[j] * (RHYTHM[j] * t).sin())
}

/// The Jacobian of (21), in the frame of the end point.
fn printed_jacobian(q: &Three) -> Matrix3<f64> {
    let [l1, l2] = LINKS;
    let across = q[1] - q[2];
    Matrix3::new(
        l1 * q[1].cos() + l2 * q[2].sin(),
        0.0,
        0.0,
        0.0,
        l1 * across.cos(),
        0.0,
        0.0,
        -l1 * across.sin(),
        l2,
    )
}

/// How far `J^T J` of (21) and of the spec's point are apart, m^2: whichever the frame, it is the same.
#[must_use]
pub fn jacobian_off() -> f64 {
    let arm = phantom(&table_1(2));
    let poses = poses(&ROOM, 100, 71).into_iter();
    let off = poses.map(|q| {
        let [own] = arm.point_jacobians(&Vector::from(q));
        let printed = printed_jacobian(&q);
        (own.transpose() * own - printed.transpose() * printed).amax()
    });
    off.fold(0.0, f64::max)
}

/// Errors of the force, and the force itself.
#[derive(Debug, Clone, Default)]
pub struct Felt {
    /// s
    pub time: Vec<f64>,
    /// Filtered force along y: of the sensor, by the model, without it; N.
    pub y: [Vec<f64>; 3],
    /// Root mean square of the error over all axes with the model and without it, N.
    pub rms: [f64; 2],
    /// Largest entry by which the registered frame is off the true one.
    pub frame_off: f64,
}

/// A hand pushes the device with the force sensor while it moves; `known` is what was identified.
///
/// # Errors
/// Those of the plant and of the filters.
pub fn felt(known: &Pi, motion: &Sines) -> Result<Felt, Error> {
    let truth = table_1(2);
    let plant = Plant::new(truth, motion.at(0.0)[0]);
    let record = rig::pushed(plant, motion, &STIFF, SECONDS, 72, |t, q| {
        let (jacobian, force) = (tip_jacobian(&LINKS, q), hand(t));
        std::array::from_fn(|j| (0..3).map(|axis| jacobian[axis][j] * force[axis]).sum())
    })?;
    let log = record.log("pushed", 0.0, SECONDS)?;
    let prepared = prepare(&log, &Bands::for_log(&log))?;
    let smooth = &prepared.motion.smooth;
    let contact = ContactForce::new(phantom(known), THRESHOLD)?;
    let at = |all: &[Vec<f64>], k: usize| Vector::<3>::from_fn(|j, _| all[j][k]);
    let turned = nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::y_axis(), TURNED);
    let mut random = ChaCha8Rng::seed_from_u64(73);
    // The hand's force in the sensor's frame, by the model, without it.
    let mut forces: [[Vec<f64>; 3]; 3] = Default::default();
    for (k, t) in prepared.motion.time.iter().enumerate() {
        let state = State::new(at(&smooth.q, k), at(&smooth.dq, k), at(&smooth.ddq, k));
        let tau = at(&prepared.tau, k);
        let by_model = contact.of_robot::<14, 14, 0, 0, 0, 1>(&state, &tau, 0);
        let bare = contact.at_point::<1>(&state.q, &tau, 0);
        let sensor = turned * Vector::from(hand(*t));
        for j in 0..3 {
            let noise = normal(&mut random);
            forces[0][j].push(sensor[j] + NOISE * noise);
            // What acts on the device is the opposite of what it exerts.
            forces[1][j].push(-by_model.as_ref().map_or(f64::NAN, |found| found.force[j]));
            forces[2][j].push(-bare.as_ref().map_or(f64::NAN, |found| found.force[j]));
        }
    }
    let filter = FirstOrder::new(CORNER, prepared.rate_hz)?;
    let filtered = forces.map(|axes| {
        axes.map(|axis| {
            let mut out = Vec::new();
            filter.apply(axis[0], &axis, &mut out);
            out
        })
    });
    let inside: Vec<usize> = (0..prepared.motion.time.len())
        .filter(|&k| (BORDER..SECONDS - BORDER).contains(&prepared.motion.time[k]))
        .collect();
    Ok(evaluate(
        &prepared.motion.time,
        &filtered,
        &inside,
        turned.matrix(),
    ))
}

fn evaluate(
    time: &[f64],
    [sensor, by_model, bare]: &[[Vec<f64>; 3]; 3],
    inside: &[usize],
    turned: &Matrix3<f64>,
) -> Felt {
    let rows =
        |axes: &[Vec<f64>; 3]| DMatrix::from_fn(inside.len(), 3, |row, j| axes[j][inside[row]]);
    let (sensor, by_model, bare) = (rows(sensor), rows(by_model), rows(bare));
    // Section 4.4 registers the frame of the sensor by least squares.
    let normal = sensor.transpose() * &sensor;
    let frame = normal
        .try_inverse()
        .map(|inverse| inverse * sensor.transpose() * &by_model);
    let frame = frame.unwrap_or_else(|| DMatrix::zeros(3, 3));
    let registered = &sensor * &frame;
    let rms = |found: &DMatrix<f64>| {
        let off = found - &registered;
        (off.norm_squared() / off.nrows() as f64).sqrt()
    };
    let column = |all: &DMatrix<f64>| all.column(1).iter().copied().collect();
    Felt {
        time: inside.iter().map(|&k| time[k]).collect(),
        rms: [rms(&by_model), rms(&bare)],
        y: [column(&registered), column(&by_model), column(&bare)],
        // Rows are forces, so that the frame is that of `F^T = S^T R`.
        frame_off: (0..9)
            .map(|i| (frame[(i / 3, i % 3)] - turned[(i / 3, i % 3)]).abs())
            .fold(0.0, f64::max),
    }
}
