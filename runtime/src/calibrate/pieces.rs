//! Where a series jumps.

use std::ops::Range;

/// Sums of a series and its squares up to each sample.
struct Sums(Vec<f64>);

impl Sums {
    fn of(values: &[f64]) -> Self {
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        sums.extend(values.iter().map(|x| {
            sum += x;
            sum
        }));
        Self(sums)
    }

    /// By how much the squares about constants fall where one becomes two.
    fn gain(&self, start: usize, cut: usize, end: usize) -> f64 {
        let (left, right) = ((cut - start) as f64, (end - cut) as f64);
        let step = (self.0[end] - self.0[cut]) / right - (self.0[cut] - self.0[start]) / left;
        left * right / (left + right) * step * step
    }
}

/// Pieces of a series that constants explain, where each jump has to be worth a price in squares.
///
/// Binary segmentation (Scott & Knott 1974): the best cut of a piece is taken while it is worth it; cuts that are not worth it any
/// more beside the others are taken back.
pub(super) fn pieces(values: &[f64], price: f64) -> Vec<Range<usize>> {
    let sums = Sums::of(values);
    let mut open = vec![(0, values.len())];
    let mut cuts = vec![0, values.len()];
    while let Some((start, end)) = open.pop() {
        let gains = (start + 1..end).map(|cut| (sums.gain(start, cut, end), cut));
        let best = gains.max_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((_, cut)) = best.filter(|best| best.0 > price) {
            cuts.push(cut);
            open.extend([(start, cut), (cut, end)]);
        }
    }
    cuts.sort_unstable();
    let mut found: Vec<Range<usize>> = Vec::new();
    for pair in cuts.windows(2) {
        match found.last_mut() {
            Some(last) if sums.gain(last.start, pair[0], pair[1]) <= price => last.end = pair[1],
            _ => found.push(pair[0]..pair[1]),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jumps_are_where_they_are() {
        let noise = |k: usize| 0.1 * ((7 * k * k) as f64).sin();
        let level = |k: usize| match k {
            40 => 9.0,
            70..90 => 0.0,
            _ => 1.0,
        };
        let values: Vec<f64> = (0..200).map(|k| level(k) + noise(k)).collect();
        let found = pieces(&values, 0.5);
        assert_eq!(found, [0..40, 40..41, 41..70, 70..90, 90..200]);
        assert_eq!(pieces(&values, 1e3), std::slice::from_ref(&(0..200)));
    }
}
