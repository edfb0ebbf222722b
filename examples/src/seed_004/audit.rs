//! Table 1, asked whether a device can have it.

use robot_model::{Mechanics as _, Vector};

use super::device::{SPEC, by_name, compiled, phantom, within};
use super::fits::STIFF;
use super::plant::Plant;
use super::results::Results;
use super::rig;
use super::sensors::{RATE, samples};
use super::sines::{ROOM, Room, Sines};
use super::truth::{CONFIGURATIONS, LEAST_EIGENVALUE, Pi, SINES, piece_wise, table_1};
use crate::paper::{Audited, Error, Row, in_threads};

/// What the tool says of a set of parameters of a spec.
///
/// # Errors
/// Those of the text.
pub fn audited(text: &str, pi: &Pi) -> Result<Audited, Error> {
    Audited::of(&compiled(text)?, &by_name(pi))
}

/// What is found in all installations.
#[derive(Debug, Clone)]
pub struct Audits {
    /// Table 1 over the workspace of the spec.
    pub printed: Vec<Audited>,
    /// Table 1 over [`ROOM`].
    pub in_room: Vec<Audited>,
    /// Table 1 with viscous coefficients turned positive.
    pub positive: Vec<Audited>,
    /// The piece-wise column.
    pub piece_wise: Audited,
    /// Why the rig cannot move the installations through the whole workspace; empty where it can.
    pub moved: Vec<String>,
    /// The same of the piece-wise column, without friction.
    pub piece_wise_moved: String,
    /// How many instants of that motion the compiled device has no acceleration at, of each installation.
    pub without_acceleration: Vec<usize>,
    /// The same of the piece-wise column.
    pub piece_wise_without: usize,
    /// Where the inertia of the installations fails.
    pub fails: Vec<Fails>,
    /// The same of the piece-wise column.
    pub piece_wise_fails: Fails,
}

/// Parts of the inertia of an installation over the workspace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fails {
    /// Upper limit of joint 2 from which on `audit` finds `M11` below zero at some angle of joint 3, degrees; none where it finds none.
    pub m11_from: Option<i32>,
    /// Least eigenvalue of the block of joints 2 and 3, kg m^2.
    pub block: f64,
}

impl Fails {
    /// Whether either part does.
    #[must_use]
    pub fn is_any(&self) -> bool {
        self.m11_from.is_some() || self.block <= 0.0
    }
}

/// Limits of joints 2 and 3 in the spec, degrees.
const LIMITS: [[i32; 2]; 2] = [[-30, 100], [-30, 75]];

/// More inertia than the device has, kg m^2: a load under which a part of the inertia is not the one that fails.
const LOAD: f64 = 0.01;

/// Joint 1 is not coupled to joints 2 and 3, so that either part is by itself where the other is loaded.
fn fails(pi: &Pi) -> Result<Fails, Error> {
    let [[low_2, high_2], [low_3, high_3]] = LIMITS;
    let up_to = |high_2: i32, loaded: &[usize]| {
        let mut pi = *pi;
        for &k in loaded {
            pi[k] += LOAD;
        }
        let [low, high] = [[-60, low_2, low_3], [60, high_2, high_3]]
            .map(|limits| limits.map(|degrees| f64::from(degrees).to_radians()));
        audited(&within(low, high), &pi)
    };
    let is_m11_negative =
        |high_2: i32| up_to(high_2, &[4, 5]).map(|audited| !audited.findings("inertia").is_empty());
    let mut m11_from = None;
    if is_m11_negative(high_2)? {
        let (mut passes, mut fails) = (0, high_2);
        if is_m11_negative(passes)? {
            fails = passes;
        }
        while fails - passes > 1 {
            let middle = passes + (fails - passes) / 2;
            if is_m11_negative(middle)? {
                fails = middle;
            } else {
                passes = middle;
            }
        }
        m11_from = Some(fails);
    }
    Ok(Fails {
        m11_from,
        block: up_to(high_2, &[0])?.least_eigenvalue(),
    })
}

/// Seconds for which the installations are moved through the workspace.
const MOVED: f64 = 40.0;

/// Instants of a motion at which the compiled device has no acceleration, whatever the torque.
fn without_acceleration(pi: &Pi, motion: &Sines) -> usize {
    let arm = phantom(pi);
    let instants = (0..samples(MOVED)).filter(|&k| {
        let [q, dq, _] = motion.at(k as f64 / RATE).map(Vector::from);
        arm.forward_dynamics(&q, &dq, &Vector::zeros()).is_none()
    });
    instants.count()
}

/// Asks.
///
/// # Errors
/// None are expected: the names are those of the spec.
pub fn all() -> Result<Audits, Error> {
    let room = within(ROOM.low, ROOM.high);
    let columns: Vec<Pi> = (0..5).map(table_1).chain([piece_wise()]).collect();
    let each = |text: &str, change: fn(Pi) -> Pi| {
        in_threads(&columns[..5], |pi| audited(text, &change(*pi)))
    };
    let positive = |mut pi: Pi| {
        for fv in &mut pi[8..11] {
            *fv = fv.abs();
        }
        pi
    };
    // The limits of the spec.
    let [[low_2, high_2], [low_3, high_3]] = LIMITS;
    let whole = Room {
        low: [-60, low_2, low_3].map(|degrees| f64::from(degrees).to_radians()),
        high: [60, high_2, high_3].map(|degrees| f64::from(degrees).to_radians()),
    };
    let motion = Sines::new(SINES, &whole, 4);
    let moved = |pi: &Pi| {
        let plant = Plant::new(*pi, motion.at(0.0)[0]);
        let run = rig::run(plant, &motion, &STIFF, MOVED, 45);
        let error = run.err();
        Ok(error.map_or_else(String::new, |error| error.to_string()))
    };
    let mut moved = in_threads(&columns, moved)?;
    let mut without = in_threads(&columns, |pi| Ok(without_acceleration(pi, &motion)))?;
    let mut fails = in_threads(&columns, fails)?;
    Ok(Audits {
        piece_wise_moved: moved.remove(5),
        moved,
        piece_wise_without: without.remove(5),
        without_acceleration: without,
        piece_wise_fails: fails.remove(5),
        fails,
        printed: each(SPEC, |pi| pi)?,
        in_room: each(&room, |pi| pi)?,
        positive: each(SPEC, positive)?,
        piece_wise: audited(SPEC, &piece_wise())?,
    })
}

/// Items 4.definite.
pub(super) fn rows(results: &Results) -> Vec<Row> {
    let audits = &results.audits;
    let least = |all: &[Audited]| -> String {
        let all: Vec<String> = all
            .iter()
            .map(|one| format!("{:.2}", 1e3 * one.least_eigenvalue()))
            .collect();
        all.join(", ")
    };
    let failed = super::rows::count(&audits.printed, "inertia");
    let from = |fails: &Fails| {
        let degrees = fails.m11_from.map(|degrees| degrees.to_string());
        degrees.unwrap_or_else(|| "nowhere".to_owned())
    };
    let fails = audits.fails.iter().zip(CONFIGURATIONS);
    let fails = fails.map(|(fails, name)| format!("{name} {}", from(fails)));
    let fails: Vec<String> = fails.collect();
    let blocks: Vec<String> = (audits.fails.iter())
        .map(|fails| format!("{:.2}", 1e3 * fails.block))
        .collect();
    let stopped = audits.moved.iter().filter(|said| !said.is_empty()).count();
    let without = audits.without_acceleration.iter();
    let without: Vec<String> = without.map(usize::to_string).collect();
    let instants = samples(MOVED);
    let below = audits
        .in_room
        .iter()
        .all(|one| one.least_eigenvalue() < LEAST_EIGENVALUE);
    vec![
        Row::wrong_in_print(
            "4.definite",
            "inertia over the workspace (joints 2 and 3 within limits of ours, as the paper has none), table 1",
            format!("positive definite, at least {LEAST_EIGENVALUE:.1e} kg m^2"),
            format!(
                "least eigenvalues times 1000 of {}: {}; where motions here stay: {}; piece-wise {:.2}",
                CONFIGURATIONS.join(", "),
                least(&audits.printed),
                least(&audits.in_room),
                1e3 * audits.piece_wise.least_eigenvalue(),
            ),
            failed == 5 && below && super::rows::count(&audits.in_room, "inertia") == 0,
            "no installation has a positive definite inertia over the workspace, and none as much as printed in a part of it",
        ),
        Row::wrong_in_print(
            "4.definite.where",
            "where the inertia fails, by `audit` with the rest of the device loaded: upper limits of joint 2 from which on M11 is negative at some \
             angle of joint 3, degrees, and least eigenvalues of the block of joints 2 and 3 times 1000",
            "nowhere",
            format!(
                "M11: {}; block: {} of {}; piece-wise {}, {:.2}",
                fails.join(", "),
                blocks.join(", "),
                CONFIGURATIONS.join(", "),
                from(&audits.piece_wise_fails),
                1e3 * audits.piece_wise_fails.block
            ),
            audits.fails.iter().all(Fails::is_any) && !audits.piece_wise_fails.is_any(),
            "M11 = pi1 + pi2 cos(2 theta2) + pi3 cos(2 theta3) + pi4 cos(theta2) sin(theta3) falls below zero where the upper arm is raised",
        ),
        Row::wrong_in_print(
            "4.definite.motion",
            "the installations moved through the workspace: by the compiled device, and by the simulated one",
            "positive definite for the entire workspace",
            format!(
                "the compiled device has no acceleration at {} of {instants} instants, with the piece-wise column at {}; simulated, {} of 5 go \
                 through, the others get to where no motion follows from a torque; the piece-wise column {}",
                without.join(", "),
                audits.piece_wise_without,
                5 - stopped,
                if audits.piece_wise_moved.is_empty() {
                    "goes through"
                } else {
                    "does not"
                }
            ),
            audits.without_acceleration.iter().all(|count| *count > 0)
                && audits.piece_wise_without == 0
                && stopped == 5
                && audits.piece_wise_moved.is_empty(),
            &format!(
                "where the inertia is not positive definite the device cannot go; motions here stay within {:.0} to {:.0} degrees of joint 2 and {:.0} to {:.0} of joint 3",
                ROOM.low[1].to_degrees(),
                ROOM.high[1].to_degrees(),
                ROOM.low[2].to_degrees(),
                ROOM.high[2].to_degrees()
            ),
        ),
    ]
}
