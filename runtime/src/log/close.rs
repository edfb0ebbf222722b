//! Samples that nearly coincide in time.

use std::ops::Range;

use super::{Log, Note};

/// Time stamps that are within this share of the median step are one: a curve through values so near to each other has the slope of their
/// noise, and is far from all others beside them.
const CLOSE: f64 = 0.3;

/// Whether a sample is the one before once more, as recorders of two sources write it.
pub(super) fn is_again(log: &Log, sample: usize) -> bool {
    let channels = log.q.iter().chain(&log.dq).chain(&log.tau);
    let mut all = channels.chain(log.extra.iter().map(|channel| &channel.values));
    #[expect(clippy::float_cmp, reason = "the same digits were read twice")]
    all.all(|values| values[sample] == values[sample - 1])
}

/// Makes one sample of those that nearly coincide, their mean; says which line each sample has now.
pub(super) fn merge(log: &mut Log, lines: Option<&[u64]>, median: f64) -> Option<Vec<u64>> {
    let mut groups: Vec<Range<usize>> = Vec::new();
    for (k, time) in log.time.iter().enumerate() {
        match groups.last_mut() {
            Some(group) if time - log.time[group.start] < CLOSE * median => group.end = k + 1,
            _ => groups.push(k..k + 1),
        }
    }
    let Some(first) = groups.iter().find(|group| group.len() > 1) else {
        return lines.map(<[u64]>::to_vec);
    };
    log.report.push(Note::Coincident {
        samples: log.time.len() - groups.len(),
        first: log.time[first.start + 1],
    });
    let means = |values: &[f64]| -> Vec<f64> {
        let mean =
            |group: &Range<usize>| values[group.clone()].iter().sum::<f64>() / group.len() as f64;
        groups.iter().map(mean).collect()
    };
    log.time = means(&log.time);
    for channel in log.channels_mut() {
        *channel = means(channel);
    }
    let firsts = groups.iter().map(|group| group.start);
    let of_samples = |lines: &[u64]| firsts.map(|k| lines[k]).collect();
    lines.map(of_samples)
}
