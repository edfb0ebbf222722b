//! Scales of rows and columns in which nothing is small for its units.

use crate::rounded::Rounded;

/// A row is left out where rounding is more than this of its largest entry, unless most rows of its joint are so.
const LARGEST_ERROR: f64 = 1e-11;
/// Rounds over rows and columns. Each brings the spread of magnitudes nearer to what no scales take away.
const ROUNDS: usize = 4;

/// Columns whose rows are scaled to their largest entry, then the columns to length one.
pub(super) struct Scaled {
    /// Empty where no entry is more than rounding.
    pub(super) columns: Vec<Vec<f64>>,
    /// A unit of the scaled column is so many of the original, up to one factor for all columns.
    pub(super) scale: Vec<f64>,
}

impl Scaled {
    /// Of rows with the joints whose they are.
    pub(super) fn new(rows: Vec<(usize, Vec<Rounded>)>, count: usize) -> Self {
        let (joints, rows): (Vec<usize>, Vec<Vec<Rounded>>) = rows
            .into_iter()
            .map(|(joint, row)| {
                let row: Vec<Rounded> = row.into_iter().map(Rounded::cleaned).collect();
                (joint, row)
            })
            .filter(|(_, row)| row.iter().any(|x| x.value != 0.0))
            .unzip();
        // Logarithms: products of scales neither overflow nor underflow.
        let mut of_column = vec![0.0; count];
        let mut of_row = vec![0.0; rows.len()];
        for _ in 0..ROUNDS {
            for (scale, row) in of_row.iter_mut().zip(&rows) {
                *scale = median(row.iter().zip(&of_column));
            }
            for (k, scale) in of_column.iter_mut().enumerate() {
                *scale = median(rows.iter().map(|row| &row[k]).zip(&of_row));
            }
        }
        let scaled = |x: f64, scale: f64| {
            if x == 0.0 {
                0.0
            } else {
                (x.abs().ln() - scale).exp().copysign(x)
            }
        };
        let largest = |row: &[Rounded], part: fn(&Rounded) -> f64| {
            let parts = row.iter().zip(&of_column).filter(|(x, _)| part(x) > 0.0);
            parts
                .map(|(x, scale)| part(x).ln() - scale)
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let sizes: Vec<(f64, f64)> = rows
            .iter()
            .map(|row| {
                let size = largest(row, |x| x.value.abs());
                (size, largest(row, |x| x.error) - size)
            })
            .collect();
        let mut columns = vec![Vec::with_capacity(rows.len()); count];
        let usual: Vec<f64> = (0..=joints.iter().copied().max().unwrap_or(0))
            .map(|joint| {
                let own = joints.iter().zip(&sizes).filter(|(k, _)| **k == joint);
                middle(own.map(|(_, (_, error))| *error).collect())
            })
            .collect();
        for ((row, joint), (size, error)) in rows.iter().zip(&joints).zip(&sizes) {
            if *error > LARGEST_ERROR.ln().max(usual[*joint]) {
                continue;
            }
            for (column, (x, scale)) in columns.iter_mut().zip(row.iter().zip(&of_column)) {
                column.push(scaled(x.value, size + scale));
            }
        }
        let mut scale = Vec::with_capacity(count);
        for (column, of_column) in columns.iter_mut().zip(of_column) {
            let length = column.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length == 0.0 {
                column.clear();
            }
            for x in column.iter_mut() {
                *x /= length;
            }
            scale.push((of_column + length.max(f64::MIN_POSITIVE).ln()).exp());
        }
        Self { columns, scale }
    }
}

/// Median logarithm of the entries, in units of the other direction's scales. Entries far below the largest do not count: the
/// tail of an exponential would set the scale where it is nothing.
fn median<'a>(entries: impl Iterator<Item = (&'a Rounded, &'a f64)>) -> f64 {
    /// Of the largest.
    const COUNTS: f64 = 1e-8;
    let mut logarithms: Vec<f64> = entries
        .filter(|(x, _)| x.value != 0.0)
        .map(|(x, scale)| x.value.abs().ln() - scale)
        .collect();
    let largest = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    logarithms.retain(|x| *x >= largest + COUNTS.ln());
    middle(logarithms)
}

/// The median; 0 of nothing.
fn middle(mut numbers: Vec<f64>) -> f64 {
    if numbers.is_empty() {
        return 0.0;
    }
    let half = numbers.len() / 2;
    *numbers.select_nth_unstable_by(half, f64::total_cmp).1
}
