//! Who is timed, and in which order: in rounds, everybody once a round, so that what else the machine does hits all alike.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::program::Program;
use crate::{Error, failed};

/// States of a file: blocks of five hundred, as the programs cut them.
const STATES: usize = 10_000;

/// A case of a program: its index and the name that the program knows.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Case {
    /// Index of the program.
    pub program: usize,
    /// Name of the case.
    pub name: String,
}

/// Positions within a turn, velocities within 2 rad/s, accelerations within 5 rad/s^2, evenly spread; the same every time.
///
/// # Errors
/// The file cannot be written.
pub fn write_states(folder: &Path, dof: usize) -> Result<PathBuf, Error> {
    let path = folder.join(format!("states{dof}"));
    // Marsaglia's xorshift: no more is asked of these numbers than that a branch predictor does not learn them.
    let mut seed = 88_172_645_463_325_252_u64;
    let mut random = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut bytes = Vec::new();
    for _ in 0..STATES {
        for size in [std::f64::consts::PI, 2.0, 5.0] {
            for _ in 0..dof {
                bytes.extend((size * random()).to_le_bytes());
            }
        }
    }
    fs::write(&path, bytes).map_err(|error| failed("write", &path, error))?;
    Ok(path)
}

/// What was measured of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Mean over blocks of the least time of each, ns.
    pub ns: f64,
    /// How far passes differ: the range that the middle half of their means spans, relative to the median.
    pub spread: f64,
}

/// Every case once a pass.
///
/// # Errors
/// A program that ends, or that times no block.
pub fn measure(
    programs: &mut [Program],
    cases: &[Case],
    passes: u32,
) -> Result<BTreeMap<Case, Timing>, Error> {
    let mut measured: BTreeMap<&Case, Vec<Vec<f64>>> = BTreeMap::new();
    for _ in 0..passes {
        for case in cases {
            let times = programs[case.program].pass(&case.name)?;
            measured.entry(case).or_default().push(times);
        }
    }
    let timings = measured.into_iter().map(|(case, passes)| {
        let timing = timing(&passes).ok_or_else(|| {
            Error::new(format!(
                "`{}` has timed no block of states in a pass",
                case.name
            ))
        })?;
        Ok((case.clone(), timing))
    });
    timings.collect()
}

/// Of the times of blocks in several passes; `None` without a block, or where passes have other numbers of them.
fn timing(passes: &[Vec<f64>]) -> Option<Timing> {
    let blocks = passes.first()?.len();
    if blocks == 0 || passes.iter().any(|pass| pass.len() != blocks) {
        return None;
    }
    let mean = |times: &[f64]| times.iter().sum::<f64>() / times.len() as f64;
    let least = |block: usize| {
        passes
            .iter()
            .map(|pass| pass[block])
            .fold(f64::INFINITY, f64::min)
    };
    let least: Vec<f64> = (0..blocks).map(least).collect();
    let mut means: Vec<f64> = passes.iter().map(|pass| mean(pass)).collect();
    means.sort_by(f64::total_cmp);
    let quarter = |k: usize| means[k * (means.len() - 1) / 4];
    Some(Timing {
        ns: mean(&least),
        spread: (quarter(3) - quarter(1)) / quarter(2),
    })
}

/// The largest difference of two results, relative to the largest entry of the state's.
#[must_use]
pub fn difference(found: &[Vec<f64>], wanted: &[Vec<f64>]) -> f64 {
    if found.len() != wanted.len() {
        return f64::INFINITY;
    }
    let mut worst: f64 = 0.0;
    for (found, wanted) in found.iter().zip(wanted) {
        if found.len() != wanted.len() {
            return f64::INFINITY;
        }
        let size = wanted.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        for (x, y) in found.iter().zip(wanted) {
            // A state may be without any torque: there is nothing then to be relative to, and nothing to divide.
            let absolute = (x - y).abs();
            let difference = if absolute <= 0.0 {
                0.0
            } else {
                absolute / size
            };
            // No number is no agreement, and stays.
            if difference > worst || difference.is_nan() {
                worst = difference;
            }
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::{Timing, difference, timing, write_states};

    #[test]
    fn the_least_of_a_block_counts_and_the_middle_half_of_the_passes_is_the_spread() {
        let passes = [[2.0, 4.0], [1.0, 5.0], [3.0, 9.0], [2.0, 6.0], [8.0, 8.0]].map(Vec::from);
        // Means of passes: 3, 3, 4, 6, 8.
        let wanted = Timing {
            ns: 2.5,
            spread: 0.75,
        };
        assert_eq!(timing(&passes), Some(wanted));
        assert_eq!(timing(&[vec![], vec![]]), None);
        assert_eq!(timing(&[vec![1.0], vec![]]), None);
    }

    #[test]
    fn states_are_as_many_as_told_and_within_bounds() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = write_states(folder.path(), 2).expect("a writable folder");
        let bytes = std::fs::read(path).expect("it was written");
        let numbers = bytes
            .chunks_exact(8)
            .map(|x| f64::from_le_bytes(x.try_into().expect("eight")));
        let numbers: Vec<f64> = numbers.collect();
        assert_eq!(numbers.len(), 60_000);
        for state in numbers.chunks(6) {
            assert!(state[..2].iter().all(|q| q.abs() < 3.15), "{state:?}");
            assert!(state[4..].iter().all(|ddq| ddq.abs() <= 5.0), "{state:?}");
        }
    }

    #[test]
    fn differences_are_relative_and_no_number_is_one() {
        assert!((difference(&[vec![1.0, 8.0]], &[vec![2.0, 8.0]]) - 0.125).abs() < 1e-15);
        assert!(difference(&[vec![f64::NAN, 1.0]], &[vec![1.0, 1.0]]).is_nan());
        assert!(difference(&[vec![1.0]], &[vec![1.0, 0.0]]).is_infinite());
        assert!(difference(&[vec![1.0]], &[]).is_infinite());
        // Nothing agrees with nothing, and something does not.
        assert!(difference(&[vec![0.0, 0.0]], &[vec![0.0, 0.0]]) <= 0.0);
        assert!(difference(&[vec![1e-9]], &[vec![0.0]]).is_infinite());
    }
}
