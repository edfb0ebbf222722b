//! Samples that a recorder lost.

use super::faults::BRIDGED_S;
use super::limits::check_unit;
use super::{Log, LogError, Lost, Note, Stretches};
use crate::signal::resample::whole_steps;

/// A step longer than this many median steps is a gap, however time stamps jitter.
const GAP_STEPS: f64 = 5.0;

/// The longest gap that is filled, s, and the share of the log that all may take: what the arm did inside them is not known.
const LONGEST_S: f64 = 0.5;
const SHARE: f64 = 0.05;

/// Where time stamps are regular so many are one: they are so where all steps but this share are whole median steps to within this part of one.
const LEAST_STEPS: f64 = 1.5;
const FEW: f64 = 0.01;
const WHOLE: f64 = 0.05;

/// Samples that are missing behind one.
struct Gap {
    last: usize,
    /// How many, and how long they would be.
    count: usize,
    seconds: f64,
}

/// Puts samples into gaps, on straight lines, and holes over those that are long; says which line each sample has now.
pub(super) fn fill(
    log: &mut Log,
    lines: Option<&[u64]>,
    lost: &Lost,
    median: f64,
) -> Result<Option<Vec<u64>>, LogError> {
    let start = log.time[0];
    let steps: Vec<f64> = log.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let all = log.seconds();
    let of = |least: f64| {
        let long = steps.iter().enumerate();
        let long = long.filter(|(_, step)| **step > least * median);
        let gaps = long.map(|(last, step)| Gap {
            last,
            count: whole_steps((step / median).round()) - 1,
            seconds: step - median,
        });
        gaps.collect::<Vec<Gap>>()
    };
    let is_short = |gaps: &[Gap]| {
        let missing: f64 = gaps.iter().map(|gap| gap.seconds).sum();
        missing <= SHARE * all && gaps.iter().all(|gap| gap.seconds <= LONGEST_S)
    };
    let odd = |step: &&f64| (*step / median - (*step / median).round()).abs() > WHOLE;
    let is_regular = steps.iter().filter(odd).count() as f64 <= FEW * steps.len() as f64;
    let single = Some(of(LEAST_STEPS)).filter(|gaps| is_regular && is_short(gaps));
    let gaps = single.unwrap_or_else(|| of(GAP_STEPS));
    let longest = gaps.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let Some(longest) = longest else {
        return Ok(lines.map(<[u64]>::to_vec));
    };
    if !is_short(&gaps) {
        // Steps in another unit are longer than any gap may be.
        check_unit(&log.source, 1.0 / median)?;
        let last = longest.last;
        // A gap is none in the file where its rows hold no numbers.
        let without = lines.and_then(|lines| lost.between(lines[last], lines[last + 1]));
        if let Some(error) = without {
            return Err(error.clone());
        }
        if gaps.len() > 1 && longest.seconds <= LONGEST_S {
            return Err(LogError::Gaps {
                source_name: log.source.clone(),
                times: gaps.len(),
                seconds: gaps.iter().map(|gap| gap.seconds).sum(),
                all,
                first: log.time[gaps[0].last],
                most: 100.0 * SHARE,
            });
        }
        return Err(LogError::Gap {
            place: log.place(last + 1, lines),
            time: log.time[last + 1],
            previous: log.time[last],
            steps: steps[last] / median,
        });
    }
    let at = Stretches {
        times: gaps.len(),
        samples: gaps.iter().map(|gap| gap.count).sum(),
        first: log.time[gaps[0].last] + median,
        longest: longest.seconds,
    };
    log.report.push(Note::Gaps { at });
    for gap in gaps.iter().filter(|gap| gap.seconds > BRIDGED_S) {
        let end = log.time[gap.last + 1] - start;
        log.holes.push(end - gap.seconds..end);
    }
    log.time = filled(&log.time, &gaps);
    for channel in log.channels_mut() {
        *channel = filled(channel, &gaps);
    }
    let of_samples = |lines: &[u64]| {
        let mut gaps = gaps.iter().peekable();
        let numbered = lines.iter().enumerate().flat_map(|(k, line)| {
            let behind = gaps.next_if(|gap| gap.last == k);
            std::iter::repeat_n(*line, 1 + behind.map_or(0, |gap| gap.count))
        });
        numbered.collect()
    };
    Ok(lines.map(of_samples))
}

/// Values with those that are missing, on straight lines.
fn filled(values: &[f64], gaps: &[Gap]) -> Vec<f64> {
    let mut filled = Vec::with_capacity(values.len());
    let mut start = 0;
    for gap in gaps {
        filled.extend_from_slice(&values[start..=gap.last]);
        let (low, high) = (values[gap.last], values[gap.last + 1]);
        let part = |k: usize| k as f64 / (gap.count + 1) as f64;
        filled.extend((1..=gap.count).map(|k| low + (high - low) * part(k)));
        start = gap.last + 1;
    }
    filled.extend_from_slice(&values[start..]);
    filled
}
