//! Motions along one sine, which part parameters by little.

use std::f64::consts::TAU;

use robot_model::identify::Estimate;
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

/// Frequencies for the width of a line: halfway between two of them a sine has less than a hundredth less.
const FINE: f64 = 16.0;

/// Condition number from where on columns hang on little; a sine tells mass and friction of axes that move each for itself well.
const CONDITION: f64 = 50.0;

/// That all joints that move, two and more, go along one sine in all logs.
pub(super) fn doubt(estimate: &Estimate, logs: &[Log]) -> Option<String> {
    if estimate.condition < CONDITION {
        return None;
    }
    let all: Vec<f64> = logs
        .iter()
        .map(frequencies)
        .collect::<Option<Vec<_>>>()?
        .concat();
    let is_one = |other: &f64| (other - all[0]).abs() < ONE * all[0];
    (all.len() > logs.len() && all.iter().all(is_one)).then(|| {
        format!(
            "all moving joints follow one sine of {:.2} Hz: only its small harmonics separate many parameters, so a small error of the \
             model or a filter may shift these by several standard deviations; move at several frequencies (`excite` designs such a motion)",
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

/// The same of positions at so many samples a second.
fn lines(joints: &[Vec<f64>], rate: f64) -> Option<Vec<f64>> {
    let samples = joints.first()?.len() as f64;
    let step = rate / samples / FINE;
    let highest = HIGHEST.min(rate / 4.0);
    let tried = (0..).map(|k| (FINE + f64::from(k)) * step);
    let mut best = vec![(0.0, 0.0); joints.len()];
    for frequency in tried.take_while(|frequency| *frequency < highest) {
        let waves = centered(joints[0].len(), TAU * frequency / rate);
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

/// Sine and cosine, rad from sample to sample, about their means.
fn centered(samples: usize, step: f64) -> Vec<(f64, f64)> {
    let mut waves: Vec<(f64, f64)> = (0..samples).map(|k| (step * k as f64).sin_cos()).collect();
    let count = samples as f64;
    let sums = waves
        .iter()
        .fold((0.0, 0.0), |sums, wave| (sums.0 + wave.0, sums.1 + wave.1));
    for wave in &mut waves {
        wave.0 -= sums.0 / count;
        wave.1 -= sums.1 / count;
    }
    waves
}

/// Share of the squares of a series about its mean that the nearest sum of a sine and a cosine has.
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

    /// Of any frequency from one and a half periods of the log on.
    #[test]
    fn one_sine_of_all_joints_is_found() {
        for k in 0..60 {
            let w = TAU * (0.1 + 0.013 * f64::from(k));
            let one = moved(|t| {
                [
                    0.4 * (w * t).sin() + 0.02 * (3.0 * w * t).sin(),
                    (w * t + 0.4).cos(),
                ]
            });
            let found = lines(&one, 20.0).unwrap_or_else(|| panic!("{w} rad/s"));
            assert!(
                found.iter().all(|f| (TAU * f / w - 1.0).abs() < ONE),
                "{found:?} for {w}"
            );
        }
    }

    #[test]
    fn harmonics_of_a_third_are_no_sine() {
        let several = moved(|t| [(1.3 * t).sin() + 0.3 * (3.9 * t).sin(), (1.3 * t).cos()]);
        assert_eq!(lines(&several, 20.0), None);
    }
}
