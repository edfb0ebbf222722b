//! May noise have made what a candidate takes off?

use super::verdict::Evidence;

/// Family-wise error rate of the score, for laws that do not take much off the errors.
pub(super) const SIGNIFICANCE: f64 = 1e-3;

/// What takes as much off a joint's error that was not fitted, and off the raw one, needs no more of a score than this: a short log has few
/// blocks, whose score may be no more beyond chance than that.
///
/// What takes 65 % off, and half of the raw one, in all folds needs a score that noise has less than once in all the laws that are tried. Of the
/// five seconds of a real wrist that of the coupling of its motors was 0.4. An offset or a spring takes as much off a zero that walks by more than
/// noise, and has no score at all then, as the walk is in its variance.
const LARGE: [Large; 5] = [
    Large {
        held_out_percent: 65.0,
        raw_percent: 50.0,
        significance: 1.0,
        folds_without: 0,
    },
    Large {
        held_out_percent: 50.0,
        raw_percent: 20.0,
        significance: 0.3,
        folds_without: 0,
    },
    Large {
        held_out_percent: 30.0,
        raw_percent: 20.0,
        significance: 0.1,
        folds_without: 0,
    },
    Large {
        held_out_percent: 20.0,
        raw_percent: 20.0,
        significance: 1e-2,
        folds_without: 1,
    },
    Large {
        held_out_percent: 20.0,
        raw_percent: 7.5,
        significance: 1e-2,
        folds_without: 0,
    },
];

/// The same of laws of time. A zero that wanders looks like a force for some seconds, which may halve both errors in all folds, but it has no
/// level that it keeps: of 300 random walks the force that fits best takes 43 % off in the median, and 68 % at most.
const LARGE_OF_TIME: [Large; 1] = [Large {
    held_out_percent: 75.0,
    raw_percent: 50.0,
    significance: 1e-2,
    folds_without: 0,
}];

/// What an effect has to take off, percent, in all folds but so many, to need only so low a probability of chance.
struct Large {
    held_out_percent: f64,
    raw_percent: f64,
    significance: f64,
    folds_without: usize,
}

impl Large {
    fn is_reached(&self, evidence: &Evidence, touched: &[usize]) -> bool {
        let (improved, folds) = evidence.folds;
        let takes = |joint: &usize| {
            evidence.held_out_percent[*joint] >= self.held_out_percent
                && evidence.raw_percent[*joint] >= self.raw_percent
        };
        improved + self.folds_without >= folds
            && evidence.p_value < self.significance
            && touched.iter().any(takes)
    }
}

/// Whether noise may have made what a candidate does to its joints.
pub(super) fn is_chance(evidence: &Evidence, touched: &[usize], is_of_time: bool) -> bool {
    let large: &[Large] = if is_of_time { &LARGE_OF_TIME } else { &LARGE };
    let is_large = large
        .iter()
        .any(|large| large.is_reached(evidence, touched));
    !is_large && evidence.p_value >= SIGNIFICANCE
}

#[cfg(test)]
mod tests {
    use super::super::series::white;
    use super::*;

    /// How much of a series, percent of its root mean square, a constant from one sample to another takes off at most, beside another constant.
    fn most_of_a_window(series: &[f64]) -> f64 {
        let count = series.len() as f64;
        let mean = series.iter().sum::<f64>() / count;
        let squares: f64 = series.iter().map(|x| (x - mean).powi(2)).sum();
        let mut sums = vec![0.0];
        for x in series {
            sums.push(sums[sums.len() - 1] + x - mean);
        }
        let of = |from: usize, to: usize| {
            let length = (to - from) as f64;
            (sums[to] - sums[from]).powi(2) / (length * (1.0 - length / count))
        };
        let windows =
            (0..series.len()).flat_map(|from| (from + 1..=series.len()).map(move |to| (from, to)));
        let windows = windows.filter(|(from, to)| to - from < series.len());
        let most = windows.map(|(from, to)| of(from, to)).fold(0.0, f64::max);
        100.0 * (1.0 - (1.0 - most / squares).max(0.0).sqrt())
    }

    /// Whatever window is chosen, and with no fold held out.
    #[test]
    fn no_window_takes_so_much_off_a_walk_as_a_law_of_time_has_to() {
        let walk = |seed: u32| -> Vec<f64> {
            let steps = white(160, seed).into_iter();
            steps
                .scan(0.0, |zero, step| {
                    *zero += step;
                    Some(*zero)
                })
                .collect()
        };
        let most = (0..300).map(|seed| most_of_a_window(&walk(seed)));
        let mut most: Vec<f64> = most.collect();
        most.sort_by(f64::total_cmp);
        assert!(
            most[150] > 35.0 && most[299] < LARGE_OF_TIME[0].held_out_percent,
            "{most:?}"
        );
        // A force is one, with some noise.
        let is_there = |k: u32| if (60..100).contains(&k) { 3.0 } else { 0.0 };
        let force: Vec<f64> = (0..160)
            .zip(white(160, 1))
            .map(|(k, noise)| is_there(k) + 0.2 * noise)
            .collect();
        assert!(most_of_a_window(&force) > LARGE_OF_TIME[0].held_out_percent);
    }

    #[test]
    fn what_takes_much_off_needs_less_of_a_score() {
        let of = |p_value: f64, held_out: f64, raw: f64, improved: usize| Evidence {
            score: 40.0,
            p_value,
            held_out_percent: vec![2.0, held_out],
            raw_percent: vec![60.0, raw],
            folds: (improved, 5),
        };
        let named = |evidence: &Evidence| !is_chance(evidence, &[1], false);
        for law in [
            of(5e-4, 3.0, 1.0, 4),
            of(0.02, 72.0, 45.0, 5),
            of(0.2, 72.0, 45.0, 5),
            of(0.4, 72.0, 66.0, 5),
            of(2e-3, 22.0, 8.0, 5),
            of(0.02, 32.0, 21.0, 5),
            of(8e-3, 22.0, 21.0, 4),
        ] {
            assert!(named(&law), "{law:?}");
        }
        for chance in [
            of(2e-3, 18.0, 8.0, 5),
            of(2e-3, 30.0, 25.0, 3),
            of(2e-3, 30.0, 18.0, 4),
            of(0.02, 72.0, 45.0, 4),
            of(0.02, 72.0, 7.0, 5),
            of(0.02, 32.0, 18.0, 5),
            of(0.02, 28.0, 25.0, 5),
            of(0.2, 32.0, 25.0, 5),
            of(0.4, 72.0, 45.0, 5),
            of(0.4, 62.0, 55.0, 5),
            of(0.4, 72.0, 66.0, 4),
        ] {
            assert!(!named(&chance), "{chance:?}");
        }
        // What the fit of all does to another joint is no word for a law of this one.
        assert!(is_chance(&of(2e-3, 72.0, 45.0, 5), &[0], false));
        // A wandering zero takes as much off as the first; a force that is there for a while takes nearly all.
        assert!(is_chance(&of(2e-3, 72.0, 60.0, 5), &[1], true));
        assert!(!is_chance(&of(5e-4, 72.0, 60.0, 5), &[1], true));
        assert!(!is_chance(&of(2e-3, 88.0, 60.0, 5), &[1], true));
        assert!(is_chance(&of(2e-3, 88.0, 60.0, 4), &[1], true));
        assert!(is_chance(&of(2e-2, 88.0, 60.0, 5), &[1], true));
    }
}
