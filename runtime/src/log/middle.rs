//! A part of a log that stands for all of it.

use std::ops::Range;

use super::Log;

impl Log {
    /// So many seconds around the middle of a log that is longer, away from the rests at its ends; none of one that is not.
    pub(crate) fn middle(&self, seconds: f64) -> Option<Self> {
        let (start, all) = (*self.time.first()?, self.seconds());
        if all <= seconds {
            return None;
        }
        let from = 0.5 * (all - seconds);
        let at = |after: f64| self.time.partition_point(|time| time - start < after);
        let samples = at(from)..at(from + seconds);
        let from = self.time[samples.start] - start;
        let cut = |values: &Vec<f64>| values[samples.clone()].to_vec();
        let cut_all = |channels: &Vec<Vec<f64>>| channels.iter().map(cut).collect();
        let shifted = |ranges: &Vec<Range<f64>>| -> Vec<Range<f64>> {
            let ranges = ranges.iter();
            let ranges = ranges.map(|range| (range.start - from).max(0.0)..range.end - from);
            ranges
                .filter(|range| range.start < range.end && range.start < seconds)
                .collect()
        };
        let mut part = Self {
            time: cut(&self.time),
            q: cut_all(&self.q),
            dq: cut_all(&self.dq),
            tau: cut_all(&self.tau),
            holes: shifted(&self.holes),
            clipped: self.clipped.iter().map(shifted).collect(),
            ..self.clone()
        };
        for channel in &mut part.extra {
            channel.values = cut(&channel.values);
        }
        Some(part)
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use super::*;

    #[test]
    fn the_middle_has_its_own_holes() {
        let mut text = String::from("time,q1,tau1\n");
        for k in 0..1001 {
            let time = 0.01 * f64::from(k) + 5.0;
            writeln!(text, "{time},{k},{}", 2 * k).expect("a string takes all");
        }
        let mut log = Log::from_reader("log.csv", text.as_bytes(), 1).expect("a log");
        log.holes = vec![1.0..2.0, 3.5..4.5, 5.0..5.5, 9.0..9.5];
        log.clipped = vec![vec![3.0..7.0]];
        assert_eq!(log.middle(10.0), None);
        let middle = log.middle(2.0).expect("shorter");
        assert!((middle.time[0] - 9.0).abs() < 0.011, "{}", middle.time[0]);
        assert!((middle.seconds() - 2.0).abs() < 0.021);
        let first = middle.q[0][0];
        assert!((first - 400.0).abs() < 1.5 && (middle.tau[0][0] - 2.0 * first).abs() < 1e-9);
        let [first, second] = middle.holes.as_slice() else {
            panic!("{:?}", middle.holes);
        };
        assert!(first.start.abs() < 1e-9 && (first.end - 0.5).abs() < 0.011);
        assert!((second.start - 1.0).abs() < 0.011 && (second.end - 1.5).abs() < 0.011);
        assert!(middle.clipped[0][0].start.abs() < 1e-9);
    }
}
