//! Whether two texts say the same, but for the last digits of numbers.

/// Units of the last digit by which numbers may differ, and shares of them: a digit more is printed of large ones than one should rely on.
const UNITS: f64 = 2.0;
const SHARE: f64 = 2e-3;
/// Counts may differ by this share: below a hundred they are the same.
const COUNTED: f64 = 1e-2;
/// Numbers below this are rounding, of which one or another decade is left.
const ROUNDING: f64 = 1e-5;
const DECADE: f64 = 10.0;

/// A piece of text.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Piece<'a> {
    Text(&'a str),
    /// Value, and a unit of its last digit; none where it is a count.
    Number(f64, Option<f64>),
}

/// Whether both texts have the same words and the same numbers, the latter to two units of their last digit; below 1e-5 to a decade. How
/// lines are broken does not matter.
#[must_use]
pub fn agree(one: &str, other: &str) -> bool {
    let (one, other) = (words(one), words(other));
    let mut pairs = one.iter().zip(&other);
    one.len() == other.len() && pairs.all(|(one, other)| are_alike(*one, *other))
}

/// Whether both texts have the same words, and numbers that are no farther apart than `most`.
#[must_use]
pub fn are_within(one: &str, other: &str, most: f64) -> bool {
    let (one, other) = (words(one), words(other));
    let mut pairs = one.iter().zip(&other);
    one.len() == other.len()
        && pairs.all(|pair| match pair {
            (Piece::Number(x, _), Piece::Number(y, _)) => (x - y).abs() <= most,
            (one, other) => one == other,
        })
}

/// Whether both texts have the same words, and numbers at the same places, whatever these and their signs are.
#[must_use]
pub fn have_same_words(one: &str, other: &str) -> bool {
    let (one, other) = (words(one), words(other));
    let mut pairs = one.iter().zip(&other);
    let unsigned = |text: &str| text.trim_end_matches(['-', '+']).to_owned();
    one.len() == other.len()
        && pairs.all(|pair| match pair {
            (Piece::Text(one), Piece::Text(other)) => unsigned(one) == unsigned(other),
            (one, other) => std::mem::discriminant(one) == std::mem::discriminant(other),
        })
}

/// The pieces of all words, an empty text between two words.
fn words(text: &str) -> Vec<Piece<'_>> {
    let words = text.split_whitespace();
    words
        .flat_map(|word| [pieces(word), vec![Piece::Text("")]].concat())
        .collect()
}

fn are_alike(one: Piece<'_>, other: Piece<'_>) -> bool {
    match (one, other) {
        (Piece::Number(x, of_x), Piece::Number(y, of_y)) => {
            let (apart, most) = ((x - y).abs(), x.max(y));
            if most < ROUNDING {
                return most <= DECADE * x.min(y) || x.min(y) == 0.0;
            }
            let units = match (of_x, of_y) {
                (None, None) => COUNTED * most,
                _ => UNITS * 1.01 * of_x.unwrap_or(0.0).max(of_y.unwrap_or(0.0)),
            };
            apart <= units.max(SHARE * most)
        }
        _ => one == other,
    }
}

/// Text and numbers in turns; a sign is text.
fn pieces(word: &str) -> Vec<Piece<'_>> {
    let mut found = Vec::new();
    let mut rest = word;
    while !rest.is_empty() {
        let start = rest
            .find(|c: char| c.is_ascii_digit())
            .unwrap_or(rest.len());
        if start > 0 {
            found.push(Piece::Text(&rest[..start]));
            rest = &rest[start..];
            continue;
        }
        let digits = |text: &str| {
            text.find(|c: char| !c.is_ascii_digit())
                .unwrap_or(text.len())
        };
        let whole = digits(rest);
        let decimals = rest[whole..].strip_prefix('.').map_or(0, digits);
        let mut end = whole + if decimals > 0 { 1 + decimals } else { 0 };
        let mut power = 0_i32;
        let mut has_power = false;
        if let Some(exponent) = rest[end..].strip_prefix('e') {
            let sign = usize::from(exponent.starts_with('-'));
            let length = sign + digits(&exponent[sign..]);
            if let Ok(value) = exponent[..length].parse() {
                (power, has_power) = (value, true);
                end += 1 + length;
            }
        }
        let value = rest[..end].parse().unwrap_or(f64::NAN);
        let places = i32::try_from(decimals).unwrap_or(0);
        let unit = (decimals > 0 || has_power).then(|| 10_f64.powi(power - places));
        found.push(Piece::Number(value, unit));
        rest = &rest[end..];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn last_digits_may_differ_and_nothing_else() {
        for (one, other) in [
            ("cost 2.13, 6 steps", "cost  2.15,\n6 steps"),
            ("4e-10 rad", "3e-9 rad"),
            ("20112 values", "20113 values"),
            ("-1.1e-2", "-1.2e-2"),
            ("q1.fc 0.0178", "q1.fc 0.0180"),
            ("123.4", "123.6"),
        ] {
            assert!(agree(one, other), "{one} / {other}");
        }
        for (one, other) in [
            ("cost 2.13, 6 steps", "cost 2.13, 7 steps"),
            ("cost 2.13", "cost 2.17"),
            ("cost 2.13", "costs 2.13"),
            ("-1.1e-2", "1.1e-2"),
            ("1e-3", "4e-3"),
            ("q1.fc", "q2.fc"),
            ("20112 values", "21112 values"),
            ("a b", "a"),
        ] {
            assert!(!agree(one, other), "{one} / {other}");
        }
        assert!(have_same_words("| 1 | 14.50, 0.02 |", "| 9 | 2.1, 3.0 |"));
        assert!(!have_same_words("| 1 | cost 14.50 |", "| 9 | 2.1 |"));
    }
}
