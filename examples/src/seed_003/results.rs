//! Everything that the page shows, computed once.

use robot_model::friction_curve::Law;

use super::audit::{self, Finding};
use super::encoder::{self, Trial};
use super::experiments::{self, Found, Way};
use super::phenomena::{self, Motion};
use super::plant::{Friction, PRINTED};
use super::rig::Loop;
use super::{tool, truth};
use crate::paper::Error;

/// Speeds at which the end of the spring is pulled, rad/s.
pub const PULLED: [f64; 9] = [0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0];

/// Speeds at which the runtime repeats what is done by hand.
pub const BESIDE: [f64; 2] = [0.5, 3.0];

/// A pull lasts as long as its end takes for so many rad, and so many seconds at least.
const PULL_RAD: f64 = 15.0;
const PULL_S: f64 = 30.0;

/// Twenty speeds with a protocol: what it is, how many speeds the tool found in it, and their law.
#[derive(Debug, Clone, PartialEq)]
pub struct Protocol {
    /// In words.
    pub name: &'static str,
    /// Points of the curve.
    pub points: usize,
    /// Their law.
    pub law: Law,
}

/// The link of the spec beside equations (2) to (7).
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Inertia of the chain over `l^2 m`.
    pub share: f64,
    /// Largest relative distance of the chain from the repaired equation (7).
    pub off: f64,
}

/// One model's phenomena.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// Whose they are.
    pub name: &'static str,
    /// Least and largest speed over the pulled one, late, at each of [`PULLED`].
    pub spread: Vec<[f64; 2]>,
}

/// All results.
#[derive(Debug, Clone)]
pub struct Results {
    /// The printed procedure on the printed friction.
    pub found: Found,
    /// Static laws by protocol: free and over the range, of printed and of stiff bristles.
    pub protocols: Vec<Protocol>,
    /// The link.
    pub body: Body,
    /// Largest distance from the Stribeck curve of bristles that have settled, N m: by hand, and the spec's.
    pub settled: [f64; 2],
    /// Trials of encoders.
    pub encoders: Vec<Trial>,
    /// A pull to and fro by hand, and the runtime's distance from it, rad.
    pub to_and_fro: (Motion, f64),
    /// Stick-slip by hand at the first of [`BESIDE`], and the runtime's largest distance, rad.
    pub slip: (Motion, f64),
    /// Which pulls stick and slip.
    pub shown: Vec<Shown>,
    /// What is wrong, by item.
    pub findings: Findings,
}

/// What is wrong in the paper.
#[derive(Debug, Clone)]
pub struct Findings {
    /// Gravity in equation (7).
    pub gravity: Finding,
    /// The printed unit of the stiffness.
    pub unit: Finding,
    /// Equation (17), and the stiffness that it and its repair give.
    pub deflection: (Finding, [f64; 2]),
    /// Equation (22).
    pub damping: Finding,
    /// Breakaway beyond the motor.
    pub drives: Finding,
    /// Whether friction takes energy there and back at constant speeds.
    pub friction: Finding,
    /// Friction that gives energy.
    pub memory: Finding,
    /// Bristles that are too soft.
    pub softness: Finding,
    /// Speeds from differences.
    pub differences: Finding,
}

/// Runs everything.
///
/// # Errors
/// Those of the libraries.
pub fn results() -> Result<Results, Error> {
    let found = experiments::find(PRINTED)?;
    let rise = found.rise.log("rise", super::rig::FINE_BITS, 34)?;
    let (printed, passive) = (tool::checks(&PRINTED)?, tool::checks(&audit::PASSIVE)?);
    let findings = Findings {
        gravity: audit::dimensions(audit::EQUATION_7),
        unit: audit::dimensions(audit::EQUATION_8),
        deflection: audit::deflection(&rise)?,
        damping: audit::dimensions(audit::EQUATION_22),
        drives: audit::check("drives", &printed, &tool::checks(&audit::in_kgf_cm())?),
        friction: audit::check("friction", &printed, &passive),
        memory: audit::check("memory", &printed, &passive),
        softness: audit::softness(&found.curve, &found.law, &found.bristles)?,
        differences: audit::differences(&found.curve, &found.law)?,
    };
    Ok(Results {
        protocols: protocols(&found)?,
        body: body()?,
        settled: settled()?,
        encoders: encoder::study(&found.curve, &found.law)?,
        to_and_fro: to_and_fro()?,
        slip: slip()?,
        shown: shown(),
        findings,
        found,
    })
}

fn protocols(found: &Found) -> Result<Vec<Protocol>, Error> {
    let over = |name, friction: Friction, held_by| -> Result<Protocol, Error> {
        let logs = experiments::constant_speeds(friction, Way::Rig, held_by, truth::BITS)?;
        let (curve, law) = tool::curve(&logs, false)?;
        Ok(Protocol {
            name,
            points: curve.points.len(),
            law,
        })
    };
    let free = Protocol {
        name: "printed bristles, 14 rad, the first 9 left out",
        points: found.curve.points.len(),
        law: found.law.clone(),
    };
    Ok(vec![
        free,
        over("printed bristles, 280 degrees", PRINTED, Loop::Stiff)?,
        over(
            "printed bristles, 280 degrees, printed gains",
            PRINTED,
            Loop::Printed,
        )?,
        over("1001 N m/rad, 280 degrees", audit::stiff(), Loop::Stiff)?,
        over(
            "1001 N m/rad, 280 degrees, printed gains",
            audit::stiff(),
            Loop::Printed,
        )?,
    ])
}

fn body() -> Result<Body, Error> {
    let angles: Vec<f64> = (0..12).map(|k| 0.5 * f64::from(k)).collect();
    let chain = tool::rigid("rod.robot", include_str!("rod.robot"), &[0.0], &angles)?;
    let [_, (name, text)] = audit::EQUATION_7;
    let equation = tool::rigid(name, text, &[truth::MASS], &angles)?;
    let largest = chain
        .1
        .iter()
        .fold(0.0, |most: f64, torque| most.max(torque.abs()));
    let pairs = chain.1.iter().zip(&equation.1);
    let gravity = pairs.fold(0.0, |most: f64, (x, y)| most.max((x - y).abs())) / largest;
    Ok(Body {
        share: chain.0 / (truth::MASS * truth::LENGTH.powi(2)),
        off: gravity.max((chain.0 / equation.0 - 1.0).abs()),
    })
}

/// At speeds around the printed ones, both ways.
fn settled() -> Result<[f64; 2], Error> {
    let mut most = [0.0_f64; 2];
    for speed in [-2.0, -0.3, 0.02, 0.2, 0.8379, 1.5, 4.0, 8.0] {
        let wanted = PRINTED.steady(speed);
        let mut z = 0.0;
        for _ in 0..100 {
            z = PRINTED.bent(speed, z, 0.6 / f64::abs(speed));
        }
        let found = [PRINTED.torque(speed, z), tool::settled(&PRINTED, speed)?];
        most = [0, 1].map(|k| most[k].max((found[k] - wanted).abs()));
    }
    Ok(most)
}

fn to_and_fro() -> Result<(Motion, f64), Error> {
    let (seconds, pull) = phenomena::to_and_fro(&PRINTED);
    let motion = phenomena::by_hand(PRINTED, phenomena::LOADED, seconds, &pull);
    let beside = phenomena::by_runtime(PRINTED, phenomena::LOADED, seconds, &pull)?;
    let distance = motion.distance(&beside);
    Ok((motion, distance))
}

fn slip() -> Result<(Motion, f64), Error> {
    let mut distance: f64 = 0.0;
    let mut motions = Vec::new();
    for speed in BESIDE {
        let pull = phenomena::pulled(speed);
        let motion = phenomena::by_hand(PRINTED, phenomena::LOADED, PULL_S, &pull);
        let beside = phenomena::by_runtime(PRINTED, phenomena::LOADED, PULL_S, &pull)?;
        distance = distance.max(motion.distance(&beside));
        motions.push(motion);
    }
    Ok((motions.swap_remove(0), distance))
}

fn shown() -> Vec<Shown> {
    let friction = [
        ("printed", PRINTED),
        ("stiff bristles", audit::stiff()),
        ("less damping", audit::PASSIVE),
    ];
    let of = |(name, friction): (&'static str, Friction)| {
        let spread = PULLED.map(|speed| {
            let seconds = (PULL_RAD / speed).max(PULL_S);
            phenomena::by_hand(
                friction,
                phenomena::LOADED,
                seconds,
                phenomena::pulled(speed),
            )
            .spread(speed)
        });
        Shown {
            name,
            spread: spread.to_vec(),
        }
    };
    friction.into_iter().map(of).collect()
}

/// Whether a joint that is pulled stands, or goes back, and then goes faster than it is pulled.
#[must_use]
pub fn sticks(spread: [f64; 2]) -> bool {
    spread[0] < 0.05 && spread[1] > 1.5
}

/// Whether it goes along evenly.
#[must_use]
pub fn is_even(spread: [f64; 2]) -> bool {
    spread[0] > 0.99 && spread[1] < 1.01
}
