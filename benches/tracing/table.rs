//! Rows as a table, and what they come to.

use std::fmt::Write;

use crate::judge::{Mark, Row};

/// Counts of a set of rows.
struct Counts {
    all: usize,
    of: Vec<(Mark, usize)>,
}

impl Counts {
    fn new<'a>(rows: impl Iterator<Item = &'a Row>) -> Self {
        let marks = [
            Mark::Exact,
            Mark::Near,
            Mark::Small,
            Mark::Abstained,
            Mark::Missed,
            Mark::Wrong,
        ];
        let mut of: Vec<(Mark, usize)> = marks.map(|mark| (mark, 0)).to_vec();
        let mut all = 0;
        for row in rows {
            all += 1;
            for (mark, count) in &mut of {
                *count += usize::from(*mark == row.mark);
            }
        }
        Self { all, of }
    }

    fn percent(&self, marks: &[Mark]) -> f64 {
        let hits: usize = self
            .of
            .iter()
            .filter(|(mark, _)| marks.contains(mark))
            .map(|(_, count)| count)
            .sum();
        100.0 * hits as f64 / self.all.max(1) as f64
    }
}

/// What was put in, in the order of the rows.
pub fn kinds(rows: &[Row]) -> Vec<&str> {
    let mut kinds: Vec<&str> = Vec::new();
    for row in rows {
        if !kinds.contains(&row.kind.as_str()) {
            kinds.push(&row.kind);
        }
    }
    kinds
}

/// Sizes, from the least.
pub fn sizes(rows: &[Row]) -> Vec<f64> {
    let mut sizes: Vec<f64> = Vec::new();
    for row in rows {
        if !sizes.iter().any(|size| row.is_of(*size)) {
            sizes.push(row.share);
        }
    }
    sizes.sort_by(f64::total_cmp);
    sizes
}

/// The table of kinds and sizes, and what it comes to.
pub fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "| in the arm | size | tried | matters | exact | near | small | abstained | missed | wrong |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let (kinds, sizes) = (kinds(rows), sizes(rows));
    for kind in &kinds {
        for size in &sizes {
            let here = || {
                rows.iter()
                    .filter(|row| row.kind == *kind && row.is_of(*size))
            };
            let counts = Counts::new(here());
            if counts.all == 0 {
                continue;
            }
            let matters = here().filter(|row| row.is_material).count();
            let _ = write!(
                text,
                "| {kind} | {} % | {} | {matters} |",
                100.0 * size,
                counts.all
            );
            for (_, count) in &counts.of {
                let _ = write!(text, " {count} |");
            }
            text.push('\n');
        }
    }
    let of = |wanted: &dyn Fn(&&Row) -> bool| Counts::new(rows.iter().filter(wanted));
    for size in &sizes {
        let counts = of(&|row| row.is_material && row.is_of(*size));
        if counts.all == 0 {
            continue;
        }
        let _ = writeln!(
            text,
            "{} % of torque, where it matters ({}): exact {:.0} %, exact or near {:.0} %, wrong {:.0} %",
            100.0 * size,
            counts.all,
            counts.percent(&[Mark::Exact]),
            counts.percent(&[Mark::Exact, Mark::Near]),
            counts.percent(&[Mark::Wrong])
        );
    }
    let clean = of(&|row| row.kind == "nothing");
    if clean.all > 0 {
        let alarms = 100.0 - clean.percent(&[Mark::Exact]);
        let _ = writeln!(
            text,
            "clean arms ({}): false alarms {alarms:.0} %",
            clean.all
        );
    }
    let small = of(&|row| !row.is_material && row.kind != "nothing" && row.kind != "unknown");
    if small.all > 0 {
        let wrong = small.percent(&[Mark::Wrong]);
        let _ = writeln!(
            text,
            "too little to matter ({}): wrong names {wrong:.0} %",
            small.all
        );
    }
    let strange = of(&|row| row.kind == "unknown");
    if strange.all > 0 {
        let (wrong, missed) = (
            strange.percent(&[Mark::Wrong]),
            strange.percent(&[Mark::Missed]),
        );
        let _ = writeln!(
            text,
            "laws that no library has ({}): wrong names {wrong:.0} %, not seen {missed:.0} %",
            strange.all
        );
    }
    let mut ratios: Vec<f64> = rows
        .iter()
        .filter(|row| row.is_material && row.mark == Mark::Exact)
        .filter_map(|row| row.after_over_truth)
        .collect();
    ratios.sort_by(f64::total_cmp);
    if let Some(median) = ratios.get(ratios.len() / 2) {
        let _ = writeln!(
            text,
            "error after over that of the true model, median: {median:.3}"
        );
    }
    let slowest = rows.iter().map(|row| row.seconds).fold(0.0, f64::max);
    let _ = writeln!(text, "slowest: {slowest:.1} s");
    text
}
