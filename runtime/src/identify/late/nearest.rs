//! Where the search for delays starts: a slope alone does not lead to what is far away.

use faer::Mat;

use super::{Rows, logarithm};
use crate::columns::Entry;
use crate::identify::least_squares::Factors;
use crate::identify::stack::nameless;

/// Delays that are tried first, s.
pub(super) const TRIED: [f64; 9] = [0.0, -0.04, -0.02, 0.02, 0.04, 0.07, 0.11, 0.17, 0.25];

/// How often the joints are gone through.
const SWEEPS: usize = 3;

/// Of some delays those that leave least: first one of all joints, then joint by joint with the others as they are.
///
/// What each delay adds to a joint's torque is a column behind the others. The rows are reduced once with all of them, and any choice of
/// delays is a choice of columns of what is left.
pub(super) fn nearest(rows: &Rows<'_>) -> Vec<f64> {
    let dof = rows.arm.dof();
    let unknowns = rows.stack.unknowns.len();
    let mut stack = rows.stack.clone();
    let moved = (0..dof).flat_map(|joint| {
        let tried = TRIED[1..].iter().enumerate();
        tried.map(move |(column, delay)| Entry {
            joint,
            column,
            values: rows.moved(joint, *delay),
        })
    });
    let moved: Vec<Entry> = moved.collect();
    stack.append(&vec![nameless(); TRIED.len() - 1], &moved);
    Rows::leave_out(&mut stack);
    let factors = Factors::new(&stack);
    let of_joint = |joint: usize, choice: usize| {
        let block = &factors.joints()[joint];
        let target = block.ncols() - 1;
        Mat::from_fn(block.nrows(), unknowns + 1, |row, c| {
            if c < unknowns {
                block[(row, c)]
            } else if choice == 0 {
                block[(row, target)]
            } else {
                block[(row, target)] + block[(row, unknowns + choice - 1)]
            }
        })
    };
    let left = |choices: &[usize]| -> f64 {
        let blocks = choices.iter().enumerate();
        let blocks = blocks.map(|(joint, choice)| of_joint(joint, *choice));
        let factors = Factors::from_joints(unknowns, factors.counts().to_vec(), blocks.collect());
        logarithm(factors.weighted_sigma().into_iter())
    };
    let common = (0..TRIED.len()).map(|choice| vec![choice; dof]);
    let common = common.map(|choices| (left(&choices), choices));
    let Some((mut least, mut best)) = common.min_by(|x, y| x.0.total_cmp(&y.0)) else {
        return vec![0.0; dof];
    };
    for _ in 0..SWEEPS {
        let before = best.clone();
        for joint in 0..dof {
            for choice in 0..TRIED.len() {
                let mut choices = best.clone();
                choices[joint] = choice;
                let left = left(&choices);
                if left < least {
                    (least, best) = (left, choices);
                }
            }
        }
        if best == before {
            break;
        }
    }
    best.into_iter().map(|choice| TRIED[choice]).collect()
}
