//! Rows as a table, and what they come to.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use crate::arms::ARMS;
use robot_model_benches::interval::{Z, wilson, worth};

use crate::judge::{Mark, Row};

/// What an interval should next to never miss by.
const FAR: f64 = 3.0;

/// Counts of a set of rows.
struct Counts {
    all: usize,
    of: Vec<(Mark, usize)>,
    /// As many experiments that share nothing are worth as much.
    draws: f64,
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
        let mut draws = BTreeMap::<_, usize>::new();
        for row in rows {
            all += 1;
            *draws.entry(row.draw()).or_default() += 1;
            for (mark, count) in &mut of {
                *count += usize::from(*mark == row.mark);
            }
        }
        Self {
            all,
            of,
            draws: worth(draws.into_values()),
        }
    }

    /// A share with its 95 % interval.
    fn share(&self, marks: &[Mark]) -> String {
        let percent = self.percent(marks);
        let (low, high) = wilson(percent / 100.0, self.draws);
        format!("{percent:.0} % ({:.0} to {:.0})", 100.0 * low, 100.0 * high)
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
    each(rows) + &summary(rows)
}

/// A line for every kind and size.
fn each(rows: &[Row]) -> String {
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
    text
}

/// Shares with their intervals.
fn summary(rows: &[Row]) -> String {
    let (mut text, sizes) = (String::new(), sizes(rows));
    let of = |wanted: &dyn Fn(&&Row) -> bool| Counts::new(rows.iter().filter(wanted));
    let mut tell = |what: &str, wanted: &dyn Fn(&&Row) -> bool, shares: &[(&str, &[Mark])]| {
        let counts = of(wanted);
        if counts.all > 0 {
            let shares = shares
                .iter()
                .map(|(name, marks)| format!("{name} {}", counts.share(marks)));
            let shares: Vec<String> = shares.collect();
            let _ = writeln!(text, "{what} ({}): {}", counts.all, shares.join(", "));
        }
    };
    let named: [(&str, &[Mark]); 3] = [
        ("exact", &[Mark::Exact]),
        ("exact or near", &[Mark::Exact, Mark::Near]),
        ("wrong", &[Mark::Wrong]),
    ];
    for size in &sizes {
        let head = format!("{} % of torque, where it matters", 100.0 * size);
        tell(&head, &|row| row.is_material && row.is_of(*size), &named);
        for arm in ARMS {
            let is_here = |row: &&Row| row.is_material && row.is_of(*size) && row.arm == arm.name;
            tell(&format!("  of these on {}", arm.name), &is_here, &named);
        }
        for (what, repeats) in [("repeat", true), ("do not repeat", false)] {
            let is_here =
                |row: &&Row| row.is_material && row.is_of(*size) && row.repeats == repeats;
            tell(
                &format!("  of these, motions that {what}"),
                &is_here,
                &named,
            );
        }
    }
    // A clean arm that is unexplained is one, too.
    let alarms: [(&str, &[Mark]); 1] = [("false alarms", &[Mark::Wrong])];
    tell("clean arms", &|row| row.kind == "nothing", &alarms);
    let clean = rows.iter().filter(|row| row.kind == "nothing");
    let what = |row: &Row| match (row.encoder_bits, row.noise.as_str()) {
        (None, "") => "usual encoders".to_owned(),
        (Some(bits), _) => format!("{bits} bits"),
        (None, noise) => noise.to_owned(),
    };
    let whats: BTreeSet<String> = clean.map(what).collect();
    for one in whats {
        let is_here = |row: &&Row| row.kind == "nothing" && what(row) == one;
        tell(&format!("  of these with {one}"), &is_here, &alarms);
    }
    let is_small = |row: &&Row| !row.is_material && row.kind != "nothing" && row.kind != "unknown";
    tell("too little to matter", &is_small, &named[2..]);
    let unknown: [(&str, &[Mark]); 2] = [("wrong", &[Mark::Wrong]), ("not seen", &[Mark::Missed])];
    tell(
        "laws that no library has",
        &|row| row.kind == "unknown",
        &unknown,
    );
    let is_open = |row: &&Row| row.mark == Mark::Wrong && row.is_alternative;
    let open = rows.iter().filter(is_open).count();
    let _ = writeln!(
        text,
        "wrong names with the right one among the alternatives: {open}"
    );
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
    let intervals = intervals(rows);
    let _ = write!(text, "{intervals}");
    let slowest = rows.iter().map(|row| row.seconds).fold(0.0, f64::max);
    let _ = writeln!(text, "slowest: {slowest:.1} s");
    text
}

/// How often intervals at 95 %, of parameters that have one, have the value that was put in, where the name is exact.
fn intervals(rows: &[Row]) -> String {
    let mut text = String::new();
    let of_arms = ARMS.iter().map(|arm| Some(arm.name));
    for arm in std::iter::once(None).chain(of_arms) {
        let mut draws = BTreeMap::<_, usize>::new();
        let mut deviations: Vec<f64> = Vec::new();
        for row in rows
            .iter()
            .filter(|row| arm.is_none_or(|arm| row.arm == arm))
        {
            if !row.deviations.is_empty() {
                *draws.entry(row.draw()).or_default() += row.deviations.len();
                deviations.extend(&row.deviations);
            }
        }
        let all = deviations.len();
        if all == 0 {
            continue;
        }
        let hits = deviations.iter().filter(|z| z.abs() <= Z).count();
        let share = hits as f64 / all as f64;
        let (low, high) = wilson(share, worth(draws.into_values()));
        let what = arm.map_or(
            "intervals of exact names with the true value".to_owned(),
            |arm| format!("  of these on {arm}"),
        );
        let (share, low, high) = (100.0 * share, 100.0 * low, 100.0 * high);
        let far = deviations.iter().filter(|z| z.abs() > FAR).count();
        let far = 100.0 * far as f64 / all as f64;
        let _ = writeln!(
            text,
            "{what} ({all}): {share:.0} % ({low:.0} to {high:.0}); {far:.0} % are further than {FAR} deviations away"
        );
    }
    text
}
