//! Table 1, asked whether a device can have it.

use robot_model_cli::audit::{Check, audit};

use super::device::{SPEC, by_name, compiled, within};
use super::fits::STIFF;
use super::plant::Plant;
use super::rig;
use super::sines::{ROOM, Room, Sines};
use super::truth::{Pi, piece_wise, table_1};
use crate::paper::Error;

/// What is found in a set of parameters.
#[derive(Debug, Clone)]
pub struct Audited(Vec<Check>);

impl Audited {
    /// Asks of one set.
    ///
    /// # Errors
    /// Those of the text.
    pub fn of(text: &str, pi: &Pi) -> Result<Self, Error> {
        Ok(Self(audit(&compiled(text)?, &by_name(pi))?))
    }

    fn check(&self, name: &str) -> Option<&Check> {
        self.0.iter().find(|check| check.name == name)
    }

    /// What speaks against the values in one check.
    #[must_use]
    pub fn findings(&self, check: &str) -> &[String] {
        self.check(check).map_or(&[], |check| &check.findings)
    }

    /// Least eigenvalue of the inertia as the check says it, kg m^2.
    #[must_use]
    pub fn least_eigenvalue(&self) -> f64 {
        let scope = self.check("inertia").map_or("", |check| &check.scope);
        let (_, number) = scope.split_once(": ").unwrap_or_default();
        let number = number.split(' ').next().and_then(|word| word.parse().ok());
        number.unwrap_or(f64::NAN)
    }
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
}

/// Asks.
///
/// # Errors
/// None are expected: the names are those of the spec.
pub fn all() -> Result<Audits, Error> {
    let room = within(ROOM.low, ROOM.high);
    let each = |text: &str, change: fn(Pi) -> Pi| -> Result<Vec<Audited>, Error> {
        (0..5)
            .map(|k| Audited::of(text, &change(table_1(k))))
            .collect()
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
    let moved = (0..5).map(|k| {
        let plant = Plant::new(table_1(k), motion.at(0.0)[0]);
        let run = rig::run(plant, &motion, &STIFF, 40.0, 45);
        run.err()
            .map_or_else(String::new, |error| error.to_string())
    });
    Ok(Audits {
        moved: moved.collect(),
        printed: each(SPEC, |pi| pi)?,
        in_room: each(&room, |pi| pi)?,
        positive: each(SPEC, positive)?,
        piece_wise: Audited::of(SPEC, &piece_wise())?,
    })
}
