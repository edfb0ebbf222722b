//! Which way a sequence was going when a sample was reached.

use super::statistics::range;

/// A sequence turns where it goes back by more than this share of its range: less is noise of its levels.
const TURN: f64 = 0.05;

/// Samples behind a turn that are within this share of the range belong to its level still.
const NEAR: f64 = 0.01;

/// 1 for each sample that was reached by rising, -1 by falling; `None` where the sequence goes one way only.
pub(super) fn branches(values: &[f64]) -> Option<Vec<f64>> {
    let (low, high) = range(values);
    let reach = TURN * (high - low);
    let start = values.iter().find(|x| (*x - values[0]).abs() > reach)?;
    let mut way = (start - values[0]).signum();
    let mut signs = vec![way; values.len()];
    let mut extreme = 0;
    let mut turns = 0;
    for k in 1..values.len() {
        let ahead = way * (values[k] - values[extreme]);
        if ahead >= 0.0 {
            extreme = k;
        } else if -ahead > reach {
            let left = |j: &usize| way * (values[extreme] - values[*j]) > NEAR * (high - low);
            let first = (extreme + 1..=k).find(left).unwrap_or(k);
            way = -way;
            turns += 1;
            signs[first..].fill(way);
            extreme = k;
        }
    }
    (turns > 0).then_some(signs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_belong_to_where_they_come_from() {
        let signs = branches(&[0.0, 1.0, 2.0, 2.0, 1.0, 0.0, 1.0]);
        assert_eq!(signs, Some(vec![1.0, 1.0, 1.0, 1.0, -1.0, -1.0, 1.0]));
    }

    #[test]
    fn noise_of_levels_is_no_turn() {
        assert_eq!(branches(&[0.0, 0.01, 1.0, 0.99, 2.0, 1.99]), None);
        let signs = branches(&[2.0, 2.02, 1.0, 1.01, 0.0, 0.01, 1.0]).expect("a turn");
        assert_eq!(signs, [-1.0, -1.0, -1.0, -1.0, -1.0, -1.0, 1.0]);
    }
}
