//! Columns that are logged now and then, as a temperature is.

/// Joins the numbers of a column by straight lines over its rows, and holds the first and the last one; whether there was anything to do.
pub(super) fn fill(values: &mut [f64]) -> bool {
    let mut last: Option<usize> = None;
    let mut is_filled = false;
    for k in 0..values.len() {
        if !values[k].is_finite() {
            is_filled = true;
            continue;
        }
        let from = last.map_or(0, |last| last + 1);
        let start = last.map_or(values[k], |last| values[last]);
        let steps = (k + 1 - from) as f64;
        let rise = values[k] - start;
        for row in from..k {
            values[row] = start + rise * (row + 1 - from) as f64 / steps;
        }
        last = Some(k);
    }
    if let Some(last) = last {
        let held = values[last];
        values[last..].fill(held);
    }
    is_filled
}

#[cfg(test)]
mod tests {
    use super::fill;

    #[test]
    fn numbers_are_joined_and_the_ends_held() {
        let none = f64::NAN;
        let mut values = [none, 1.0, none, none, 4.0, none];
        assert!(fill(&mut values));
        assert_eq!(
            values.map(f64::to_bits),
            [1.0, 1.0, 2.0, 3.0, 4.0, 4.0].map(f64::to_bits)
        );
        assert!(!fill(&mut values));
    }
}
