//! Sums of parameters that logs tell where they do not tell their parts: links behind springs, say, whose mass shows in a first moment alone.

use faer::Mat;
use nalgebra::DMatrix;

use super::{Direction, Identifiability};
use crate::identify::combination::{Shared, shared};
use crate::identify::least_squares::Excited;

/// The sums that the sensitivities `r` tell, of parameters that a silent direction moves otherwise than by a common factor, whose ratios are
/// what is known.
pub(super) fn sums(
    identifiability: &Identifiability,
    r: &DMatrix<f64>,
    names: &[String],
) -> Vec<Shared> {
    let silent = identifiability.directions.iter();
    let silent = silent.filter(|direction| direction.is_silent());
    let (scales, others): (Vec<_>, Vec<_>) = silent.partition(|direction| direction.is_scale());
    if others.is_empty() {
        return Vec::new();
    }
    let moves = |directions: &[&Direction], name: &String| {
        let mut moves = directions.iter().flat_map(|direction| &direction.moves);
        moves.any(|(moved, _)| moved == name)
    };
    // What another direction moves, too, is in sums of that one.
    let is_scaled = |name: &String| moves(&scales, name) && !moves(&others, name);
    let asked: Vec<usize> = (0..names.len())
        .filter(|&k| !is_scaled(&names[k]))
        .collect();
    let factor = Mat::from_fn(r.nrows(), asked.len(), |row, k| {
        if identifiability.is_audible(asked[k]) {
            r[(row, asked[k])]
        } else {
            0.0
        }
    });
    let excited = Excited::of_rank(
        &factor,
        asked.len(),
        asked.len().saturating_sub(others.len()),
    );
    let unexcited = (0..asked.len()).filter(|k| excited.columns.binary_search(k).is_err());
    let unexcited: Vec<usize> = unexcited.collect();
    let found = shared(&factor, &excited, &unexcited).into_iter();
    found
        .map(|shared| Shared {
            lead: asked[shared.lead],
            others: shared
                .others
                .into_iter()
                .map(|(other, factor)| (asked[other], factor))
                .collect(),
        })
        .collect()
}

/// How sums change with the parameters, one a column.
pub(super) fn slopes(sums: &[Shared], parameters: usize) -> DMatrix<f64> {
    let mut slopes = DMatrix::zeros(parameters, sums.len());
    for (column, sum) in sums.iter().enumerate() {
        slopes[(sum.lead, column)] = 1.0;
        for &(other, factor) in &sum.others {
            slopes[(other, column)] = factor;
        }
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `c1 = c0 / 2`: `p0 + p1 / 2`, or `p1 + 2 p0`, is all that shows of both.
    #[test]
    fn what_shows_in_a_sum_is_told_as_one() {
        let columns = [[2.0, 1.0, 0.0], [1.0, 0.5, 0.0], [0.0, 0.0, 3.0]];
        let r = DMatrix::from_fn(3, 3, |row, column| columns[column][row]);
        let names: Vec<String> = (0..3).map(|k| format!("p{k}")).collect();
        let values = [1.0, 3.0, 1.0];
        let identifiability = Identifiability::new(&r, &values, &names);
        let [sum] = &sums(&identifiability, &r, &names)[..] else {
            panic!("one sum");
        };
        let [(other, factor)] = sum.others[..] else {
            panic!("of two");
        };
        assert_eq!(sum.lead + other, 1);
        let expected = if sum.lead == 0 { 0.5 } else { 2.0 };
        assert!((factor - expected).abs() < 1e-12, "{factor}");
        let slopes = slopes(std::slice::from_ref(sum), 3);
        // It is the same all along the direction that nothing shows of.
        assert!((slopes[(0, 0)] - 2.0 * slopes[(1, 0)]).abs() < 1e-12);
        // Ratios are told of a common factor, and no sums.
        let values = [1.0, -2.0, 1.0];
        let identifiability = Identifiability::new(&r, &values, &names);
        assert!(sums(&identifiability, &r, &names).is_empty());
    }

    /// Outputs know `a + b - 2 c` alone: a common factor is silent, and so is what `a` takes from `b`.
    #[test]
    fn what_another_direction_moves_besides_a_common_factor_is_in_its_sum() {
        let names = ["a", "b", "c"].map(str::to_owned);
        let rows = [[1.0, 1.0, -2.0], [0.0; 3], [0.0; 3]];
        let r = DMatrix::from_fn(3, 3, |row, column| rows[row][column]);
        let mut identifiability = Identifiability::new(&r, &[1.0; 3], &names);
        let silent = |moves: &[f64]| Direction {
            singular: 0.0,
            moves: names.iter().cloned().zip(moves.iter().copied()).collect(),
        };
        identifiability.directions = vec![silent(&[1.0, 1.0, 1.0]), silent(&[1.0, -1.0])];
        let [sum] = &sums(&identifiability, &r, &names)[..] else {
            panic!("one sum");
        };
        let mut terms = vec![sum.lead];
        terms.extend(sum.others.iter().map(|(other, _)| other));
        terms.sort_unstable();
        assert_eq!(terms, [0, 1]);
        assert!((sum.others[0].1 - 1.0).abs() < 1e-9);
    }
}
