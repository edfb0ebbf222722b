//! The rows as a table for people.

use std::fmt::Write as _;

use crate::report::{Report, Row};

/// Columns of the table.
pub(crate) const COLUMNS: usize = 14;

const HEAD: [&str; COLUMNS] = [
    "robot",
    "function",
    "form",
    "ops",
    "trig",
    "ns",
    "plain",
    "C",
    "arith.",
    "best peer",
    "peer ns",
    "ratio",
    "plain",
    "arith.",
];

/// One line a row; ratios are ours over the fastest peer's.
#[must_use]
pub fn table(report: &Report) -> String {
    let mut lines: Vec<[String; COLUMNS]> = vec![HEAD.map(str::to_owned)];
    lines.extend(report.rows.iter().map(cells));
    let width = |column: usize| {
        lines
            .iter()
            .map(|line| line[column].len())
            .max()
            .unwrap_or(0)
    };
    let widths: [usize; COLUMNS] = std::array::from_fn(width);
    let mut text = String::new();
    for line in &lines {
        let mut whole = String::new();
        for (column, (cell, width)) in line.iter().zip(widths).enumerate() {
            // Words to the left, numbers to the right.
            let written = if matches!(column, 0..=2 | 9) {
                write!(whole, "{cell:width$}  ")
            } else {
                write!(whole, "{cell:>width$}  ")
            };
            written.expect("a string takes text");
        }
        text.push_str(whole.trim_end());
        text.push('\n');
    }
    text
}

/// What the table says of a row.
pub(crate) fn cells(row: &Row) -> [String; COLUMNS] {
    let ns = |ns: f64| format!("{ns:.1}");
    let ratio = |ratio: Option<f64>| ratio.map_or_else(|| "-".to_owned(), |x| format!("{x:.2}"));
    let [whole, plain, arithmetic] = row.ratios().map(ratio);
    let (name, peer) = match row.best_peer() {
        Some((name, time)) => (name.to_owned(), ns(time)),
        None => ("-".to_owned(), "-".to_owned()),
    };
    [
        row.robot.clone(),
        row.function.clone(),
        row.form.name().to_owned(),
        (row.mul + row.add).to_string(),
        row.trig.to_string(),
        ns(row.ns),
        ns(row.ns_plain),
        row.ns_c.map_or_else(|| "-".to_owned(), ns),
        ns(row.ns_arithmetic),
        name,
        peer,
        whole,
        plain,
        arithmetic,
    ]
}

#[cfg(test)]
mod tests {
    use super::table;
    use crate::report::{Report, example, example_report};

    #[test]
    fn a_row_a_line() {
        let mut alone = example();
        alone.peers.clear();
        alone.peers_arithmetic.clear();
        alone.ns_c = None;
        let text = table(&Report {
            rows: vec![example(), alone],
            ..example_report()
        });
        let wanted = "\
robot    function  form   ops  trig    ns  plain     C  arith.  best peer  peer ns  ratio  plain  arith.
puma560  gravity   baked   56    10  15.0   25.0  18.0     6.0  symforce      60.0   0.25   0.42    0.50
puma560  gravity   baked   56    10  15.0   25.0     -     6.0  -                -      -      -       -
";
        assert_eq!(text, wanted);
    }
}
