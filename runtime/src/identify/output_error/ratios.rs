//! Ratios of parameters that logs tell though they do not tell the parameters: all of them times one factor move nothing.

use nalgebra::DMatrix;

use super::{Direction, Identifiability};

/// By how much the shares of a frail direction may differ that counts as a common factor: deviations of ratios know the rest.
const ALIKE: f64 = 0.2;

/// A parameter over another, where a common factor of both is all that the logs do not tell of them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Ratio {
    /// The parameter.
    pub name: String,
    /// What it is divided by: of its group the one that moves outputs most.
    pub reference: String,
    /// Its value over that of the reference.
    pub value: f64,
    /// Standard deviation; none where the search ran out of iterations.
    pub std: Option<f64>,
}

/// Places of a parameter and of its reference.
pub(super) struct Pair {
    pub of: usize,
    pub reference: usize,
}

/// The pairs of each group that one silent direction alone moves, all of it by the same share; and of the group that the frail direction
/// moves so.
pub(super) fn pairs(
    identifiability: &Identifiability,
    frail: Option<&Direction>,
    r: &DMatrix<f64>,
    values: &[f64],
    names: &[String],
) -> Vec<Pair> {
    let directions = &identifiability.directions;
    let silent: Vec<&Direction> = directions.iter().filter(|x| x.is_silent()).collect();
    // What a frail direction moves is known by itself, so no silent one moves it.
    let groups = silent
        .iter()
        .copied()
        .enumerate()
        .filter(|(place, direction)| {
            let others = silent
                .iter()
                .enumerate()
                .filter(|(other, _)| other != place);
            let mut shared = others.flat_map(|(_, other)| &other.moves);
            !shared.any(|(name, _)| direction.moves.iter().any(|(own, _)| own == name))
        });
    let groups = groups.map(|(_, direction)| direction);
    let scales = groups.filter(|direction| direction.is_scale());
    let frail = frail.filter(|direction| direction.scales_within(ALIKE));
    let mut found = Vec::new();
    for direction in scales.chain(frail) {
        let group = direction.moves.iter();
        let group = group.filter_map(|(name, _)| names.iter().position(|known| known == name));
        let group: Vec<usize> = group.filter(|&k| values[k] != 0.0).collect();
        let effect = |k: usize| r.column(k).norm() * values[k].abs();
        let most = group
            .iter()
            .copied()
            .max_by(|&x, &y| effect(x).total_cmp(&effect(y)));
        let Some(reference) = most else {
            continue;
        };
        let others = group.into_iter().filter(|&k| k != reference);
        found.extend(others.map(|of| Pair { of, reference }));
    }
    found
}

/// Slopes of ratios by the parameters, one a column.
pub(super) fn slopes(pairs: &[Pair], values: &[f64]) -> DMatrix<f64> {
    let mut slopes = DMatrix::zeros(values.len(), pairs.len());
    for (column, pair) in pairs.iter().enumerate() {
        let over = values[pair.reference];
        slopes[(pair.of, column)] = 1.0 / over;
        slopes[(pair.reference, column)] = -values[pair.of] / (over * over);
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(
        columns: &[[f64; 3]],
        values: &[f64],
        frail: Option<&Direction>,
    ) -> Vec<(usize, usize)> {
        let r = DMatrix::from_fn(3, columns.len(), |row, column| columns[column][row]);
        let names: Vec<String> = (0..values.len()).map(|k| format!("p{k}")).collect();
        let identifiability = Identifiability::new(&r, values, &names);
        let pairs = pairs(&identifiability, frail, &r, values, &names);
        pairs.iter().map(|pair| (pair.of, pair.reference)).collect()
    }

    #[test]
    fn a_common_factor_leaves_ratios_to_what_moves_most() {
        // `2 c0 + 4 c1 = 0`: both times a factor move nothing.
        let common = [[2.0, 1.0, 0.0], [-1.0, -0.5, 0.0], [0.0, 0.0, 3.0]];
        assert_eq!(found(&common, &[2.0, 4.0, 1.0], None).len(), 1);
        // Of other values it is a difference that moves nothing, and no ratio.
        assert!(found(&common, &[2.0, -4.0, 1.0], None).is_empty());
        // All are told.
        let apart = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        assert!(found(&apart, &[2.0, 4.0, 1.0], None).is_empty());
    }

    #[test]
    fn a_common_factor_that_is_hardly_known_leaves_ratios_too() {
        let apart = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        let moved = |share: f64| Direction {
            singular: 0.02,
            moves: vec![("p0".to_owned(), 1.0), ("p1".to_owned(), share)],
        };
        let values = [2.0, 4.0, 1.0];
        // `p1` moves outputs most: 2 * 4 beside 1 * 2.
        assert_eq!(found(&apart, &values, Some(&moved(0.9))), [(0, 1)]);
        assert!(found(&apart, &values, Some(&moved(0.5))).is_empty());
    }

    #[test]
    fn a_common_factor_changes_no_ratio() {
        let values = [2.0, 4.0, 5.0];
        let pairs = [Pair {
            of: 0,
            reference: 1,
        }];
        let slopes = slopes(&pairs, &values);
        let along: f64 = (0..3).map(|k| slopes[(k, 0)] * values[k]).sum();
        assert!(along.abs() < 1e-15);
        assert!((slopes[(0, 0)] - 0.25).abs() < 1e-15);
    }
}
