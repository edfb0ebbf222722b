//! First values of a candidate's shapes: which of them explain most.
//!
//! Columns of small grids are formed once and kept. Those of a law with many points, as the beginning and end of a contact are, would
//! fill memory: they are screened in every round on the rows of the fit alone, unfiltered, and only the best is formed.

use std::cmp::Ordering;
use std::sync::Mutex;
use std::sync::atomic::{self, AtomicUsize};

use crate::columns::{Candidate, Entry};
use crate::motion::{Kinematics, Motion};
use crate::signal::Prepared;

use super::projected::Projected;
use super::rows::Rows;
use super::score::Present;
use super::trial::{Trial, points, project};

/// Grids of more points than this are screened.
const MOST_FORMED: usize = 128;

/// A candidate at its first values.
pub(super) enum Grid<'a> {
    /// Every point with its filtered columns.
    Formed(Vec<Trial<'a>>),
    /// Too many points to keep.
    Screened(&'a dyn Candidate),
}

impl<'a> Grid<'a> {
    pub(super) fn new(candidate: &'a dyn Candidate, rows: Rows) -> Self {
        let points = points(candidate);
        if points.len() > MOST_FORMED {
            return Self::Screened(candidate);
        }
        let formed = points.into_iter();
        Self::Formed(
            formed
                .map(|shapes| Trial::new(candidate, shapes, rows))
                .collect(),
        )
    }

    /// How many points there are.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Formed(trials) => trials.len(),
            Self::Screened(candidate) => candidate
                .shapes()
                .iter()
                .map(|shape| shape.grid.len())
                .product(),
        }
    }

    /// Its points' columns, as rows of the fit; `motions` are those of the rows.
    pub(super) fn each(
        &self,
        present: &Present,
        motions: &[Motion],
        see: &mut dyn FnMut(&dyn Candidate, &[Entry]),
    ) {
        match self {
            Self::Formed(trials) => {
                for trial in trials {
                    see(trial.candidate, &trial.entries);
                }
            }
            Self::Screened(candidate) => {
                for shapes in points(*candidate) {
                    see(*candidate, &over(*candidate, motions, &shapes, present));
                }
            }
        }
    }

    /// The point that explains most of the residual with parameters of the signs that they may have, and how much; `None` where none says
    /// anything new.
    pub(super) fn best(
        &self,
        present: &Present,
        rows: Rows,
        motions: &[Motion],
    ) -> Option<(f64, Trial<'a>)> {
        match self {
            Self::Formed(trials) => {
                let explained = trials.iter().filter_map(|trial| {
                    let projected = trial.project(present)?;
                    Some((Explained::new(trial.candidate, &projected), trial))
                });
                let (explained, trial) = explained.max_by(|a, b| a.0.total_cmp(&b.0))?;
                Some((explained.admissible, trial.clone()))
            }
            Self::Screened(candidate) => {
                let shapes = screened(*candidate, present, motions)?;
                let trial = Trial::new(*candidate, shapes, rows);
                let projected = trial.project(present)?;
                Some((Explained::new(*candidate, &projected).admissible, trial))
            }
        }
    }
}

/// How much a point explains.
#[derive(Clone, Copy)]
struct Explained {
    /// With parameters of the signs that they may have.
    admissible: f64,
    /// With any.
    drop: f64,
}

impl Explained {
    fn new(candidate: &dyn Candidate, projected: &Projected) -> Self {
        Self {
            admissible: projected.admissible_drop(candidate),
            drop: projected.drop,
        }
    }

    /// Points that explain nothing with the signs of their parameters come in the order of what they explain without.
    fn total_cmp(&self, other: &Self) -> Ordering {
        let order = self.admissible.total_cmp(&other.admissible);
        order.then_with(|| self.drop.total_cmp(&other.drop))
    }
}

/// The best point of a large grid, on all cores.
fn screened(candidate: &dyn Candidate, present: &Present, motions: &[Motion]) -> Option<Vec<f64>> {
    let points = points(candidate);
    let next = AtomicUsize::new(0);
    let best: Mutex<Option<(Explained, usize)>> = Mutex::new(None);
    let work = || {
        loop {
            let number = next.fetch_add(1, atomic::Ordering::Relaxed);
            let Some(shapes) = points.get(number) else {
                return;
            };
            let entries = over(candidate, motions, shapes, present);
            let Some(projected) = project(candidate, &entries, present) else {
                continue;
            };
            let mut best = best.lock().expect("no panic while it is held");
            // Of equal ones the first, whatever thread came to it.
            let explained = Explained::new(candidate, &projected);
            let is_better = best.is_none_or(|(other, at)| {
                let order = explained.total_cmp(&other);
                order.then_with(|| at.cmp(&number)).is_gt()
            });
            if is_better {
                *best = Some((explained, number));
            }
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(work);
        }
    });
    let (_, number) = best.into_inner().expect("no panic while it is held")?;
    Some(points[number].clone())
}

/// A candidate's columns over several motions, one after the other, where the fit has rows.
fn over(
    candidate: &dyn Candidate,
    motions: &[Motion],
    shapes: &[f64],
    present: &Present,
) -> Vec<Entry> {
    let mut all: Vec<Entry> = Vec::new();
    for motion in motions {
        let entries = candidate.entries(motion, shapes);
        if all.is_empty() {
            all = entries;
        } else {
            for (sum, entry) in all.iter_mut().zip(entries) {
                sum.values.extend(entry.values);
            }
        }
    }
    present.stack.clear_left_out(&mut all);
    all
}

/// The samples of a log's motion that are rows of the fit.
pub(super) fn rows(log: &Prepared) -> Motion {
    let kept: Vec<usize> = log.shared.kept(log.motion.time.len()).collect();
    let pick = |values: &Vec<f64>| -> Vec<f64> { kept.iter().map(|&k| values[k]).collect() };
    let all = |columns: &Vec<Vec<f64>>| columns.iter().map(pick).collect();
    let of = |kinematics: &Kinematics| Kinematics {
        q: all(&kinematics.q),
        dq: all(&kinematics.dq),
        ddq: all(&kinematics.ddq),
    };
    let motion = &log.motion;
    Motion {
        time: pick(&motion.time),
        smooth: of(&motion.smooth),
        wide: of(&motion.wide),
        rigid_torque: all(&motion.rigid_torque),
        tau: all(&motion.tau),
        transmitted_torque: all(&motion.transmitted_torque),
        extra: motion
            .extra
            .iter()
            .map(|channel| crate::log::Channel {
                name: channel.name.clone(),
                values: pick(&channel.values),
            })
            .collect(),
        displacement_hz: motion.displacement_hz,
        turn_speeds: motion.turn_speeds.clone(),
    }
}
