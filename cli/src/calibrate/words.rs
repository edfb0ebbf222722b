//! Numbers as people read them.

use robot_model::calibrate::Measured;

use crate::output::{decimals, significant};

/// Digits of a standard deviation.
const OF_STD: usize = 2;

/// Digits of a value that has no deviation.
const OF_EXACT: usize = 6;

/// "0.1132 +- 0.0011 N m/A, with 95 % in 0.1108 .. 0.1156"
pub(super) fn measured(found: &Measured, unit: &str) -> String {
    let decimals = decimals_of(found);
    let [low, high] = found.interval;
    format!(
        "{:.decimals$} +- {} {unit}, with 95 % in {low:.decimals$} .. {high:.decimals$}",
        found.value,
        significant(found.std, OF_STD),
    )
}

/// A value with the digits that its deviation leaves it, and one more.
pub(super) fn rounded(found: &Measured) -> String {
    let decimals = decimals_of(found) + 1;
    format!("{:.decimals$}", found.value)
}

fn decimals_of(found: &Measured) -> usize {
    let of_value = decimals(found.value, OF_EXACT);
    if found.std == 0.0 {
        of_value
    } else {
        // An error below rounding has no digits to show.
        decimals(found.std, OF_STD).min(decimals(found.value, 12).max(of_value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_deviation() {
        let found = |value, std| Measured {
            value,
            std,
            interval: [value - 2.0 * std, value + 2.0 * std],
        };
        let said = measured(&found(0.113_249, 0.001_14), "N m/A");
        assert_eq!(
            said,
            "0.1132 +- 0.0011 N m/A, with 95 % in 0.1110 .. 0.1155"
        );
        assert_eq!(rounded(&found(0.113_249, 0.001_14)), "0.11325");
        assert_eq!(rounded(&found(123.456, 40.0)), "123.5");
        assert_eq!(rounded(&found(0.5, 0.0)), "0.5000000");
        assert_eq!(significant(0.0, 3), "0.00");
        assert_eq!(significant(98_765.0, 2), "98765");
    }
}
