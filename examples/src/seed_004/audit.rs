//! Table 1, asked whether a device can have it.

use super::device::{SPEC, by_name, compiled, within};
use super::fits::STIFF;
use super::plant::Plant;
use super::rig;
use super::sines::{ROOM, Room, Sines};
use super::truth::{Pi, piece_wise, table_1};
use crate::paper::{Audited, Error};

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
}

/// Asks.
///
/// # Errors
/// None are expected: the names are those of the spec.
pub fn all() -> Result<Audits, Error> {
    let room = within(ROOM.low, ROOM.high);
    let each = |text: &str, change: fn(Pi) -> Pi| -> Result<Vec<Audited>, Error> {
        (0..5).map(|k| audited(text, &change(table_1(k)))).collect()
    };
    let positive = |mut pi: Pi| {
        for fv in &mut pi[8..11] {
            *fv = fv.abs();
        }
        pi
    };
    // The limits of the spec.
    let whole = Room {
        low: [-60.0, -30.0, -30.0].map(f64::to_radians),
        high: [60.0, 100.0, 75.0].map(f64::to_radians),
    };
    let motion = Sines::new(10, &whole, 4);
    let moved = |pi: Pi| {
        let plant = Plant::new(pi, motion.at(0.0)[0]);
        let run = rig::run(plant, &motion, &STIFF, 40.0, 45);
        run.err()
            .map_or_else(String::new, |error| error.to_string())
    };
    Ok(Audits {
        moved: (0..5).map(|k| moved(table_1(k))).collect(),
        piece_wise_moved: moved(piece_wise()),
        printed: each(SPEC, |pi| pi)?,
        in_room: each(&room, |pi| pi)?,
        positive: each(SPEC, positive)?,
        piece_wise: audited(SPEC, &piece_wise())?,
    })
}
