//! Motions by the tool's simulator.

use robot_model::simulate::{Drive, Integrator, SimulateError, Tolerances, Work};

use super::truth::RATE;
use super::words::InWords;

/// Positions at samples, and what the motion took.
#[derive(Debug, Clone)]
pub struct Path {
    /// rad
    pub angle: Vec<f64>,
    /// Steps, events.
    pub work: Work,
}

/// An arm from a start, under a drive at samples: held from each to the next, or going to it along a straight line, whose mean is held.
pub(super) fn simulate(
    plant: InWords,
    [angle, velocity]: [f64; 2],
    drive: &[f64],
    is_held: bool,
) -> Result<Path, SimulateError> {
    let mut arm = Integrator::new(plant, &[angle], &[velocity], Tolerances::default())?;
    let mut path = vec![angle];
    for (k, pair) in (1_u32..).zip(drive.windows(2)) {
        let torque = if is_held {
            pair[0]
        } else {
            0.5 * (pair[0] + pair[1])
        };
        arm.drive(held(torque));
        arm.advance(f64::from(k) / RATE)?;
        path.push(arm.q()[0]);
    }
    Ok(Path {
        angle: path,
        work: arm.work(),
    })
}

/// A torque that stays as it is.
pub(super) fn held(torque: f64) -> Drive {
    Drive {
        torque: vec![torque],
        inputs: Vec::new(),
        input_rates: Vec::new(),
        since: 0.0,
    }
}

/// Largest difference of two motions.
pub(super) fn apart(one: &[f64], other: &[f64]) -> f64 {
    let pairs = one.iter().zip(other);
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}
