//! The paper's three experiments, and what is found of each.

use std::f64::consts::TAU;

use robot_model::friction_curve::{Bristles, Curve, Law};
use robot_model::log::Log;

use super::plant::{Friction, Link};
use super::rig::{self, Loop, Run, driven, range, sweep};
use super::tool::{self, Dynamic};
use super::truth;
use crate::paper::Error;

/// Least and largest speed of the curve, rad/s: the paper does not say which its twenty are. The largest is four Stribeck speeds, the
/// fastest that 280 degrees hold for a second.
const LEAST_SPEED: f64 = 0.1;
const MOST_SPEED: f64 = 3.5;

/// How far the link turns where nothing stops it, rad, and from which share of that on its log is kept: printed bristles slide on for some
/// rad before they are as the speed has them.
const FREE_WAY: f64 = 14.0;
const KEPT: f64 = 0.65;

/// How fast the torque rises, N m/s.
pub const RISE: f64 = 0.01;

/// Length of a shake, s, and its frequencies from the start to the end, Hz.
const SHAKE_S: f64 = 1.5;
const SHAKE_HZ: [f64; 2] = [0.4, 6.0];

/// Where the link turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Over the 280 degrees of the rig, from rest at one end.
    Rig,
    /// On, as if the support of the sensor were not there; the start is left out.
    Free,
}

/// The twenty speeds, rad/s.
#[must_use]
pub fn speeds() -> Vec<f64> {
    let last = truth::SPEEDS as f64 - 1.0;
    let speed = |k: usize| LEAST_SPEED * (MOST_SPEED / LEAST_SPEED).powf(k as f64 / last);
    (0..truth::SPEEDS).map(speed).collect()
}

/// Logs of the link at the twenty speeds.
///
/// # Errors
/// Those of logs.
pub fn constant_speeds(
    friction: Friction,
    way: Way,
    held_by: Loop,
    bits: i32,
) -> Result<Vec<Log>, Error> {
    let link = Link::hanging(friction);
    let [low, high] = range();
    let log = |(seed, speed): (u64, f64)| {
        let run = match way {
            Way::Rig => sweep(&link, speed, high - low, held_by),
            Way::Free => sweep(&link, speed, FREE_WAY, held_by).last(KEPT),
        };
        run.log(&format!("{speed:.2} rad/s"), bits, seed)
    };
    (1..).zip(speeds()).map(log).collect()
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
    /// The same with the encoder of the paper.
    pub coarse: Dynamic,
    /// The shake that they are from.
    pub shake: Run,
}

/// Runs the paper's procedure on a link with its printed friction.
///
/// # Errors
/// Those of the libraries.
pub fn find(friction: Friction) -> Result<Found, Error> {
    let logs = constant_speeds(friction, Way::Free, Loop::Stiff, truth::BITS)?;
    let (curve, law) = tool::curve(&logs, false)?;
    let rise = rise(friction, RISE, 100);
    let bristles = tool::bristles(&curve, &law, &rise.log("rise", rig::FINE_BITS, 31)?)?;
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
    let dynamic = tool::dynamic(&start, &shake.log("shake", rig::FINE_BITS, 33)?)?;
    let coarse = tool::dynamic(&start, &shake.log("shake", truth::BITS, 33)?)?;
    Ok(Found {
        curve,
        law,
        rise,
        bristles,
        first,
        dynamic,
        coarse,
        shake,
    })
}
