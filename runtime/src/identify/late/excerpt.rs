//! What of long logs is asked whether channels are late.

use crate::log::Log;

/// What of a log is asked, s: more of it makes no delay surer than it has to be, and takes as many times as long.
pub(super) const LONGEST: f64 = 60.0;

/// A joint of an excerpt goes at least this share of the way, in the same time, that it goes in all of the log.
const MOVES: f64 = 0.5;

/// Ways of the joints a second.
fn ways(log: &Log) -> impl Iterator<Item = f64> + '_ {
    let way = |q: &Vec<f64>| {
        q.windows(2)
            .map(|pair| (pair[1] - pair[0]).abs())
            .sum::<f64>()
    };
    log.q.iter().map(move |q| way(q) / log.seconds())
}

/// The middle of a log that is long, where no joint rests more than elsewhere.
fn excerpt(log: &Log) -> Option<Log> {
    let middle = log.middle(LONGEST)?;
    let moves = ways(&middle)
        .zip(ways(log))
        .all(|(own, all)| own >= MOVES * all);
    moves.then_some(middle)
}

/// Excerpts of logs, where there are any.
pub(super) fn excerpts(logs: &[Log]) -> Option<Vec<Log>> {
    let middles: Vec<Option<Log>> = logs.iter().map(excerpt).collect();
    let is_any = middles.iter().any(Option::is_some);
    let pairs = middles.into_iter().zip(logs);
    is_any.then(|| {
        pairs
            .map(|(middle, log)| middle.unwrap_or_else(|| log.clone()))
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 200 s at 10 Hz; the second joint rests in some of it.
    fn log(rests: std::ops::Range<f64>) -> Log {
        let time: Vec<f64> = (0..=2000).map(|k| 0.1 * f64::from(k)).collect();
        let wave = |t: &f64| (0.7 * t).sin();
        let resting = |t: &f64| if rests.contains(t) { 0.0 } else { wave(t) };
        let q = vec![
            time.iter().map(wave).collect(),
            time.iter().map(resting).collect(),
        ];
        let tau = vec![time.clone(); 2];
        Log::from_samples("log", time, q, tau).expect("a log")
    }

    #[test]
    fn the_middle_stands_for_a_log_where_all_joints_move_in_it() {
        assert!(excerpts(&[log(0.0..60.0)]).is_some());
        assert!(excerpts(&[log(80.0..120.0)]).is_none());
        // One of two is cut, and the other is as it was.
        let both = [log(0.0..1.0), log(80.0..120.0)];
        let found = excerpts(&both).expect("one is cut");
        assert!((found[0].seconds() - LONGEST).abs() < 0.2);
        assert_eq!(found[1], both[1]);
    }
}
