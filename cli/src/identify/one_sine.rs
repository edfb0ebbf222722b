//! Motions along one sine, which part parameters by little.

use std::f64::consts::TAU;

use robot_model::log::Log;

/// Share of a position's mean square, about its mean, that one sine has where a joint moves along it.
const ALONG: f64 = 0.97;

/// Share by which frequencies of joints may differ and be one.
const ONE: f64 = 0.05;

/// Rad or m from where on a joint moves.
const MOVES: f64 = 0.05;

/// What is looked at of a log, s, how many samples a second of it, and up to which frequency, Hz.
const LOOKED_AT: f64 = 60.0;
const RATE: f64 = 20.0;
const HIGHEST: f64 = 5.0;

/// Frequencies for the width of a line.
const FINE: f64 = 4.0;

/// That all joints of an arm with several go along one sine in all logs.
pub(super) fn doubt(logs: &[Log]) -> Option<String> {
    let all: Vec<f64> = logs
        .iter()
        .map(frequencies)
        .collect::<Option<Vec<_>>>()?
        .concat();
    let is_one = |other: &f64| (other - all[0]).abs() < ONE * all[0];
    (all.len() > logs.len() && all.iter().all(is_one)).then(|| {
        format!(
            "all joints move along one sine, of {:.2} Hz: only small harmonics of it tell many parameters apart, and what little a model or a \
             filter is off by may be several deviations of these; move at several frequencies (`excite` makes such a motion)",
            all[0]
        )
    })
}

/// The frequency of every joint that moves; none where one does not go along a sine.
fn frequencies(log: &Log) -> Option<Vec<f64>> {
    let looked_at = looked_at(log);
    let of = |values: &Vec<f64>| -> Option<Vec<f64>> {
        let some: Vec<f64> = looked_at.iter().map(|&k| values[k]).collect();
        let low = some.iter().copied().fold(f64::INFINITY, f64::min);
        let high = some.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mean = some.iter().sum::<f64>() / some.len() as f64;
        (high - low > MOVES).then(|| some.iter().map(|q| q - mean).collect())
    };
    let joints: Vec<Vec<f64>> = log.q.iter().filter_map(of).collect();
    let [first, .., last] = looked_at[..] else {
        return None;
    };
    let seconds = log.time[last] - log.time[first];
    lines(&joints, (looked_at.len() - 1) as f64 / seconds)
}

/// Samples of the middle of a log, about so many a second.
fn looked_at(log: &Log) -> Vec<usize> {
    let middle = log.time[0] + 0.5 * log.seconds();
    let mut next = f64::NEG_INFINITY;
    let samples = log.time.iter().enumerate().filter(|(_, time)| {
        let is_one = (*time - middle).abs() < 0.5 * LOOKED_AT && **time >= next;
        if is_one {
            next = **time + 0.999 / RATE;
        }
        is_one
    });
    samples.map(|(k, _)| k).collect()
}

/// The same of positions about their means.
fn lines(joints: &[Vec<f64>], rate: f64) -> Option<Vec<f64>> {
    let samples = joints.first()?.len() as f64;
    let step = rate / samples / FINE;
    let highest = HIGHEST.min(rate / 4.0);
    let tried = (0..).map(|k| (FINE + f64::from(k)) * step);
    let mut best = vec![(0.0, 0.0); joints.len()];
    for frequency in tried.take_while(|frequency| *frequency < highest) {
        let waves = (0..joints[0].len()).map(|k| (TAU * frequency * k as f64 / rate).sin_cos());
        let waves: Vec<(f64, f64)> = waves.collect();
        for (best, q) in best.iter_mut().zip(joints) {
            let share = share(q, &waves);
            if share > best.0 {
                *best = (share, frequency);
            }
        }
    }
    let is_along = best.iter().all(|(share, _)| *share > ALONG);
    is_along.then(|| best.into_iter().map(|(_, frequency)| frequency).collect())
}

/// Share of the squares of a series that the nearest sum of a sine and a cosine has.
fn share(q: &[f64], waves: &[(f64, f64)]) -> f64 {
    let mut sums = [0.0; 6];
    for (q, (sin, cos)) in q.iter().zip(waves) {
        for (sum, term) in
            sums.iter_mut()
                .zip([sin * sin, sin * cos, cos * cos, sin * q, cos * q, q * q])
        {
            *sum += term;
        }
    }
    let [ss, sc, cc, sq, cq, qq] = sums;
    let determinant = ss * cc - sc * sc;
    (sq * (cc * sq - sc * cq) + cq * (ss * cq - sc * sq)) / (determinant * qq)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two joints over 15 s at 20 Hz.
    fn moved(q: impl Fn(f64) -> [f64; 2]) -> Vec<Vec<f64>> {
        let times: Vec<f64> = (0..300).map(|k| f64::from(k) / 20.0).collect();
        let joint = |joint: usize| -> Vec<f64> {
            let q: Vec<f64> = times.iter().map(|t| q(*t)[joint]).collect();
            let mean = q.iter().sum::<f64>() / 300.0;
            q.iter().map(|q| q - mean).collect()
        };
        vec![joint(0), joint(1)]
    }

    #[test]
    fn one_sine_of_all_joints_is_found_and_several_are_not() {
        let one = moved(|t| {
            [
                0.4 * (1.3 * t).sin() + 0.02 * (3.9 * t).sin(),
                (1.3 * t + 0.4).cos(),
            ]
        });
        let found = lines(&one, 20.0).expect("a sine");
        assert!(
            found.iter().all(|f| (TAU * f / 1.3 - 1.0).abs() < ONE),
            "{found:?}"
        );
        // Harmonics of a third.
        assert_eq!(
            lines(
                &moved(|t| [(1.3 * t).sin() + 0.3 * (3.9 * t).sin(), (1.3 * t).cos()]),
                20.0
            ),
            None
        );
    }
}
