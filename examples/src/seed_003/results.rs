//! Everything that the page shows, computed once.

use robot_model::friction_curve::{Curve, Law};

use super::audit::{self, Finding};
use super::encoder::{self, Trial};
use super::experiments::{self, Found, SENSORS, Sensors};
use super::phenomena::{self, Late, Motion, Spring};
use super::plant::{Friction, PRINTED};
use super::rig::{Loop, Run};
use super::{tool, truth};
use crate::paper::{Error, both, in_threads};

/// Speeds at which the end of the spring is pulled, rad/s.
pub const PULLED: [f64; 9] = [0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0];

/// Speeds at which the runtime repeats what is done by hand.
pub const BESIDE: [f64; 2] = [0.5, 3.0];

/// A pull lasts as long as its end takes for its way, and so many seconds at least.
const PULL_S: f64 = 30.0;

/// The runtime repeats this share of a pull's way, and the seconds above at least.
const REPEATED: f64 = 0.25;

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
    /// What pulls.
    pub spring: Spring,
    /// How it moves late, at each of [`PULLED`].
    pub late: Vec<Late>,
    /// A pull to and fro by hand, and the runtime's distance from it, rad.
    pub to_and_fro: (Motion, f64),
    /// Pulls by hand at the first of [`BESIDE`], and the runtime's largest distance, rad.
    pub slip: (Motion, f64),
}

/// The static four through the current.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// With the transducer and the converter.
    pub law: Law,
    /// With currents as they are.
    pub without: Law,
    /// Largest voltage on the converter, V.
    pub volts: f64,
}

/// All results.
#[derive(Debug, Clone)]
pub struct Results {
    /// The printed procedure on the printed friction.
    pub found: Found,
    /// Static laws by protocol, of printed and of stiff bristles.
    pub protocols: Vec<Protocol>,
    /// Of the twenty speeds, those that the printed gains hold on the error of the speed.
    pub on_speed: usize,
    /// The link.
    pub body: Body,
    /// Largest distance from the Stribeck curve of bristles that have settled, N m: by hand, and the spec's.
    pub settled: [f64; 2],
    /// Trials of encoders.
    pub encoders: Vec<Trial>,
    /// What pulls show: of the printed friction by a stiff spring and by a soft one, of stiff bristles, of less damping.
    pub shown: Vec<Shown>,
    /// Torques in kgf cm.
    pub in_kgf_cm: Chain,
    /// What is wrong, by item.
    pub findings: Findings,
}

/// What is wrong in the paper.
#[derive(Debug, Clone)]
pub struct Findings {
    /// Gravity in equation (7).
    pub gravity: Finding,
    /// The rod's share there.
    pub third: Finding,
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
    /// The encoder's step.
    pub encoder: Finding,
}

/// Runs everything.
///
/// # Errors
/// Those of the libraries.
pub fn results() -> Result<Results, Error> {
    let held = || both(in_kgf_cm, || Ok(experiments::held_on_speed()));
    let apart = || both(shown, held);
    let (found, (shown, (in_kgf_cm, on_speed))) = both(|| experiments::find(PRINTED), apart)?;
    let ((protocols, encoders), findings) = both(
        || {
            both(
                || protocols(&found),
                || encoder::study(&found.curve, &found.law),
            )
        },
        || findings(&found),
    )?;
    Ok(Results {
        protocols,
        on_speed,
        body: body()?,
        settled: settled()?,
        encoders,
        shown,
        in_kgf_cm,
        findings,
        found,
    })
}

fn findings(found: &Found) -> Result<Findings, Error> {
    let rise = found.rise.log("rise", super::rig::FINE_BITS, 34)?;
    let (printed, passive) = (tool::checks(&PRINTED)?, tool::checks(&audit::PASSIVE)?);
    Ok(Findings {
        gravity: audit::dimensions(audit::EQUATION_7),
        third: audit::third()?,
        unit: audit::dimensions(audit::EQUATION_8),
        deflection: audit::deflection(&rise)?,
        damping: audit::dimensions(audit::EQUATION_22),
        drives: audit::check("drives", &printed, &tool::checks(&audit::in_kgf_cm())?),
        friction: audit::check("friction", &printed, &passive),
        memory: audit::check("memory", &printed, &passive),
        softness: audit::softness(&found.curve, &found.law, &found.bristles)?,
        differences: audit::differences(found)?,
        encoder: audit::encoder(&found.curve),
    })
}

fn protocols(found: &Found) -> Result<Vec<Protocol>, Error> {
    let of = |name, (curve, law): (Curve, Law)| Protocol {
        name,
        points: curve.points.len(),
        law,
    };
    let from_rest = |runs: &[Run]| tool::curve(&experiments::logs(runs, SENSORS, |_| 0.0)?, false);
    let held = |friction, held_by| from_rest(&experiments::sweeps(friction, held_by));
    Ok(vec![
        of(
            "printed bristles, start left out",
            (found.curve.clone(), found.law.clone()),
        ),
        of("printed bristles, from rest", from_rest(&found.runs)?),
        of(
            "printed bristles, from rest, printed gains",
            held(PRINTED, Loop::Printed)?,
        ),
        of(
            "1001 N m/rad, from rest",
            held(audit::stiff(), Loop::Stiff)?,
        ),
        of(
            "1001 N m/rad, from rest, printed gains",
            held(audit::stiff(), Loop::Printed)?,
        ),
    ])
}

/// The protocol with the printed torques in kgf cm, as the motor could give them.
fn in_kgf_cm() -> Result<Chain, Error> {
    let friction = audit::in_kgf_cm();
    let runs = experiments::sweeps(friction, Loop::Stiff);
    let rise = experiments::rise(friction, experiments::RISE * truth::KGF_CM, 100);
    let rise = rise.log("rise", super::rig::FINE_BITS, 35)?;
    let of = |has_chain| {
        let sensors = Sensors {
            has_chain,
            ..SENSORS
        };
        experiments::settled(&runs, &rise, sensors)
    };
    // At the start the loop asks for more than friction takes.
    let kept = runs.iter().map(|run| run.after(1.0).volts());
    Ok(Chain {
        law: of(true)?.1,
        without: of(false)?.1,
        volts: kept.fold(0.0, f64::max),
    })
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

fn to_and_fro(friction: Friction) -> Result<(Motion, f64), Error> {
    let (seconds, pull) = phenomena::to_and_fro(&friction);
    let motion = phenomena::by_hand(friction, phenomena::LOADED, seconds, &pull);
    let beside = phenomena::by_runtime(friction, phenomena::LOADED, seconds, &pull)?;
    let distance = motion.distance(&beside);
    Ok((motion, distance))
}

fn slip(friction: Friction, spring: Spring) -> Result<(Motion, f64), Error> {
    let mut distance: f64 = 0.0;
    let mut motions = Vec::new();
    for speed in BESIDE {
        let seconds = (REPEATED * spring.way / speed).max(PULL_S);
        let motion = spring.pulls(friction, speed, seconds);
        let pull = spring.pulled(speed);
        let beside = phenomena::by_runtime(friction, phenomena::LOADED, seconds, pull)?;
        distance = distance.max(motion.distance(&beside));
        motions.push(motion);
    }
    Ok((motions.swap_remove(0), distance))
}

fn shown() -> Result<Vec<Shown>, Error> {
    let pulls = [
        ("printed", PRINTED, phenomena::STIFF),
        ("printed, by a soft spring", PRINTED, phenomena::SOFT),
        ("stiff bristles", audit::stiff(), phenomena::STIFF),
        ("less damping", audit::PASSIVE, phenomena::STIFF),
    ];
    let of = |&(name, friction, spring): &(&'static str, Friction, Spring)| {
        let late = in_threads(&PULLED, |speed| {
            let seconds = (spring.way / speed).max(PULL_S);
            Ok(spring.pulls(friction, *speed, seconds).late(*speed))
        })?;
        Ok(Shown {
            name,
            spring,
            late,
            to_and_fro: to_and_fro(friction)?,
            slip: slip(friction, spring)?,
        })
    };
    in_threads(&pulls, of)
}

impl Shown {
    /// The speeds of [`PULLED`] at which that is so.
    #[must_use]
    pub fn speeds(&self, is_so: fn(&Late) -> bool) -> Vec<f64> {
        let pairs = PULLED.iter().zip(&self.late);
        pairs
            .filter(|(_, late)| is_so(late))
            .map(|(speed, _)| *speed)
            .collect()
    }

    /// Whether the joint sticks and slips at speeds below one, and goes along evenly at all above. The slowest are no part of that: close to
    /// rest the printed curve falls by less than `s2`.
    #[must_use]
    pub fn sticks_below_a_speed_only(&self) -> bool {
        let slips = self.speeds(Late::sticks);
        let even = self.speeds(Late::is_even);
        let fastest = slips.iter().copied().fold(0.0, f64::max);
        let slowest = slips.iter().copied().fold(f64::INFINITY, f64::min);
        !slips.is_empty()
            && PULLED.iter().any(|speed| *speed > fastest)
            && PULLED.iter().all(|speed| {
                *speed < slowest
                    || slips.contains(speed)
                    || (*speed > fastest && even.contains(speed))
            })
    }
}
