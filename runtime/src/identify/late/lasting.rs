//! What a delay takes off a residual all along a log.

/// By which share the root mean square of a residual is less without a delay, of all rows but those of the tenth of the log that say most of
/// it. A delay is one all along; what the beginning of a motion or a contact leaves is made up for by one there alone.
pub(super) fn lasting_gain(before: &[f64], after: &[f64]) -> f64 {
    let tenth = before.len().div_ceil(10).max(1);
    let squares = |rows: &[f64]| rows.iter().map(|r| r * r).sum::<f64>();
    let blocks = before.chunks(tenth).zip(after.chunks(tenth));
    let blocks: Vec<[f64; 2]> = blocks
        .map(|(before, after)| [squares(before), squares(after)])
        .collect();
    let less = |[before, after]: &[f64; 2]| before - after;
    let most = blocks.iter().max_by(|x, y| less(x).total_cmp(&less(y)));
    let most = most.copied().unwrap_or_default();
    let left = |of: usize| blocks.iter().map(|block| block[of]).sum::<f64>() - most[of];
    let [before, after] = [0, 1].map(left);
    if before > 0.0 {
        1.0 - (after.max(0.0) / before).sqrt()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::lasting_gain;

    #[test]
    fn what_is_less_in_a_tenth_of_a_log_is_no_gain() {
        let before: Vec<f64> = (0..200).map(|k| if k < 10 { 9.0 } else { 1.0 }).collect();
        let of_the_beginning = vec![1.0; 200];
        assert!(lasting_gain(&before, &of_the_beginning).abs() < 1e-12);
        let all_along: Vec<f64> = before.iter().map(|r| 0.5 * r).collect();
        assert!((lasting_gain(&before, &all_along) - 0.5).abs() < 1e-12);
        assert_eq!(lasting_gain(&[0.0; 20], &[0.0; 20]).to_bits(), 0);
    }
}
