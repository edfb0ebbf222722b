//! Damage along the grammar: pieces of text, and whole statements and blocks, are dropped, doubled, swapped, replaced.

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

/// Words and numbers that are put in the place of others.
const WORDS: [&str; 58] = [
    "0",
    "1",
    "-1",
    "2",
    "0.5",
    "1e-300",
    "1e300",
    "1e999",
    "90 deg",
    "3 mm",
    "1.5707963",
    "pi",
    "time",
    "9",
    "16",
    "robot",
    "effect",
    "joint",
    "link",
    "effects",
    "on",
    "all",
    "gravity",
    "convention",
    "standard_dh",
    "origin",
    "revolute",
    "prismatic",
    "fixed",
    "linear",
    "shape",
    "in",
    "torque(j)",
    "q(j)",
    "dq(j)",
    "ddq(j)",
    "rigid_torque(j)",
    "sign",
    "exp",
    "sqrt",
    "dot",
    "kinetic",
    "potential",
    "coordinates",
    "parameters",
    "constants",
    "let",
    "point",
    "state",
    "input",
    "if",
    "min",
    "max",
    "position",
    "body",
    "tilt",
    "delay",
    "^",
];

/// Numbers that are put in the place of others.
const NUMBERS: [&str; 16] = [
    "0 ",
    "1 ",
    "2 ",
    "3 ",
    "7 ",
    "16 ",
    "100 ",
    "0.5 ",
    "0.1 ",
    "1.5707963 ",
    "1e-9 ",
    "1e-160 ",
    "1e-300 ",
    "1e9 ",
    "1e160 ",
    "1e300 ",
];

/// Statements that some block may take.
const STATEMENTS: [&str; 24] = [
    "viscous_friction on all;",
    "load_dependent_friction on all;",
    "stribeck on all;",
    "torque_ripple(order = 3) on all;",
    "motor_inertia on all;",
    "joint extra: revolute { a = 0.1; alpha = 30 deg; d = 0.2; }",
    "joint slide: prismatic { a = 0; alpha = 90 deg; theta = 0; }",
    "link extra { mass = 1; com = [0, 0, 0.1]; inertia = [1, 0, 0, 1, 0, 1]; }",
    "position = -1 .. 1;",
    "gravity = [0, 0, -9.81];",
    "linear extra >= 0;",
    "shape extra in 0.1 .. 10;",
    "let extra = 2;",
    "parameters extra;",
    "point extra = [1 m, 0, 0];",
    "state extra;",
    "dot(extra) = dq(j) - extra;",
    "input extra;",
    "input extra(j);",
    "let extra = if q(j) > 0 { min(q(j), 1) } else { max(dq(j), -1) };",
    "position(j) = 0.01;",
    "body(j) = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0];",
    "tilt = [0.01, 0.02];",
    "delay = 0.001;",
];

/// A damaged copy of `text`; parts of `other` may be spliced in.
#[must_use]
pub fn mutate(text: &str, other: &str, dice: &mut ChaCha8Rng) -> String {
    let mut damaged = text.to_owned();
    for _ in 0..=dice.random_range(0..3_usize) {
        damaged = match dice.random_range(0..8) {
            0..3 => statements(&damaged, other, dice),
            3..6 => numbers(&damaged, dice),
            _ => words(&damaged, other, &WORDS, dice),
        };
    }
    damaged
}

/// The same for a text of another language, with words of it.
#[must_use]
pub(crate) fn mutate_words(
    text: &str,
    other: &str,
    vocabulary: &[&str],
    dice: &mut ChaCha8Rng,
) -> String {
    let mut damaged = text.to_owned();
    for _ in 0..=dice.random_range(0..3_usize) {
        damaged = if dice.random_range(0..3) == 0 {
            numbers(&damaged, dice)
        } else {
            words(&damaged, other, vocabulary, dice)
        };
    }
    damaged
}

/// Another number in the place of one: most specs stay sound.
fn numbers(text: &str, dice: &mut ChaCha8Rng) -> String {
    let mut damaged = pieces(text);
    let is_number = |piece: &&str| piece.starts_with(|c: char| c.is_ascii_digit());
    let places: Vec<usize> = (0..damaged.len())
        .filter(|&k| is_number(&damaged[k]))
        .collect();
    if places.is_empty() {
        return text.to_owned();
    }
    let at = places[dice.random_range(0..places.len())];
    damaged[at] = NUMBERS[dice.random_range(0..NUMBERS.len())];
    joined(&damaged)
}

fn words(text: &str, other: &str, vocabulary: &[&str], dice: &mut ChaCha8Rng) -> String {
    let own = pieces(text);
    let foreign = pieces(other);
    if own.is_empty() {
        return STATEMENTS[dice.random_range(0..STATEMENTS.len())].to_owned();
    }
    let at = dice.random_range(0..own.len());
    let mut damaged = own.clone();
    match dice.random_range(0..8) {
        0 => drop(damaged.remove(at)),
        1 => damaged.insert(at, own[at]),
        2 => damaged.swap(at, dice.random_range(0..own.len())),
        3 => damaged[at] = own[dice.random_range(0..own.len())],
        4 if !foreign.is_empty() => damaged[at] = foreign[dice.random_range(0..foreign.len())],
        5 => damaged.insert(at, vocabulary[dice.random_range(0..vocabulary.len())]),
        6 => damaged.insert(
            at,
            ["(", ")", "{", "}", ";", "*", "/", "-", ","][dice.random_range(0..9)],
        ),
        _ => damaged[at] = vocabulary[dice.random_range(0..vocabulary.len())],
    }
    joined(&damaged)
}

/// Pieces with a blank between two words that would become one.
fn joined(pieces: &[&str]) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut text = String::new();
    for piece in pieces {
        if text.ends_with(is_word) && piece.starts_with(is_word) {
            text.push(' ');
        }
        text.push_str(piece);
    }
    text
}

fn statements(text: &str, other: &str, dice: &mut ChaCha8Rng) -> String {
    let own = spans(text);
    let foreign = spans(other);
    if own.is_empty() {
        return words(text, other, &WORDS, dice);
    }
    let (start, end) = own[dice.random_range(0..own.len())];
    let statement = &text[start..end];
    let replacement = match dice.random_range(0..6) {
        0 => String::new(),
        1 => statement.repeat(2),
        2 => statement.repeat(1 << dice.random_range(2..6)),
        3 if !foreign.is_empty() => {
            let (start, end) = foreign[dice.random_range(0..foreign.len())];
            other[start..end].to_owned()
        }
        4 if !foreign.is_empty() => {
            let (start, end) = foreign[dice.random_range(0..foreign.len())];
            statement.to_owned() + &other[start..end]
        }
        _ => statement.to_owned() + STATEMENTS[dice.random_range(0..STATEMENTS.len())],
    };
    format!("{}{replacement}{}", &text[..start], &text[end..])
}

/// Words, numbers and single signs, each with the white space behind it.
#[must_use]
pub fn pieces(text: &str) -> Vec<&str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut pieces = Vec::new();
    let (mut start, mut before) = (0, ' ');
    for (at, c) in text.char_indices() {
        if at > start && !(is_word(before) && is_word(c)) && !c.is_whitespace() {
            pieces.push(&text[start..at]);
            start = at;
        }
        before = c;
    }
    if start < text.len() {
        pieces.push(&text[start..]);
    }
    pieces
}

/// Statements and blocks: from behind a `;`, `{` or `}` to the next `;` at the same depth, or to the block's `}`.
fn spans(text: &str) -> Vec<(usize, usize)> {
    let mut spans = Vec::new();
    let mut starts = vec![0];
    for (at, c) in text.char_indices() {
        match c {
            '{' => starts.push(at + 1),
            ';' => {
                if let Some(start) = starts.last_mut() {
                    spans.push((*start, at + 1));
                    *start = at + 1;
                }
            }
            '}' if starts.len() > 1 => {
                starts.pop();
                if let Some(start) = starts.last_mut() {
                    spans.push((*start, at + 1));
                    *start = at + 1;
                }
            }
            _ => {}
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::{mutate, pieces, spans};
    use rand::SeedableRng as _;
    use rand_chacha::ChaCha8Rng;

    const SPEC: &str = "robot R { a = 1; joint j: revolute { d = 0; } }";

    #[test]
    fn statements_and_blocks_are_found() {
        let found: Vec<&str> = spans(SPEC)
            .iter()
            .map(|&(s, e)| SPEC[s..e].trim())
            .collect();
        assert_eq!(
            found,
            ["a = 1;", "d = 0;", "joint j: revolute { d = 0; }", SPEC]
        );
    }

    #[test]
    fn pieces_are_the_whole_text() {
        assert_eq!(pieces(SPEC).concat(), SPEC);
    }

    #[test]
    fn the_same_seed_does_the_same_damage() {
        let damaged = |seed| mutate(SPEC, "effect e(j) {}", &mut ChaCha8Rng::seed_from_u64(seed));
        assert_eq!(damaged(3), damaged(3));
        assert!((0..20).any(|seed| damaged(seed) != SPEC));
    }
}
