//! What of a log is asked for another reading.

use robot_model::log::Log;

/// What of the first log is asked, s and Hz: more says no more of units and orders, and less leaves what dry friction does between samples.
const LONGEST: f64 = 60.0;
const FASTEST: f64 = 250.0;

/// The beginning of a log, at a rate that motions need.
pub(super) fn excerpt(log: &Log) -> Log {
    let mut log = log.clone();
    let rate = log.rate_hz();
    let slower = 2..log.time.len();
    let every = slower.take_while(|every| rate >= FASTEST * *every as f64);
    let every = every.last().unwrap_or(1);
    let samples = log
        .time
        .partition_point(|time| time - log.time[0] < LONGEST);
    let thin = |values: &mut Vec<f64>| {
        values.truncate(samples);
        *values = values.iter().step_by(every).copied().collect();
    };
    thin(&mut log.time);
    let extra = log.extra.iter_mut().map(|channel| &mut channel.values);
    let columns = log.q.iter_mut().chain(&mut log.dq).chain(&mut log.tau);
    columns.chain(extra).for_each(thin);
    log
}
