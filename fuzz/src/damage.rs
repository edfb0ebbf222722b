//! Damage as files come by it: cut off, in another order, with bytes that are no text, with cells that are no numbers or beyond all
//! reason, and in other units.

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use crate::mutate::pieces;

/// How a file is damaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Damage {
    /// It ends somewhere.
    Truncated,
    /// Lines, or columns of a table, are in another order.
    Reordered,
    /// Bytes that are no text stand in it.
    Binary,
    /// Numbers are none: `NaN`, `inf`, words, nothing.
    NotANumber,
    /// Numbers are beyond all reason.
    Huge,
    /// Numbers are of other units than their names say.
    Units,
}

impl Damage {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Truncated,
        Self::Reordered,
        Self::Binary,
        Self::NotANumber,
        Self::Huge,
        Self::Units,
    ];

    /// What a test calls it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Truncated => "truncated",
            Self::Reordered => "reordered",
            Self::Binary => "binary",
            Self::NotANumber => "NaN",
            Self::Huge => "huge",
            Self::Units => "units",
        }
    }

    /// A damaged copy of a table with a header, its cells parted by commas.
    #[must_use]
    pub fn of_table(self, text: &str, dice: &mut ChaCha8Rng) -> Vec<u8> {
        match self {
            Self::Truncated => truncated(text.as_bytes(), dice),
            Self::Binary => binary(text.as_bytes(), dice),
            Self::Reordered if dice.random_range(0..2) == 0 => renamed(text, dice).into_bytes(),
            Self::Reordered => lines(text, dice).into_bytes(),
            Self::NotANumber => cells(text, dice, &NO_NUMBERS).into_bytes(),
            Self::Huge => cells(text, dice, &HUGE).into_bytes(),
            Self::Units => scaled(text, dice).into_bytes(),
        }
    }

    /// A damaged copy of a text in which numbers have units behind them, as of a spec.
    #[must_use]
    pub fn of_text(self, text: &str, dice: &mut ChaCha8Rng) -> Vec<u8> {
        match self {
            Self::Truncated => truncated(text.as_bytes(), dice),
            Self::Binary => binary(text.as_bytes(), dice),
            Self::Reordered => lines(text, dice).into_bytes(),
            Self::NotANumber => words(text, dice, is_number, &NO_NUMBERS).into_bytes(),
            Self::Huge => words(text, dice, is_number, &HUGE).into_bytes(),
            Self::Units => words(text, dice, |word| UNITS.contains(&word), &UNITS).into_bytes(),
        }
    }
}

const NO_NUMBERS: [&str; 8] = ["NaN", "inf", "-inf", "", "null", "1,5", "0x1p3", "--"];
const HUGE: [&str; 6] = [
    "1e300",
    "-1e300",
    "1e999",
    "1e20",
    "99999999999999999999",
    "4e-320",
];
const UNITS: [&str; 10] = ["deg", "rad", "mm", "m", "kg", "s", "N", "rpm", "A", ""];

/// From radians to degrees and back, to thousandths and back, to revolutions a minute.
const FACTORS: [f64; 5] = [57.295_779_513, 0.017_453_293, 1000.0, 0.001, 9.549_296_586];

fn truncated(bytes: &[u8], dice: &mut ChaCha8Rng) -> Vec<u8> {
    bytes[..dice.random_range(0..bytes.len().max(1))].to_vec()
}

fn binary(bytes: &[u8], dice: &mut ChaCha8Rng) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    for _ in 0..=dice.random_range(0..4_usize) {
        let at = dice.random_range(0..=damaged.len());
        let count = dice.random_range(1..16_usize);
        let noise: Vec<u8> = (0..count).map(|_| dice.random()).collect();
        damaged.splice(at..at, noise);
    }
    damaged
}

fn lines(text: &str, dice: &mut ChaCha8Rng) -> String {
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    let count = lines.len();
    if count < 2 {
        return text.to_owned();
    }
    match dice.random_range(0..4) {
        // One elsewhere, two for each other, all from the end, one twice.
        0 => {
            let line = lines.remove(dice.random_range(0..count));
            lines.insert(dice.random_range(0..count), line);
        }
        1 => lines.swap(dice.random_range(0..count), dice.random_range(0..count)),
        2 => lines.reverse(),
        _ => {
            let at = dice.random_range(0..count);
            lines.insert(at, lines[at]);
        }
    }
    lines.concat()
}

/// Two names of the header for each other.
fn renamed(text: &str, dice: &mut ChaCha8Rng) -> String {
    let (header, rows) = text.split_once('\n').unwrap_or((text, ""));
    let mut names: Vec<&str> = header.split(',').collect();
    let count = names.len();
    names.swap(dice.random_range(0..count), dice.random_range(0..count));
    format!("{}\n{rows}", names.join(","))
}

/// A column times a factor.
fn scaled(text: &str, dice: &mut ChaCha8Rng) -> String {
    let factor = FACTORS[dice.random_range(0..FACTORS.len())];
    let column = dice.random_range(0..width(text));
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        let cells = line.split(',').enumerate().map(|(k, cell)| {
            let value = cell.parse::<f64>().ok().filter(|_| k == column);
            value.map_or_else(|| cell.to_owned(), |value| (value * factor).to_string())
        });
        out.push_str(&cells.collect::<Vec<_>>().join(","));
        out.push('\n');
    }
    out
}

/// Columns of a table; one of none at all.
fn width(text: &str) -> usize {
    text.lines()
        .next()
        .map_or(1, |line| line.split(',').count())
}

/// Some cells, or all of one column from somewhere on, replaced.
fn cells(text: &str, dice: &mut ChaCha8Rng, by: &[&str]) -> String {
    let rows = text.lines().count();
    if rows < 2 {
        return text.to_owned();
    }
    let word = by[dice.random_range(0..by.len())];
    let column = dice.random_range(0..width(text));
    let first = dice.random_range(1..rows);
    let most = if dice.random_range(0..2) == 0 {
        dice.random_range(1..4_usize)
    } else {
        rows
    };
    let mut out = String::with_capacity(text.len());
    for (row, line) in text.lines().enumerate() {
        let mut cells: Vec<&str> = line.split(',').collect();
        if (first..first.saturating_add(most)).contains(&row)
            && let Some(cell) = cells.get_mut(column)
        {
            *cell = word;
        }
        out.push_str(&cells.join(","));
        out.push('\n');
    }
    out
}

fn is_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit())
}

/// One of the words of a kind replaced.
fn words(text: &str, dice: &mut ChaCha8Rng, is_one: impl Fn(&str) -> bool, by: &[&str]) -> String {
    let all = pieces(text);
    let places: Vec<usize> = (0..all.len()).filter(|&k| is_one(all[k].trim())).collect();
    if places.is_empty() {
        return text.to_owned();
    }
    let at = places[dice.random_range(0..places.len())];
    let word = by[dice.random_range(0..by.len())];
    let parts = all.iter().enumerate();
    let parts = parts.map(|(k, piece)| {
        if k == at {
            format!("{word} ")
        } else {
            (*piece).to_owned()
        }
    });
    parts.collect()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng as _;

    use super::*;

    const TABLE: &str = "time,q1,tau1\n0,1,2\n0.1,3,4\n0.2,5,6\n";

    #[test]
    fn every_kind_damages_a_table_and_a_text() {
        let spec = "robot R {\n    joint a: revolute { a = 0.5 m; }\n    joint b: revolute { a = 90 deg; }\n}\n";
        for kind in Damage::ALL {
            let differs = |damage: &dyn Fn(&mut ChaCha8Rng) -> bool| {
                (0..20).any(|seed| damage(&mut ChaCha8Rng::seed_from_u64(seed)))
            };
            assert!(
                differs(&|dice| kind.of_table(TABLE, dice) != TABLE.as_bytes()),
                "{kind:?}"
            );
            assert!(
                differs(&|dice| kind.of_text(spec, dice) != spec.as_bytes()),
                "{kind:?}"
            );
        }
    }

    #[test]
    fn a_column_in_another_unit_keeps_its_name() {
        let damaged = Damage::Units.of_table(TABLE, &mut ChaCha8Rng::seed_from_u64(4));
        let damaged = String::from_utf8(damaged).expect("text");
        assert!(damaged.starts_with("time,q1,tau1\n"), "{damaged}");
        assert_eq!(damaged.lines().count(), 4);
    }
}
