//! Time stamps as logged to a uniform grid.

use super::{Log, LogError, Lost, Note, close, gaps};
use crate::signal::resample;

/// Time stamps within this share of a step of a uniform grid are uniform: rounding in the file is not jitter.
const UNIFORM_SHARE: f64 = 0.01;

/// Rows run backwards, or stamps are rounded, where so many steps fall, or are nothing.
const MOST: f64 = 0.9;
const MANY: f64 = 0.1;

/// What is to be done about time that does not rise everywhere.
fn way_out(steps: &[f64]) -> &'static str {
    let share = |is: &dyn Fn(f64) -> bool| {
        let count = steps.iter().filter(|step| is(**step)).count();
        count as f64 / steps.len() as f64
    };
    if share(&|step| step < 0.0) > MOST {
        "the rows run backwards: sort them by time"
    } else if share(&|step| step == 0.0) > MANY {
        "many rows have the time of the row before: write time stamps with more digits"
    } else {
        "remove the row if it is a duplicate, or split the log here and give both parts"
    }
}

/// Refuses time that does not rise, but for rows that are there again, or has long gaps, fills short ones, makes one sample of those that nearly
/// coincide, and moves all channels onto a uniform grid where they are not on one.
pub(super) fn make_uniform(
    log: &mut Log,
    lines: Option<&[u64]>,
    lost: &Lost,
) -> Result<(), LogError> {
    let time = &log.time;
    let place = |sample: usize| log.place(sample, lines);
    let steps: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    // Rows that are there again are no steps.
    let rising: Vec<f64> = steps.iter().copied().filter(|step| *step > 0.0).collect();
    let falls = |k: &usize| steps[*k] < 0.0 || steps[*k] == 0.0 && !close::is_again(log, *k + 1);
    let stands = rising.is_empty().then_some(0);
    if let Some(k) = (0..steps.len()).find(falls).or(stands) {
        return Err(LogError::TimeOrder {
            place: place(k + 1),
            time: time[k + 1],
            previous: time[k],
            way_out: way_out(&steps),
        });
    }
    let median = median(&rising);
    let logged = log.time.len();
    let lines = close::merge(log, lines, median);
    let lines = gaps::fill(log, lines.as_deref(), lost, median)?;
    let time = &log.time;
    let steps: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let count = time.len();
    let mean = (time[count - 1] - time[0]) / (count - 1) as f64;
    let off_grid = |k: usize| (time[k] - time[0] - mean * k as f64).abs();
    if (0..count).all(|k| off_grid(k) <= UNIFORM_SHARE * mean) {
        log.time = resample::grid(time[0], mean, count);
        return Ok(());
    }

    let jitter = |step: f64| (step - median).abs();
    let worst = (0..steps.len()).fold(0, |worst, k| {
        if jitter(steps[k]) > jitter(steps[worst]) {
            k
        } else {
            worst
        }
    });
    let sum_of_squares: f64 = steps.iter().map(|&step| jitter(step).powi(2)).sum();
    // A millionth of a step is what rounding may take from the last sample.
    let resampled = resample::whole_steps((time[count - 1] - time[0]) / median + 1e-6) + 1;
    log.report.push(Note::Resampled {
        logged,
        resampled,
        step: median,
        jitter_rms: (sum_of_squares / steps.len() as f64).sqrt(),
        jitter_max: jitter(steps[worst]),
        worst_line: lines.as_ref().map(|lines| lines[worst + 1]),
    });
    let grid = resample::grid(time[0], median, resampled);
    let stamps = std::mem::replace(&mut log.time, grid.clone());
    for channel in log.channels_mut() {
        *channel = resample::cubic(&stamps, channel, &grid);
    }
    Ok(())
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 {
        sorted[middle]
    } else {
        0.5 * (sorted[middle - 1] + sorted[middle])
    }
}

#[cfg(test)]
mod tests {
    use super::way_out;

    #[test]
    fn rows_that_run_backwards_and_rounded_stamps_have_their_way_out() {
        assert!(way_out(&[-0.1; 20]).starts_with("the rows run backwards"));
        let mut steps = vec![0.01; 20];
        steps[7] = 0.0;
        assert!(way_out(&steps).starts_with("remove the row"));
        for step in steps.iter_mut().step_by(2) {
            *step = 0.0;
        }
        assert!(way_out(&steps).starts_with("many rows have the time"));
    }
}
