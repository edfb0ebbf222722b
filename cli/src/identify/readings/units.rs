//! Angles of a log in another unit than the one that they are read in.

use std::f64::consts::{PI, TAU};

use robot_model::log::Log;
use robot_model_spec::Model;
use robot_model_spec::model::JointKind;

use super::{Reading, WELL, WELL_IN_TURNS};

/// Numbers that are smaller angles than they are read as are asked for where a joint moves further than this, rad: in degrees it is three of
/// them, and less is hardly a motion.
const LEAST_RANGE: f64 = 3.0;

/// Numbers that are larger angles than they are read as are asked for where no joint would move by more than this, rad.
const MOST_RANGE: f64 = 3.0 * TAU;

/// A unit of angles.
#[derive(Clone, Copy)]
struct Unit {
    plural: &'static str,
    /// Name in a spec.
    name: &'static str,
    /// Its size, rad.
    size: f64,
}

const RADIANS: Unit = Unit {
    plural: "radians",
    name: "rad",
    size: 1.0,
};
const DEGREES: Unit = Unit {
    plural: "degrees",
    name: "deg",
    size: PI / 180.0,
};
const TURNS: Unit = Unit {
    plural: "revolutions",
    name: "rev",
    size: TAU,
};

/// The unit that numbers are read in, and the one that they are in.
#[derive(Clone, Copy)]
pub(super) struct Units {
    read: Unit,
    own: Unit,
}

impl Units {
    /// Radians that are degrees, and so on. No two of them have the same factor, so the factor that mends a log says how it is read, too.
    pub(super) const ALL: [Self; 6] = [
        Self::of(RADIANS, DEGREES),
        Self::of(RADIANS, TURNS),
        Self::of(DEGREES, RADIANS),
        Self::of(DEGREES, TURNS),
        Self::of(TURNS, RADIANS),
        Self::of(TURNS, DEGREES),
    ];

    const fn of(read: Unit, own: Unit) -> Self {
        Self { read, own }
    }

    /// By which positions are multiplied to be what they are.
    pub(super) fn factor(self) -> f64 {
        self.own.size / self.read.size
    }

    /// What the positions of some joints are, and a question.
    pub(super) fn said(self, which: &[usize], joints: &[String]) -> [String; 2] {
        let (positions, are_they) = match which {
            [joint] if joints.len() > 1 => {
                (format!("the position of `{}`", joints[*joint]), "is it")
            }
            _ => ("positions".to_owned(), "are they"),
        };
        let Unit { plural, name, .. } = self.own;
        let first = which.first().map_or(1, |joint| joint + 1);
        let line = format!("`log {{ q = \"q{first}\": {name}, ..; }}`");
        let as_read = if self.read.name == RADIANS.name {
            format!("Logs are in rad unless the spec says otherwise: {line}")
        } else {
            format!(
                "The spec, a robot-model.toml or a line of units says {}; write {line}, or `unit = \"{name}\"` in the settings",
                self.read.plural
            )
        };
        [
            format!("{positions} in {plural}"),
            format!("{are_they} in {plural}? {as_read}"),
        ]
    }
}

/// Units that a log may be in whose worst torque is left by so many percent.
pub(super) fn readings(model: &Model, log: &Log, worst: f64) -> Vec<Reading> {
    let ranges = ranges(model, log);
    let all = || ranges.iter().map(|(joint, _)| *joint).collect::<Vec<_>>();
    let far = || ranges.iter().filter(|(_, range)| *range > LEAST_RANGE);
    let mut readings = Vec::new();
    for units in Units::ALL {
        let factor = units.factor();
        // Angles that are read too small leave little of what gravity bends, which other parameters make up for.
        let is_likely = if factor > 1.0 {
            worst > WELL_IN_TURNS && ranges.iter().all(|(_, range)| factor * range < MOST_RANGE)
        } else {
            worst > WELL && far().next().is_some()
        };
        if is_likely && !ranges.is_empty() {
            readings.push(Reading::In(units, all()));
        }
    }
    if worst > WELL && ranges.len() > 1 {
        let one = |(joint, _): &(usize, f64)| Reading::In(Units::ALL[0], vec![*joint]);
        readings.extend(far().map(one));
    }
    readings
}

/// How far revolute joints move in a log, by joint.
fn ranges(model: &Model, log: &Log) -> Vec<(usize, f64)> {
    let joints = model.joints.iter().enumerate();
    let revolute = joints.filter(|(_, joint)| joint.kind != JointKind::Prismatic);
    let range = |joint: usize| {
        let (low, high) = log.q[joint]
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| {
                (low.min(*q), high.max(*q))
            });
        high - low
    };
    revolute.map(|(k, _)| (k, range(k))).collect()
}
