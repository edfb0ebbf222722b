//! What a share of experiments says of all that might have been drawn.

/// Standard deviations of a normal variable within which 95 % are.
pub const Z: f64 = 1.96;

/// Wilson's 95 % interval of a share, from 0 to 1, of `count` independent experiments (Wilson 1927).
#[must_use]
pub fn wilson(share: f64, count: f64) -> (f64, f64) {
    let n = count.max(1.0);
    let middle = share + Z * Z / (2.0 * n);
    let half = Z * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + Z * Z / n;
    (
        ((middle - half) / whole).max(0.0),
        ((middle + half) / whole).min(1.0),
    )
}

/// How many independent experiments draws are worth that have so many experiments each, if those of a draw always agree:
/// `(sum m)^2 / sum m^2` (Kish 1965).
pub fn worth(experiments: impl Iterator<Item = usize>) -> f64 {
    let (sum, squares) = experiments.fold((0.0, 0.0), |(sum, squares), count| {
        let count = count as f64;
        (sum + count, squares + count * count)
    });
    sum * sum / f64::max(squares, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_those_of_tables() {
        let is = |(low, high): (f64, f64), wanted: [f64; 2]| {
            assert!((low - wanted[0]).abs() < 5e-4, "{low}");
            assert!((high - wanted[1]).abs() < 5e-4, "{high}");
        };
        is(wilson(0.5, 10.0), [0.2366, 0.7634]);
        is(wilson(0.0, 10.0), [0.0, 0.2775]);
        is(wilson(0.95, 100.0), [0.8882, 0.9785]);
    }

    #[test]
    fn draws_that_agree_count_once() {
        assert!((worth([1, 1, 1].into_iter()) - 3.0).abs() < 1e-12);
        assert!((worth([3, 3].into_iter()) - 2.0).abs() < 1e-12);
        assert!((worth([3, 3, 1, 1].into_iter()) - 3.2).abs() < 1e-12);
    }
}
