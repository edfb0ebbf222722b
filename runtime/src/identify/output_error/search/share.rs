//! How much of a search is behind it.

use std::ops::Range;

/// Of a search, for the look at exact slopes where coarse ones have led.
const CLOSING: f64 = 0.1;

/// Steps of a search at the median; as many are left at any time, as long as gains do not say that there are fewer: they fall by little where
/// it is far away, and all at once where Gauss-Newton steps are nearly right.
const USUAL: f64 = 4.0;

/// How far one of several searches has come: by how the gain of its steps falls toward what ends it, in logarithm, and by how many there were.
#[derive(Debug)]
pub(super) struct Share {
    /// Which part of all of them it is.
    of: Range<f64>,
    /// The largest gain so far over what ends it, in logarithm.
    most: f64,
    steps: f64,
    /// What is behind this one, from 0 to 1.
    done: f64,
}

impl Share {
    pub fn new(of: Range<f64>) -> Self {
        Self {
            of,
            most: 0.0,
            steps: 0.0,
            done: 0.0,
        }
    }

    /// A step has gained so much; one that gains no more than `enough` says that the search is over.
    pub fn after(&mut self, gain: f64, enough: f64) {
        self.steps += 1.0;
        let left = (gain / enough).ln();
        // Nothing is enough of a cost that is zero.
        let by_gain = if left.is_nan() || left == f64::INFINITY {
            0.0
        } else if left > 0.0 {
            self.most = self.most.max(left);
            1.0 - left / self.most
        } else {
            1.0
        };
        let by_steps = self.steps / (self.steps + USUAL);
        // What has been said stays.
        self.done = self.done.max(by_gain).max(by_steps);
    }

    /// What is behind all of them, from 0 to 1.
    pub fn done(&self) -> f64 {
        self.of.start + (1.0 - CLOSING) * self.done * (self.of.end - self.of.start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_done(share: &Share, wanted: f64) {
        let done = share.done();
        assert!((done - wanted).abs() < 1e-12, "{done}");
    }

    #[test]
    fn a_search_is_done_as_far_as_its_gain_has_fallen_or_steps_were_made() {
        let mut share = Share::new(0.5..1.0);
        assert_done(&share, 0.5);
        // One step, and four that are left.
        share.after(1e6, 1e-2);
        assert_done(&share, 0.5 + 0.45 * 0.2);
        share.after(1e2, 1e-2);
        assert_done(&share, 0.5 + 0.45 * 0.5);
        // A step that gains more than the one before it takes nothing back.
        share.after(1e4, 1e-2);
        assert_done(&share, 0.5 + 0.45 * 0.5);
        share.after(1e-3, 1e-2);
        assert_done(&share, 0.95);
        share.after(0.0, 0.0);
        assert_done(&share, 0.95);
    }

    #[test]
    fn a_search_that_begins_at_its_end_is_done() {
        let mut share = Share::new(0.0..1.0);
        share.after(0.0, 1e-9);
        assert_done(&share, 0.9);
    }

    /// Of a cost of zero nothing is enough.
    #[test]
    fn steps_count_where_gains_say_nothing() {
        let mut share = Share::new(0.0..1.0);
        for _ in 0..4 {
            share.after(1.0, 0.0);
        }
        assert_done(&share, 0.45);
    }
}
