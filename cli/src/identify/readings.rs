//! Whether a log is to be read in another way than the spec says, asked of its torques: angles in another unit, columns of another sign or in
//! another order, gravity along another axis.
//!
//! In: logs whose torques a model does not explain. Out: a sentence about the reading with which it explains them far better, if any.

use robot_model::identify::{Beyond, Estimate, Identify, Method};
use robot_model::log::Log;

use super::doubts;
use super::fit::Fit;
use crate::output::names;

mod candidate;
mod excerpt;
mod gravity;
mod units;

use candidate::{Candidate, Found, LESS, all, best};
use excerpt::excerpt;
use units::Units;

/// A model that explains its torques to this, percent, has their unit and order.
const WELL: f64 = 15.0;

/// A model that explains its torques to this, percent, has their signs: where gravity rules, a torque the other way round leaves a tenth, as
/// links of negative weight make up for the rest.
const WELL_IN_SIGNS: f64 = 4.0;

/// A model that explains its torques to this, percent, has them in radians: positions that are six times too small leave a sixth of what
/// gravity bends, which other parameters make up for.
const WELL_IN_TURNS: f64 = 5.0;

/// Columns that are in an order of joints.
#[derive(Clone, Copy)]
enum Columns {
    Torques,
    Positions,
    Both,
}

/// What is done to a log.
#[derive(Clone)]
enum Reading {
    /// Positions of joints are in another unit.
    In(Units, Vec<usize>),
    /// A column of a joint has the other sign.
    Mirrored(Channel, usize),
    /// Joint `k` of the spec has the columns of joint `order[k]`.
    Ordered(Columns, Vec<usize>),
    /// The arm stands otherwise: gravity in the base frame, m/s^2.
    Gravity([f64; 3]),
}

/// A column of a joint that may have the other sign.
#[derive(Clone, Copy)]
enum Channel {
    Position,
    Torque,
}

impl Reading {
    fn of(&self, log: &Log) -> Log {
        let mut read = log.clone();
        match self {
            Self::In(units, joints) => {
                for &joint in joints {
                    for q in &mut read.q[joint] {
                        *q *= units.factor();
                    }
                }
            }
            Self::Mirrored(channel, joint) => {
                let columns = match channel {
                    Channel::Position => &mut read.q,
                    Channel::Torque => &mut read.tau,
                };
                columns[*joint]
                    .iter_mut()
                    .for_each(|value| *value = -*value);
            }
            Self::Gravity(_) => {}
            Self::Ordered(columns, order) => {
                if !matches!(columns, Columns::Positions) {
                    read.tau = ordered(&log.tau, order);
                    read.clipped = ordered(&log.clipped, order);
                }
                if !matches!(columns, Columns::Torques) {
                    read.q = ordered(&log.q, order);
                    read.dq = ordered(&log.dq, order);
                    read.turn_speeds = ordered(&log.turn_speeds, order);
                }
            }
        }
        read
    }

    /// What it is, and a question.
    fn said(&self, joints: &[String]) -> [String; 2] {
        match self {
            Self::In(units, which) => units.said(which, joints),
            Self::Mirrored(channel, joint) => {
                let (what, column, unit, other) = match channel {
                    Channel::Position => ("position", "q", "rad", "torque"),
                    Channel::Torque => ("torque", "tau", "Nm", "position"),
                };
                [
                    format!("the {what} of `{}` with the opposite sign", joints[*joint]),
                    format!(
                        "does its sign agree with the spec's joint? If the {other} has the right sign, invert it in the spec: \
                         `log {{ {column} = \"{column}{}\": -1 {unit}, ..; }}`, else the {other}",
                        joint + 1
                    ),
                ]
            }
            Self::Gravity(gravity) => gravity::said(*gravity),
            Self::Ordered(columns, order) => {
                let columns = match columns {
                    Columns::Torques => "the torques",
                    Columns::Positions => "the positions",
                    Columns::Both => "positions and torques",
                };
                let moved = (0..order.len()).filter(|&joint| order[joint] != joint);
                let how = if let [one, other] = moved.collect::<Vec<_>>()[..] {
                    format!("of `{}` and `{}` swapped", joints[one], joints[other])
                } else {
                    let order: Vec<&str> = order.iter().map(|&k| joints[k].as_str()).collect();
                    format!("in the order {}", names(&order))
                };
                [
                    format!("{columns} {how}"),
                    "do the columns have the order of the spec's joints? Assign columns to joints in the spec's `log`".to_owned(),
                ]
            }
        }
    }
}

fn ordered<T: Clone>(columns: &[T], order: &[usize]) -> Vec<T> {
    // Logs need not have them.
    let known = order.iter().filter_map(|&k| columns.get(k).cloned());
    known.collect()
}

/// Says so where the torques follow positions in degrees or revolutions, columns in another order or another gravity far better than what the
/// spec has.
/// Where nothing bends with positions, as on a lone joint without gravity, no torque can tell.
pub(crate) fn others(
    form: &dyn Fit,
    identify: &Identify,
    logs: &[Log],
    found: &Estimate,
) -> Option<String> {
    let worst = found.relative_percent.iter().copied().fold(0.0, f64::max);
    // A joint that hardly bends with gravity may fit with a torque of the wrong sign, and friction that pushes.
    let asks_signs =
        worst > WELL_IN_SIGNS || doubts::impossible(found, form.unknowns()).next().is_some();
    if worst <= WELL_IN_TURNS && !asks_signs {
        return None;
    }
    let log = excerpt(logs.first()?);
    let asked = Asked {
        form,
        identify: plain(identify, found, &log),
        log,
    };
    let as_logged = asked.fit(&asked.log)?.left;
    let mut candidates = Vec::new();
    for reading in units::readings(form.model(), &asked.log, worst) {
        candidates.extend(asked.read(reading));
    }
    if asks_signs {
        let joints = 0..form.dof();
        let signs = joints.flat_map(|joint| {
            let channels = [Channel::Position, Channel::Torque];
            channels.map(|channel| Reading::Mirrored(channel, joint))
        });
        candidates.extend(signs.filter_map(|reading| asked.read(reading)));
    }
    let ill = found.relative_percent.iter().map(|left| *left > WELL);
    let ill: Vec<bool> = ill.collect();
    if ill.iter().filter(|is_ill| **is_ill).count() > 1 {
        for columns in [Columns::Torques, Columns::Positions, Columns::Both] {
            candidates.extend(asked.order(columns, &ill, &as_logged));
        }
    }
    let mut best_so_far = best(candidates, &as_logged);
    let explains = |candidate: &Candidate| {
        let mut left = candidate.found.left.iter();
        left.all(|left| *left <= WELL_IN_SIGNS)
    };
    if worst > WELL_IN_SIGNS && !best_so_far.as_ref().is_some_and(explains) {
        let more = best_so_far.into_iter().chain(asked.stand(&as_logged));
        best_so_far = best(more.collect(), &as_logged);
    }
    let best = best_so_far?;
    let left = &best.found.left;
    // Of the joint that it mends most.
    let fall = |joint: &usize| as_logged[*joint] - left[*joint];
    let joint = (0..left.len()).max_by(|a, b| fall(a).total_cmp(&fall(b)))?;
    let [what, question] = best.reading.said(&found.joints);
    Some(format!(
        "with {what} the residual is {:.1} % of the torque of `{}`, as logged {:.0} %: {question}",
        left[joint], found.joints[joint], as_logged[joint]
    ))
}

/// Without what units and orders do not need: bands and shapes are those that were found.
fn plain(identify: &Identify, found: &Estimate, log: &Log) -> Identify {
    let shapes = found.shapes.iter().map(|(_, value)| *value);
    Identify {
        bands: Some(found.bands.at_rate(log.rate_hz())),
        shapes: Some(shapes.collect()),
        bootstrap: 0,
        essential: false,
        beyond: Beyond::Residuals,
        instruments: Vec::new(),
        method: Method::Wls,
        ..identify.clone()
    }
}

/// What is asked.
struct Asked<'a> {
    form: &'a dyn Fit,
    identify: Identify,
    log: Log,
}

impl Asked<'_> {
    fn fit(&self, log: &Log) -> Option<Found> {
        self.fit_of(self.form, log)
    }

    fn fit_of(&self, form: &dyn Fit, log: &Log) -> Option<Found> {
        let found = form.fit(&self.identify, std::slice::from_ref(log));
        let found = found.ok()?;
        let pairs = found.parameters.iter().zip(form.unknowns());
        let impossible = pairs.filter(|(own, unknown)| unknown.nonnegative && own.value < 0.0);
        let impossible = impossible.count();
        let left = found.relative_percent;
        all(&left).is_finite().then_some(Found { left, impossible })
    }

    fn read(&self, reading: Reading) -> Option<Candidate> {
        let found = self.fit(&reading.of(&self.log))?;
        Some(Candidate { reading, found })
    }

    /// The order that exchanges of two columns lead to, one after the other, each of which leaves less. Torques that are another joint's
    /// are explained ill on both, positions at least on one.
    fn order(&self, columns: Columns, ill: &[bool], as_logged: &[f64]) -> Option<Candidate> {
        let dof = self.form.dof();
        let mut order: Vec<usize> = (0..dof).collect();
        let mut best: Option<Candidate> = None;
        for _ in 1..dof {
            let pairs = (0..dof).flat_map(|i| (i + 1..dof).map(move |k| (i, k)));
            let pairs = pairs.filter(|&(i, k)| match columns {
                Columns::Torques => ill[i] && ill[k],
                Columns::Positions | Columns::Both => ill[i] || ill[k],
            });
            let exchanged = pairs.filter_map(|(i, k)| {
                let mut order = order.clone();
                order.swap(i, k);
                self.read(Reading::Ordered(columns, order))
            });
            let next =
                exchanged.min_by(|x, y| all(&x.found.left).total_cmp(&all(&y.found.left)))?;
            let so_far = best.as_ref().map_or(as_logged, |best| &best.found.left);
            if all(&next.found.left) > LESS * all(so_far) {
                break;
            }
            if let Reading::Ordered(_, found) = &next.reading {
                order.clone_from(found);
            }
            best = Some(next);
        }
        best
    }
}
