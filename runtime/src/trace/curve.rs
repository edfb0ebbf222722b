//! Curves and surfaces in quantities of the motion: columns that are 1 at one knot and fall to 0 at its neighbors, and how far they may bend.

use faer::Mat;

use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

use super::normal::{Normal, Smooth};
use super::quantity::{Axis, Quantity};
use super::search::Search;

/// A curve is straight between so many values of its quantity, among which samples are evenly spread.
const KNOTS: usize = 24;

/// The same of a surface in two quantities, for each of them.
const FEW_KNOTS: usize = 8;

/// Knots in time are further apart, s: a curve has to reach across the blocks that a fold leaves out.
const KNOT_S: f64 = 6.0;

/// A quantity that spans less than this of its largest value stands.
const LEAST_SPAN: f64 = 1e-6;

/// How much a curve's bends count beside what its columns hold, the best of which is taken: a knot that a fold hardly sees goes on as its
/// neighbors do (P-splines, Eilers & Marx 1996).
pub(super) const STIFFNESS: [f64; 3] = [1e-2, 0.3, 10.0];

/// A curve or surface, filtered.
pub(super) struct Curve {
    /// One a knot; where a velocity may jump, one more, or one for each knot of the other axis.
    pub(super) columns: Vec<Vec<f64>>,
    /// Columns of three knots in a row along an axis.
    pub(super) bends: Vec<[usize; 3]>,
}

impl Axis {
    /// The values between which a curve is straight; none of a quantity that stands.
    fn knots(self, most: usize, logs: &[Prepared]) -> Option<Vec<f64>> {
        let mut values: Vec<f64> = Vec::new();
        for log in logs {
            let of_log = self.values(log);
            values.extend(log.shared.kept(of_log.len()).map(|k| of_log[k]));
        }
        values.sort_by(f64::total_cmp);
        let (first, last) = (*values.first()?, *values.last()?);
        let count = match self {
            Self::Time => whole_steps((last - first) / KNOT_S).clamp(2, most),
            _ => most,
        };
        let at = |k: usize| values[k * (values.len() - 1) / (count - 1)];
        let mut knots: Vec<f64> = (0..count).map(at).collect();
        // Where a joint rests many samples are the same.
        let least = (last - first) / (8 * most) as f64;
        knots.dedup_by(|next, before| *next - *before < least);
        let stands = last - first <= LEAST_SPAN * first.abs().max(last.abs());
        (knots.len() > 1 && !stands).then_some(knots)
    }
}

impl Search<'_> {
    /// Columns of a curve in a quantity, filtered: each is 1 at one knot and falls to 0 at its neighbors. None of a quantity that stands.
    pub(super) fn curve(&self, of: Quantity) -> Option<Curve> {
        let is_surface = of.axes().len() > 1;
        self.smooth(of, if is_surface { FEW_KNOTS } else { KNOTS })
    }

    /// The same with so many knots along each quantity.
    pub(super) fn smooth(&self, of: Quantity, most: usize) -> Option<Curve> {
        let axes = of.axes();
        let knots = axes.iter().map(|axis| axis.knots(most, &self.prepared));
        let knots = knots.collect::<Option<Vec<_>>>()?;
        let lengths: Vec<usize> = knots.iter().map(Vec::len).collect();
        let cells: usize = lengths.iter().product();
        let mut bends = bends(&lengths);
        let velocity = axes.last().filter(|axis| matches!(axis, Axis::Velocity(_)));
        let mut count = cells;
        if velocity.is_some() {
            // The jump may be another one at each knot of the other axis.
            let others = &lengths[..lengths.len() - 1];
            let of_jump = self::bends(others).into_iter();
            bends.extend(of_jump.map(|three| three.map(|cell| cells + cell)));
            count += others.iter().product::<usize>();
        }
        let mut all = vec![Vec::new(); count];
        let mut filtered = Vec::new();
        for log in &self.prepared {
            let samples = log.motion.time.len();
            let mut columns = vec![vec![0.0; samples]; all.len()];
            for k in 0..samples {
                for (cell, weight) in near(&axes, &knots, log, k) {
                    columns[cell][k] = weight;
                }
                if let Some(velocity) = velocity {
                    let sign = velocity.values(log)[k].signum();
                    let others = axes.len() - 1;
                    for (cell, weight) in near(&axes[..others], &knots[..others], log, k) {
                        columns[cells + cell][k] = weight * sign;
                    }
                }
            }
            for (all, column) in all.iter_mut().zip(&columns) {
                log.shared.apply(column, &mut filtered);
                all.extend_from_slice(&filtered);
            }
        }
        Some(Curve {
            columns: all,
            bends,
        })
    }
}

/// Cells of a grid around a sample, with the weight of each.
fn near(axes: &[Axis], knots: &[Vec<f64>], log: &Prepared, sample: usize) -> Vec<(usize, f64)> {
    let mut near = vec![(0, 1.0)];
    for (axis, knots) in axes.iter().zip(knots) {
        let (place, part) = between(knots, axis.values(log)[sample]);
        let beside = |&(cell, weight): &(usize, f64)| {
            let cell = cell * knots.len() + place;
            [(cell, weight * (1.0 - part)), (cell + 1, weight * part)]
        };
        near = near.iter().flat_map(beside).collect();
    }
    near
}

/// Cells of three knots in a row along an axis of a grid, whose last axis runs fastest.
fn bends(lengths: &[usize]) -> Vec<[usize; 3]> {
    let cells: usize = lengths.iter().product();
    let mut bends = Vec::new();
    let mut stride = 1;
    for length in lengths.iter().rev() {
        let is_first = |cell: &usize| cell / stride % length + 2 < *length;
        let three = |cell: usize| [cell, cell + stride, cell + 2 * stride];
        bends.extend((0..cells).filter(is_first).map(three));
        stride *= length;
    }
    bends
}

/// The knot below a value, and how far that is on the way to the next one.
fn between(knots: &[f64], value: f64) -> (usize, f64) {
    let above = knots.partition_point(|knot| *knot <= value);
    let above = above.clamp(1, knots.len() - 1);
    let (low, high) = (knots[above - 1], knots[above]);
    (above - 1, ((value - low) / (high - low)).clamp(0.0, 1.0))
}

/// Least squares of a curve of each stiffness on values over some rows.
pub(super) fn fitted(curve: &Curve, values: &[f64], rows: &[usize]) -> [Vec<f64>; STIFFNESS.len()] {
    let products = [products(curve, values, rows)];
    let squares: Vec<f64> = (0..curve.columns.len())
        .map(|c| products[0][(c, c)])
        .collect();
    STIFFNESS.map(|stiffness| {
        let smooth = Smooth {
            first: 0,
            bends: &curve.bends,
            stiffness,
        };
        Normal::smooth(&products, &[1.0], &squares, &smooth).solve()
    })
}

/// Products of a curve's columns and values over some rows, values last.
fn products(curve: &Curve, values: &[f64], rows: &[usize]) -> Mat<f64> {
    let columns = curve.columns.iter().map(Vec::as_slice);
    let all: Vec<&[f64]> = columns.chain([values]).collect();
    let dot = |a: &[f64], b: &[f64]| rows.iter().map(|&k| a[k] * b[k]).sum::<f64>();
    let mut products = Mat::<f64>::zeros(all.len(), all.len());
    for a in 0..all.len() {
        for b in 0..=a {
            let product = dot(all[a], all[b]);
            products[(a, b)] = product;
            products[(b, a)] = product;
        }
    }
    products
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bends_run_along_the_axes() {
        assert_eq!(bends(&[4]), [[0, 1, 2], [1, 2, 3]]);
        assert_eq!(bends(&[2]), [[0; 3]; 0]);
        // Two rows of three, which have no column of three.
        assert_eq!(bends(&[2, 3]), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(bends(&[3, 2]), [[0, 2, 4], [1, 3, 5]]);
    }

    /// A straight line by five knots, of which rows that it may see are beside the first two and the last two.
    #[test]
    fn a_curve_goes_on_where_no_row_may_be_seen() {
        let place = |k: i32| 0.04 * f64::from(k);
        let near = |knot: i32, k: i32| (1.0 - (place(k) - f64::from(knot)).abs()).max(0.0);
        let columns = (0..5).map(|knot| (0..=100).map(|k| near(knot, k)).collect());
        let curve = Curve {
            columns: columns.collect(),
            bends: vec![[0, 1, 2], [1, 2, 3], [2, 3, 4]],
        };
        let is_seen = |k: &i32| place(*k) <= 1.0 || place(*k) >= 3.0;
        let line = |k: i32| 2.0 - 0.5 * place(k);
        let value = |k: i32| if is_seen(&k) { line(k) } else { 1e6 };
        let values: Vec<f64> = (0..=100).map(value).collect();
        let rows = (0..=100).filter(is_seen).map(|k| k.unsigned_abs() as usize);
        let rows: Vec<usize> = rows.collect();
        for (gain, stiffness) in fitted(&curve, &values, &rows).iter().zip(STIFFNESS) {
            for (knot, gain) in gain.iter().enumerate() {
                let wanted = 2.0 - 0.5 * knot as f64;
                assert!((gain - wanted).abs() < 0.15, "{stiffness}: {knot} {gain}");
            }
        }
    }
}
