//! From base parameters back to standard ones: a right inverse of `beta = map * standard`.

use crate::rounded::Rounded;

/// Per standard parameter its combination `(base parameter, coefficient)`, so that `map * standard(beta) = beta`.
///
/// `combinations` are the rows of `map`, `kept` says which standard parameters are preferred: where their columns are
/// independent, only they get a value. Of a chain that is `standard[kept[j]] = beta[j]` and 0 elsewhere.
#[must_use]
pub fn right_inverse(
    combinations: &[Vec<(usize, f64)>],
    kept: &[usize],
    standard: usize,
) -> Vec<Vec<(usize, f64)>> {
    let base = combinations.len();
    // Gauss-Jordan on [map | 1].
    let mut rows: Vec<Vec<Rounded>> = combinations
        .iter()
        .enumerate()
        .map(|(j, combination)| {
            let mut row = vec![Rounded::ZERO; standard + base];
            for &(k, coefficient) in combination {
                row[k] = row[k] + Rounded::constant(coefficient);
            }
            row[standard + j] = Rounded::relative(1.0, 0.0);
            row
        })
        .collect();
    let mut pivots: Vec<Option<usize>> = vec![None; base];
    let others = (0..standard).filter(|k| !kept.contains(k));
    for column in kept.iter().copied().chain(others) {
        // Rows stand in units of their own: what counts is how well an entry is known.
        let doubt = |j: &usize| rows[*j][column].error / rows[*j][column].value.abs();
        let pivot = (0..base)
            .filter(|&j| pivots[j].is_none() && rows[j][column].value != 0.0)
            .min_by(|i, j| doubt(i).total_cmp(&doubt(j)));
        let Some(pivot) = pivot else {
            continue;
        };
        pivots[pivot] = Some(column);
        let scale = rows[pivot][column];
        for entry in &mut rows[pivot] {
            *entry = entry.over(scale);
        }
        rows[pivot][column] = Rounded::relative(1.0, 0.0);
        let reduced = rows[pivot].clone();
        for (j, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if j != pivot && factor.value != 0.0 {
                for (entry, term) in row.iter_mut().zip(&reduced) {
                    if term.value != 0.0 {
                        *entry = (*entry - factor * *term).cleaned();
                    }
                }
                row[column] = Rounded::ZERO;
            }
        }
    }
    let mut inverse = vec![Vec::new(); standard];
    for (row, pivot) in rows.iter().zip(pivots) {
        let Some(column) = pivot else { continue };
        let terms = row[standard..].iter().enumerate();
        inverse[column] = terms
            .filter(|(_, coefficient)| coefficient.value != 0.0)
            .map(|(j, coefficient)| (j, coefficient.value))
            .collect();
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::right_inverse;

    #[test]
    fn of_a_chain_the_kept_parameters_have_the_values() {
        let combinations = [vec![(1, 1.0), (0, 0.5)], vec![(2, 1.0), (0, -0.25)]];
        let inverse = right_inverse(&combinations, &[1, 2], 3);
        assert_eq!(inverse, [vec![], vec![(0, 1.0)], vec![(1, 1.0)]]);
    }

    #[test]
    fn lumps_that_share_parameters_are_told_apart() {
        let combinations = [vec![(0, 1.0), (1, 2.0)], vec![(0, 1.0), (2, 1.0), (1, 4.0)]];
        let inverse = right_inverse(&combinations, &[0, 1], 3);
        for (j, combination) in combinations.iter().enumerate() {
            for i in 0..2 {
                let product: f64 = combination
                    .iter()
                    .flat_map(|&(k, c)| {
                        inverse[k]
                            .iter()
                            .filter(move |(own, _)| *own == i)
                            .map(move |(_, d)| c * d)
                    })
                    .sum();
                // Exact: halves and doubles only.
                assert_eq!(
                    product.to_bits(),
                    f64::from(u8::from(i == j)).to_bits(),
                    "{j} {i}"
                );
            }
        }
    }
}
