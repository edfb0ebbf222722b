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

/// Mean over blocks of the least time of each, ns.
///
/// # Errors
/// A program that ends.
pub fn measure(
    programs: &mut [Program],
    cases: &[Case],
    passes: u32,
) -> Result<BTreeMap<Case, f64>, Error> {
    let mut least: BTreeMap<&Case, Vec<f64>> = BTreeMap::new();
    for _ in 0..passes {
        for case in cases {
            let times = programs[case.program].pass(&case.name)?;
            let least = least
                .entry(case)
                .or_insert_with(|| vec![f64::INFINITY; times.len()]);
            for (least, time) in least.iter_mut().zip(times) {
                *least = least.min(time);
            }
        }
    }
    let mean = |times: Vec<f64>| times.iter().sum::<f64>() / times.len() as f64;
    Ok(least
        .into_iter()
        .map(|(case, times)| (case.clone(), mean(times)))
        .collect())
}

/// The largest difference of two results, relative to the largest entry of the state's.
#[must_use]
pub fn difference(found: &[Vec<f64>], wanted: &[Vec<f64>]) -> f64 {
    let mut worst: f64 = 0.0;
    for (found, wanted) in found.iter().zip(wanted) {
        if found.len() != wanted.len() {
            return f64::INFINITY;
        }
        let size = wanted.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        for (x, y) in found.iter().zip(wanted) {
            let difference = (x - y).abs() / size;
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
    use super::{difference, write_states};

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
    }
}
