//! The paper's three experiments, and what is found of each.

use std::f64::consts::TAU;

use robot_model::friction_curve::{Bristles, Curve, Law};
use robot_model::log::Log;

use super::plant::{Friction, Link};
use super::refine::{self, Mixed};
use super::rig::{self, Loop, Run, driven, range, sweep};
use super::tool::{self, Dynamic};
use super::truth;
use crate::paper::Error;

/// Least and largest speed of the curve, rad/s: the paper does not say which its twenty are. The largest is four Stribeck speeds, the
/// fastest that 280 degrees hold for a second.
const LEAST_SPEED: f64 = 0.1;
const MOST_SPEED: f64 = 3.5;

/// Bristles have settled after so many of the ways at which they forget, `level / s0`; of a run that is shorter the last part of the range
/// is taken.
const FORGOTTEN: f64 = 8.0;
const MOST_LEFT_OUT: f64 = 0.93;

/// What is left out before anything is known of the bristles, as a share of the range.
const FIRST_LEFT_OUT: f64 = 0.7;

/// How fast the torque rises, N m/s.
pub const RISE: f64 = 0.01;

/// Length of a shake, s, and its frequencies from the start to the end, Hz.
const SHAKE_S: f64 = 1.5;
const SHAKE_HZ: [f64; 2] = [0.4, 6.0];

/// The twenty speeds, rad/s.
#[must_use]
pub fn speeds() -> Vec<f64> {
    let last = truth::SPEEDS as f64 - 1.0;
    let speed = |k: usize| LEAST_SPEED * (MOST_SPEED / LEAST_SPEED).powf(k as f64 / last);
    (0..truth::SPEEDS).map(speed).collect()
}

/// How far the link may go, rad.
fn length() -> f64 {
    let [low, high] = range();
    high - low
}

/// The link at the twenty speeds, from rest at one end of the range to the other.
#[must_use]
pub fn sweeps(friction: Friction, held_by: Loop) -> Vec<Run> {
    let link = Link::hanging(friction);
    let speeds = speeds().into_iter();
    speeds
        .map(|speed| sweep(&link, speed, length(), held_by))
        .collect()
}

/// How many of the twenty speeds the printed gains hold on the error of the speed: over the second half of a run its way is that of the
/// wanted speed, within a twentieth.
#[must_use]
pub fn held_on_speed() -> usize {
    let runs = sweeps(super::plant::PRINTED, Loop::PrintedOnSpeed);
    let pairs = runs.iter().zip(speeds());
    let holds = |(run, speed): &(&Run, f64)| {
        let (middle, last) = (run.time.len() / 2, run.time.len() - 1);
        let way = run.q[last] - run.q[middle];
        let wanted = speed * (run.time[last] - run.time[middle]);
        last > middle && (way / wanted - 1.0).abs() < 0.05
    };
    pairs.filter(holds).count()
}

/// Bits of an encoder, and whether currents pass the transducer and the converter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sensors {
    /// Of a turn.
    pub bits: i32,
    /// Otherwise currents are as they are.
    pub has_chain: bool,
}

/// Those of the rig.
pub const SENSORS: Sensors = Sensors {
    bits: truth::BITS,
    has_chain: true,
};

/// What is logged of runs at the twenty speeds, after a way that depends on the speed.
///
/// # Errors
/// Those of logs.
pub fn logs(
    runs: &[Run],
    sensors: Sensors,
    left_out: impl Fn(f64) -> f64,
) -> Result<Vec<Log>, Error> {
    let pairs = (1..).zip(runs.iter().zip(speeds()));
    let log = |(seed, (run, speed)): (u64, (&Run, f64))| {
        let kept = run.after(left_out(speed));
        let name = format!("{speed:.2} rad/s");
        if sensors.has_chain {
            kept.log(&name, sensors.bits, seed)
        } else {
            kept.log_without_chain(&name, sensors.bits)
        }
    };
    pairs.map(log).collect()
}

/// The friction curve of runs whose start is left out until bristles have settled. How far that is the curve of their last parts tells, with
/// the stiffness that a torque that rises has by it.
///
/// # Errors
/// Those of the libraries.
pub fn settled(runs: &[Run], rise: &Log, sensors: Sensors) -> Result<(Curve, Law), Error> {
    let (curve, law) = tool::curve(&logs(runs, sensors, |_| FIRST_LEFT_OUT * length())?, false)?;
    let stiffness = tool::bristles(&curve, &law, rise)?.stiffness.value;
    let forgets = |speed: f64| (law.torque(speed) - law.viscous.value * speed) / stiffness;
    let left_out = |speed: f64| (FORGOTTEN * forgets(speed)).min(MOST_LEFT_OUT * length());
    tool::curve(&logs(runs, sensors, left_out)?, false)
}

/// A torque that rises slowly from rest until the joint breaks away or its range ends.
#[must_use]
pub fn rise(friction: Friction, rate: f64, every: usize) -> Run {
    let longest = 1.1 * friction.breakaway / rate;
    driven(&Link::hanging(friction), 0.0, longest, every, |t| rate * t)
}

/// A torque that swings ever faster.
#[must_use]
pub fn shake(friction: Friction, size: f64) -> Run {
    let [from, to] = SHAKE_HZ;
    let link = Link::hanging(friction);
    driven(&link, 0.0, SHAKE_S, 50, |t| {
        let turns = from * t + 0.5 * (to - from) / SHAKE_S * t * t;
        size * (TAU * turns).sin()
    })
}

/// What the friction curve tells of the static four, as the printed friction with these in it.
#[must_use]
pub fn with_law(law: &Law) -> Friction {
    Friction {
        coulomb: law.coulomb.value,
        breakaway: law.breakaway.value,
        viscous: law.viscous.value,
        stribeck: law.fall.map_or(f64::NAN, |fall| fall.speed.value),
        ..super::plant::PRINTED
    }
}

/// All that is found of a friction with a fine encoder.
#[derive(Debug, Clone)]
pub struct Found {
    /// The twenty speeds.
    pub runs: Vec<Run>,
    /// Points of the curve.
    pub curve: Curve,
    /// The static four.
    pub law: Law,
    /// The torque that rises.
    pub rise: Run,
    /// Its stiffness, as equation (18) has it.
    pub bristles: Bristles,
    /// Stiffness and damping of the second order, equations (20) to (22), as first values.
    pub first: [f64; 2],
    /// The dynamic two, refined.
    pub dynamic: Dynamic,
    /// The same by the mixed cost (23).
    pub mixed: Mixed,
    /// By squares, with the encoder of the paper.
    pub coarse: Dynamic,
    /// The shake that they are from.
    pub shake: Run,
}

/// Runs the paper's procedure on a link with its printed friction.
///
/// # Errors
/// Those of the libraries.
pub fn find(friction: Friction) -> Result<Found, Error> {
    let runs = sweeps(friction, Loop::Stiff);
    let rise = rise(friction, RISE, 100);
    let rise_log = rise.log("rise", rig::FINE_BITS, 31)?;
    let (curve, law) = settled(&runs, &rise_log, SENSORS)?;
    let bristles = tool::bristles(&curve, &law, &rise_log)?;
    let small = shake(friction, 0.1 * friction.breakaway);
    let small = small.log("small shake", rig::FINE_BITS, 32)?;
    let spec = include_str!("second_order.robot");
    let (found, _) = tool::least_squares(
        "second_order.robot",
        spec,
        ["joint_spring.k", "viscous_friction.fv"],
        &small,
    )?;
    let first = [found[0].value, found[1].value - law.viscous.value];
    let start = Friction {
        stiffness: bristles.stiffness.value,
        damping: first[1],
        ..with_law(&law)
    };
    let shake = shake(friction, 0.5 * friction.breakaway);
    let shake_log = shake.log("shake", rig::FINE_BITS, 33)?;
    let dynamic = tool::dynamic(&start, &shake_log)?;
    let of_squares = Friction {
        stiffness: dynamic.stiffness.value,
        damping: dynamic.damping.value,
        ..start
    };
    let mixed = refine::mixed(&of_squares, [start.stiffness, start.damping], &shake_log)?;
    let coarse = tool::dynamic(&start, &shake.log("shake", truth::BITS, 33)?)?;
    Ok(Found {
        runs,
        curve,
        law,
        rise,
        bristles,
        first,
        dynamic,
        mixed,
        coarse,
        shake,
    })
}
