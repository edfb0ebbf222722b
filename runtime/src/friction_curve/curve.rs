//! Friction torque over speed, the rigid body's torque fitted beside it.

use faer::Mat;

use super::rows::{Measured, Rows, Runs};
use super::solution::{Chosen, Solution, deviation, norm, within};
use super::stretch::SAME;
use super::{FrictionError, Value, late};
use crate::log::Log;

/// What is left of a column of unit length beside others, or while the speed stays: below this it counts as nothing. Errors of what is
/// kept grow by a thousand at most.
const APART: f64 = 1e-3;

/// Columns below this are rounding, per unit of their parameter in SI.
const ROUNDING: f64 = 1e-12;

/// Friction at one speed.
///
/// # Examples
/// ```
/// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
/// let curve = motor::measured(&motor::motor()).curve(&[motor::runs()])?;
/// // Friction brakes.
/// assert!(curve.points.iter().all(|point| point.speed * point.torque.value > 0.0));
/// # Ok::<(), robot_model::friction_curve::FrictionError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Point {
    /// Mean speed, rad/s or m/s.
    pub speed: f64,
    /// Friction torque, N m or N, with constants of the arm that are none.
    pub torque: Value,
    /// How long the joint moved so, s.
    pub seconds: f64,
    /// In how many stretches.
    pub stretches: usize,
}

/// A joint's friction curve: the solution of `gain tau = Y_j beta + sum_k f_k [speed k]` by least squares, on means over 0.05 s.
///
/// Speeds within 5 % of each other are one. Standard deviations are of each speed's own errors, with their correlation from block to
/// block: slow noise counts for more. Example: [`Measured`].
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Curve {
    /// Points by rising speed, negative ones first.
    pub points: Vec<Point>,
    /// Columns of the rigid body that were fitted, besides what accelerations add to them.
    pub rank: usize,
    /// Whether a constant of the rigid body's torque, as gravity on a rail or over a short way, is in the points.
    pub has_constant: bool,
    /// What was fitted beside the points: columns of the arm with their values. They make the joint's torque where other joints stand
    /// as they did, and say nothing of single parameters.
    pub beside: Vec<(usize, f64)>,
    /// From where to where each joint went or stood, rad or m.
    pub range: Vec<(f64, f64)>,
    /// By how much a velocity changes with one step of the encoder where it is the difference of two neighboring samples, rad/s or m/s; the
    /// least of all logs. Speeds of the points are slopes over stretches, and far finer.
    pub speed_step: f64,
    /// By how much torques come after the positions, s, where the stretches tell; it is fitted beside the points. A weight's torque that comes
    /// late is greater on the way up and less on the way down, or the other way round, as viscous friction is.
    pub late: Option<Value>,
    /// How far each block's error moves each point, one deviation of it, `[block, point]`.
    influence: Mat<f64>,
}

impl Measured<'_> {
    /// The friction curve.
    ///
    /// # Errors
    /// [`FrictionError`]: no stretch of constant speed; a rigid body's torque that the motion does not tell from friction; logs that cannot
    /// be filtered.
    ///
    /// # Examples
    /// A motor alone, 2 s at each of six speeds:
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// let motor = motor::motor();
    /// let curve = motor::measured(&motor).curve(&[motor::runs()])?;
    /// assert_eq!(curve.points.len(), 6);
    /// for (k, point) in curve.points.iter().enumerate() {
    ///     let speed = 0.5 * (k + 1) as f64;
    ///     assert!((point.speed - speed).abs() < 1e-6);
    ///     assert!((point.torque.value - (0.5 + 0.1 * speed)).abs() < 1e-3); // N m
    /// }
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    pub fn curve(&self, logs: &[Log]) -> Result<Curve, FrictionError> {
        let Runs {
            mut rows,
            stretches,
            range,
            speed_step,
        } = self.runs(logs)?;
        if stretches.is_empty() {
            let joint = self.name();
            return Err(FrictionError::NoStretch { joint });
        }
        let cells = cells(&stretches);
        let cell: Vec<usize> = rows.stretch.iter().map(|&k| cells[k]).collect();
        let count = cells.iter().max().map_or(0, |most| most + 1);
        let travel = range[self.joint].1 - range[self.joint].0;
        let mut chosen = self.chosen(&rows, &cell, count, travel)?;
        let has_both = [-1.0, 1.0]
            .iter()
            .all(|way| stretches.iter().any(|(speed, _)| way * speed > 0.0));
        if chosen.has_constant && !has_both {
            let joint = self.name();
            return Err(FrictionError::Constant { joint });
        }
        let first = Solution::new(&rows, &cell, count, &chosen);
        let later = late::beside(&mut rows, &mut chosen, &first, &cell, count);
        let late = later.as_ref().map(|(late, _)| *late);
        let Solution {
            torques,
            beta,
            influence,
            ..
        } = later.map_or(first, |(_, solution)| solution);
        let points = (0..count).map(|k| {
            let here = stretches.iter().zip(&cells).filter(|(_, at)| **at == k);
            let seconds: f64 = here.clone().map(|((_, seconds), _)| seconds).sum();
            let way: f64 = here.clone().map(|((v, seconds), _)| v * seconds).sum();
            Point {
                speed: way / seconds,
                torque: Value {
                    value: torques[k],
                    std: deviation(&influence, |point| if point == k { 1.0 } else { 0.0 }),
                },
                seconds,
                stretches: here.count(),
            }
        });
        let beside = chosen.places.iter().zip(beta);
        let beside = beside.filter_map(|(&place, value)| Some((*self.columns.get(place)?, value)));
        let beside: Vec<(usize, f64)> = beside.collect();
        Ok(Curve {
            points: points.collect(),
            rank: beside.len(),
            has_constant: chosen.has_constant,
            beside,
            range,
            speed_step,
            late,
            influence,
        })
    }

    /// Columns whose changes are no sums of others' changes; they have to change while the speed stays, too.
    fn chosen(
        &self,
        rows: &Rows,
        cell: &[usize],
        count: usize,
        travel: f64,
    ) -> Result<Chosen, FrictionError> {
        let lengths: Vec<f64> = rows.columns.iter().map(|column| norm(column)).collect();
        let there = (0..lengths.len())
            .filter(|&k| lengths[k] > ROUNDING * (rows.torque.len() as f64).sqrt());
        let mut changing = Vec::new();
        let mut whole = Vec::new();
        for place in there {
            let column = rows.columns[place].iter().map(|x| x / lengths[place]);
            let column: Vec<f64> = column.collect();
            let change = within(&column, &vec![0; column.len()], 1);
            changing.push((place, change, within(&column, cell, count)));
            // What the columns make and their changes do not is a constant.
            if place < self.columns.len() {
                whole.push(column);
            }
        }
        let order = independent(changing.iter().map(|(_, change, _)| change));
        let mut kept: Vec<&(usize, Vec<f64>, Vec<f64>)> =
            order.iter().map(|&k| &changing[k]).collect();
        kept.sort_by_key(|(place, ..)| *place);
        // Accelerations that go with a speed are few, and left out.
        let even = kept
            .iter()
            .filter(|(place, ..)| *place < self.columns.len());
        let even: Vec<&(usize, Vec<f64>, Vec<f64>)> = even.copied().collect();
        let rank = |kept: &[&(usize, Vec<f64>, Vec<f64>)]| {
            independent(kept.iter().map(|(_, _, within)| within)).len()
        };
        if rank(&even) < even.len() {
            return Err(FrictionError::NotSeparated {
                joint: self.name(),
                columns: even.len(),
                rank: rank(&even),
                travel,
            });
        }
        let has_constant = independent(whole.iter()).len() > even.len();
        let kept = if rank(&kept) < kept.len() { even } else { kept };
        let places: Vec<usize> = kept.iter().map(|(place, ..)| *place).collect();
        Ok(Chosen {
            lengths: places.iter().map(|&place| lengths[place]).collect(),
            has_constant,
            places,
        })
    }
}

impl Curve {
    /// The curve of a joint without a rigid body, from torques of blocks at each speed.
    #[cfg(test)]
    pub(super) fn of_blocks(speeds: &[f64], blocks: &[Vec<f64>]) -> Self {
        let count = speeds.len();
        let cell = blocks.iter().enumerate();
        let cell: Vec<usize> = cell.flat_map(|(k, blocks)| vec![k; blocks.len()]).collect();
        let rows = Rows {
            torque: blocks.concat(),
            ..Rows::default()
        };
        let nothing = Chosen {
            places: Vec::new(),
            lengths: Vec::new(),
            has_constant: false,
        };
        let solution = Solution::new(&rows, &cell, count, &nothing);
        let (torques, influence) = (solution.torques, solution.influence);
        let point = |k: usize| Point {
            speed: speeds[k],
            torque: Value {
                value: torques[k],
                std: deviation(&influence, |point| if point == k { 1.0 } else { 0.0 }),
            },
            seconds: 1.0,
            stretches: 1,
        };
        Self {
            points: (0..count).map(point).collect(),
            rank: 0,
            has_constant: false,
            beside: Vec::new(),
            range: Vec::new(),
            speed_step: 0.0,
            late: None,
            influence,
        }
    }

    /// Standard deviation of `sum_k weight(k) f_k`.
    pub(super) fn deviation(&self, weight: impl Fn(usize) -> f64) -> f64 {
        deviation(&self.influence, weight)
    }
}

/// A cell for each stretch, from 0 by rising speed: within it speeds are alike.
fn cells(stretches: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..stretches.len()).collect();
    order.sort_by(|&one, &other| stretches[one].0.total_cmp(&stretches[other].0));
    let mut cells = vec![0; stretches.len()];
    let (mut cell, mut first) = (0, f64::NAN);
    for k in order {
        let speed = stretches[k].0;
        if first.is_nan() {
            first = speed;
        } else if speed - first > SAME * speed.abs().max(first.abs()) {
            cell += 1;
            first = speed;
        }
        cells[k] = cell;
    }
    cells
}

/// Columns of which more than [`APART`] is left beside those before, by pivoted QR.
fn independent<'a>(columns: impl Iterator<Item = &'a Vec<f64>>) -> Vec<usize> {
    let columns: Vec<&Vec<f64>> = columns.collect();
    let Some(rows) = columns.first().map(|column| column.len()) else {
        return Vec::new();
    };
    let matrix = Mat::from_fn(rows, columns.len(), |row, c| columns[c][row]);
    let pivoted = matrix.col_piv_qr();
    let diagonal = pivoted.thin_R();
    let rank = (0..columns.len().min(rows))
        .take_while(|&k| diagonal[(k, k)].abs() > APART)
        .count();
    pivoted.P().arrays().0[..rank].to_vec()
}
