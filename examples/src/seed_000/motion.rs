//! Motions by the tool's simulator: that they come through turn-arounds, how the upright falls, and how far a small change carries.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{
    Adjustable, Drive, Instant, Integrator, Plant, SimulateError, Slopes, Tangent, Tolerances, Work,
};
use robot_model_spec::amend::{Amendment, amend};

use super::data::Data;
use super::law::{Law, SHOULDER, compiled};
use super::plant::{Arm, Experiment};
use super::truth::{
    ARM, BACK_EMF, FIGURE_7, FIGURE_7_C1, FIGURE_8, FIGURE_9_C1, FIGURE_10, RATE, SAMPLES,
};
use super::words::{InWords, in_words};
use crate::paper::Error;

/// Positions at samples, and what the motion took.
#[derive(Debug, Clone)]
pub struct Path {
    /// rad
    pub angle: Vec<f64>,
    /// Steps, events.
    pub work: Work,
}

/// An arm from a start, under a drive at samples: held from each to the next, or going to it along a straight line, whose mean is held.
fn simulate(
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

fn held(torque: f64) -> Drive {
    Drive {
        torque: vec![torque],
        inputs: Vec::new(),
        input_rates: Vec::new(),
        since: 0.0,
    }
}

/// Largest difference of two motions.
fn apart(one: &[f64], other: &[f64]) -> f64 {
    let pairs = one.iter().zip(other);
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// A motion through turn-arounds by the simulator and by the hand-written one.
#[derive(Debug, Clone)]
pub struct Turns {
    /// Largest difference, rad.
    pub apart: f64,
    /// What the simulator took.
    pub work: Work,
    /// Steps a sample.
    pub steps: f64,
    /// Samples at rest.
    pub resting: usize,
}

/// Dry friction over the inertia, rad/s^2: of 0.7 V.
const DRY: f64 = 0.7 * ARM[1];

/// The experiment with law (6.3), and one with dry friction besides that stops the arm between its swings.
///
/// # Errors
/// Where the simulator stops.
pub fn turns(experiment: &Experiment) -> Result<[Turns; 2], Error> {
    let of = |plant: InWords, path: &[f64], drive: &[f64]| -> Result<Turns, Error> {
        let found = simulate(plant, [0.0, 0.0], drive, true)?;
        let Work {
            explicit,
            implicit,
            impulses,
            ..
        } = found.work;
        let rests = path.windows(2).filter(|pair| pair[1] - pair[0] == 0.0);
        Ok(Turns {
            apart: apart(&found.angle, path),
            work: found.work,
            steps: (explicit + implicit + impulses) as f64 / f64::from(SAMPLES),
            resting: rests.count(),
        })
    };
    let plain = of(
        Law::Directional.plant(&ARM)?,
        &experiment.angle,
        &experiment.command,
    )?;
    let dry = Arm {
        values: ARM,
        dry: DRY,
    };
    // Three quarters of a second each: forward, none, backward, none.
    let drive: Vec<f64> = (0..SAMPLES)
        .map(|k| [2.5, 0.0, -2.5, 0.0][(4 * k / 90 % 4) as usize])
        .collect();
    let mut state = [0.0, 0.0];
    let path = drive.iter().map(|v| {
        let now = state[0];
        state = dry.sample_later(state, *v);
        now
    });
    let path: Vec<f64> = path.collect();
    let effects = ["direction_law", "coulomb_friction"].map(|effect| Amendment {
        effect: effect.to_owned(),
        joints: vec!["th".to_owned()],
        shapes: Vec::new(),
    });
    let spec = compiled(&amend("shoulder.robot", SHOULDER, &effects)?)?;
    let plant = in_words(spec, &[ARM.as_slice(), &[DRY]].concat())?;
    Ok([plain, of(plant, &path, &drive)?])
}

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

/// A figure of section 5: a motion, and one with a small change.
#[derive(Debug, Clone)]
pub struct Change {
    /// Number of the figure.
    pub figure: u32,
    /// What is changed.
    pub what: &'static str,
    /// By how much.
    pub by: f64,
    /// The solid and the dotted graph, rad.
    pub paths: [Vec<f64>; 2],
}

impl Change {
    /// Largest distance of both, rad.
    #[must_use]
    pub fn apart(&self) -> f64 {
        apart(&self.paths[0], &self.paths[1])
    }

    /// When they are a tenth of a radian apart, s after the start.
    #[must_use]
    pub fn parted(&self) -> Option<f64> {
        let mut pairs = self.paths[0].iter().zip(&self.paths[1]);
        let sample = pairs.position(|(x, y)| (x - y).abs() > 0.1)?;
        Some(sample as f64 / RATE)
    }
}

/// Parameters of the arm in model (5.1): the back-EMF is not friction there.
fn own() -> [f64; 4] {
    let [alpha, beta, c1, c2] = ARM;
    [alpha, beta, c1 - BACK_EMF * beta, c2 - BACK_EMF * beta]
}

/// Figures 7 and 8 with the printed parameters, then with the arm's own, and figures 9 and 10; each from the measured position at 1.67 s.
///
/// The printed parameters of figures 7 and 8 are of the paper's log. On another one the arm falls soon with them, and what has fallen is
/// less sensitive than what is held up.
///
/// # Errors
/// Where the simulator stops.
pub fn changes(data: &Data) -> Result<[Change; 6], Error> {
    let angle = data.start()[0];
    let part = |input: &[f64]| input[data.window.clone()].to_vec();
    let (measured, commanded) = (part(&data.u), part(&data.wave));
    let path = |values: [f64; 4], velocity: f64, is_second: bool| -> Result<Vec<f64>, Error> {
        let drive = if is_second { &commanded } else { &measured };
        let plant = Law::Directional.plant(&values)?;
        Ok(simulate(plant, [angle, velocity], drive, is_second)?.angle)
    };
    // A figure of a change of `c1`, and one of a change of the initial velocity.
    let both = |values: [f64; 4],
                velocity: f64,
                by: [f64; 2],
                figures: [u32; 2],
                what: [&'static str; 2]|
     -> Result<[Change; 2], Error> {
        let is_second = figures[0] == 9;
        let mut other = values;
        other[2] += by[0];
        let solid = path(values, velocity, is_second)?;
        let dotted = [
            path(other, velocity, is_second)?,
            path(values, velocity + by[1], is_second)?,
        ];
        let [c1, start] = dotted.map(|dotted| [solid.clone(), dotted]);
        let change = |k: usize, paths| Change {
            figure: figures[k],
            what: what[k],
            by: by[k],
            paths,
        };
        Ok([change(0, c1), change(1, start)])
    };
    let small = [FIGURE_7_C1 - FIGURE_7[2], FIGURE_8[1] - FIGURE_8[0]];
    let large = [FIGURE_9_C1 - ARM[2], FIGURE_10[1] - FIGURE_10[0]];
    let of_printed = ["c1, (5.1), as printed", "velocity, (5.1), as printed"];
    let of_own = ["c1, (5.1), the arm's own", "velocity, (5.1), the arm's own"];
    let of_second = ["c1, (5.2)", "velocity, (5.2)"];
    let [a, b] = both(FIGURE_7, FIGURE_8[0], small, [7, 8], of_printed)?;
    let [c, d] = both(own(), FIGURE_8[0], small, [7, 8], of_own)?;
    let [e, f] = both(ARM, FIGURE_10[0], large, [9, 10], of_second)?;
    Ok([a, b, c, d, e, f])
}
