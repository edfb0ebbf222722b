//! Fewer columns where there are too many.

use std::collections::BTreeSet;

use super::rows::{Label, mean_product};

/// Of more columns than this the trials that explain most alone are kept: sure independence screening (Fan & Lv 2008).
const MOST_COLUMNS: usize = 600;

/// Keeps the trials one of whose columns explains most of the target, as far as there is room.
pub(super) fn screen(columns: &mut Vec<(Label, Vec<f64>)>, target: &[f64]) {
    if columns.len() <= MOST_COLUMNS {
        return;
    }
    let mut trials: Vec<(f64, usize, usize, usize)> = Vec::new();
    for (label, values) in columns.iter() {
        let says = mean_product(values, target).abs();
        match trials.last_mut() {
            Some((most, effect, trial, count))
                if (*effect, *trial) == (label.effect, label.trial) =>
            {
                *most = most.max(says);
                *count += 1;
            }
            _ => trials.push((says, label.effect, label.trial, 1)),
        }
    }
    trials.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut room = MOST_COLUMNS;
    trials.retain(|(_, _, _, count)| {
        let fits = *count <= room;
        room -= if fits { *count } else { 0 };
        fits
    });
    let kept: BTreeSet<(usize, usize)> = trials
        .into_iter()
        .map(|(_, effect, trial, _)| (effect, trial))
        .collect();
    columns.retain(|(label, _)| kept.contains(&(label.effect, label.trial)));
}

#[cfg(test)]
mod tests {
    use super::super::tests::noise;
    use super::*;

    #[test]
    fn of_too_many_columns_those_stay_that_say_most() {
        let target = noise(1, 40);
        let label = |number: usize| Label {
            effect: number,
            trial: 0,
            number,
        };
        let mut columns: Vec<(Label, Vec<f64>)> = (0..MOST_COLUMNS + 5)
            .map(|number| (label(number), vec![0.0; 40]))
            .collect();
        columns[MOST_COLUMNS + 2].1.clone_from(&target);
        screen(&mut columns, &target);
        assert_eq!(columns.len(), MOST_COLUMNS);
        assert!(
            columns
                .iter()
                .any(|(one, _)| one.number == MOST_COLUMNS + 2)
        );
    }
}
