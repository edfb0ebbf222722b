//! What turns of joints with dry friction may move an estimate by.
//!
//! Where a joint turns, friction takes a jump, and the torque that moves the joint takes it, too, at an instant between two samples. Of the
//! log only the samples are known: with their mean the simulated joint stands there for a while, with that of the latter one it turns too
//! soon. The true one is in between, so positions behind each turn are off by a little that no noise makes, and dry and viscous friction
//! make up for it. An estimate is told by both extremes: by `theta` of the way from one to the other, with `theta` of each window anywhere
//! between 0 and 1, it would move by `sum theta_w d_w`, whose mean square `(sum d_w)^2 / 4 + sum d_w^2 / 12` is a part of its variance.

use nalgebra::{DMatrix, DVector};

use super::Hold;
use super::equations::Reduced;
use super::problem::{Place, Problem};
use super::run::{Asked, Run};
use super::window::Rows;
use crate::simulate::Adjustable;

/// By how much parameters move from one extreme to the other: of each joint one column a window.
pub(super) struct Moves(Vec<DMatrix<f64>>);

impl Moves {
    /// Of a place with its runs and equations, for the `free` parameters with their `(R'R)^-1`. Nothing moves where no friction takes a
    /// jump, where a controller makes the torque, or where torque is held from each sample on and is known throughout.
    pub fn new<P: Adjustable + Clone + Sync>(
        problem: &Problem<'_, P>,
        (place, runs): (&Place, &[Run]),
        (rows, reduced): (&[Rows], &Reduced),
        (free, inverse): (&[usize], &DMatrix<f64>),
    ) -> Self {
        let is_known = problem.law.is_some() || problem.hold == Hold::Sample;
        if is_known || problem.plant.switches() == 0 {
            return Self(Vec::new());
        }
        let joints = 0..problem.scale.len();
        let of_joint = |joint: usize| {
            let mut moves = DMatrix::zeros(free.len(), runs.len());
            for (k, window) in problem.windows.iter().enumerate() {
                let turns = turns(&runs[k].q[joint]);
                if turns.is_empty() {
                    continue;
                }
                let ends = [0, 1].map(|later| {
                    let driven = window.driven_at(joint, &turns, later);
                    let run = driven.run(
                        &problem.plant,
                        &place.starts[k],
                        None,
                        problem.hold,
                        Asked::Motion,
                    );
                    run.ok().map(|run| driven.errors(&run, &problem.scale))
                });
                // Where one runs away nothing is told by it.
                if let [Some(before), Some(after)] = ends {
                    let own = rows[k].own(&reduced.starts[k]).select_columns(free);
                    let step: DVector<f64> = -(inverse * own.tr_mul(&(after - before)));
                    moves.set_column(k, &step);
                }
            }
            moves
        };
        Self(joints.map(of_joint).collect())
    }

    /// Mean squares of what functions of the parameters move by, which have these slopes.
    pub fn squares(&self, slopes: &DMatrix<f64>) -> Vec<f64> {
        let mut squares = vec![0.0; slopes.ncols()];
        for moves in &self.0 {
            let moves = slopes.tr_mul(moves);
            for (square, moves) in squares.iter_mut().zip(moves.row_iter()) {
                *square += moves.sum().powi(2) / 4.0 + moves.norm_squared() / 12.0;
            }
        }
        squares
    }
}

/// Samples of a simulated motion between which and the next one a joint turns.
fn turns(q: &[f64]) -> Vec<usize> {
    let count = q.len();
    let speed = |k: usize| q[(k + 1).min(count - 1)] - q[k.saturating_sub(1)];
    let intervals = 0..count.saturating_sub(1);
    intervals
        .filter(|&k| speed(k) * speed(k + 1) <= 0.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_turns_between_two_samples_or_for_as_long_as_it_stands() {
        assert_eq!(turns(&[0.0, 1.0, 2.0, 2.5, 2.0, 1.0]), [2, 3]);
        assert_eq!(turns(&[0.0, 1.0, 2.0, 2.0, 2.0, 3.0]), [2, 3]);
        assert!(turns(&[0.0, 1.0, 3.0, 4.0]).is_empty());
    }

    #[test]
    fn what_turns_all_do_alike_adds_up() {
        let moves = Moves(vec![DMatrix::from_row_slice(1, 2, &[1.0, 1.0])]);
        let one = DMatrix::from_element(1, 1, 1.0);
        assert!((moves.squares(&one)[0] - (1.0 + 1.0 / 6.0)).abs() < 1e-12);
        let moves = Moves(vec![DMatrix::from_row_slice(1, 2, &[1.0, -1.0])]);
        assert!((moves.squares(&one)[0] - 1.0 / 6.0).abs() < 1e-12);
    }
}
