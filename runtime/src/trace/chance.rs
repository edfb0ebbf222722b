//! May noise have made what a candidate takes off?

use super::verdict::Evidence;

/// Family-wise error rate of the score, for laws that do not take much off the errors.
pub(super) const SIGNIFICANCE: f64 = 1e-3;

/// What takes as much off a joint's error that was not fitted, and off the raw one, needs no more of a score than this: a short log has few
/// blocks, whose score may be no more beyond chance than that.
const LARGE: [Large; 4] = [
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
/// level that it keeps: nothing that is constant for a while takes nearly all of it.
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
    use super::*;

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
