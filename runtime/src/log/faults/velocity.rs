//! Logged velocities against the slopes of positions.

use super::{Fault, Steps};
use crate::log::Log;
use crate::signal::resample::whole_steps;

/// Delays that are looked for, s.
const LONGEST: f64 = 0.5;

/// Rate at which both are compared, Hz: means over samples, which encoders' steps leave alone.
const RATE_HZ: f64 = 200.0;

/// How alike both have to be at their best to be compared at all. Motions that come back are alike at several delays: what differs there
/// is at most so many times what differs at the best, and a little.
const ALIKE: f64 = 0.8;
const NEARLY: f64 = 1.5;
const LITTLE: f64 = 1e-3;

/// What is told: delays from so many samples and seconds on, factors from this far off one.
const SAMPLES: f64 = 1.5;
const SECONDS: f64 = 2e-3;
const FACTOR: f64 = 0.2;

/// By which share a delay has to lessen what differs, and how much has to differ.
const BETTER: f64 = 0.8;
const DIFFERS: f64 = 2e-3;

/// A joint moves where it goes over this many of the encoder's steps.
const MOVES: f64 = 20.0;

/// And over so much, rad or m: what couples into a joint that is held is no motion.
const LEAST: f64 = 1e-3;

pub(super) fn find(log: &Log) -> Vec<Fault> {
    let rate_hz = log.rate_hz();
    let block = whole_steps(rate_hz / RATE_HZ).max(1);
    let step = block as f64 / rate_hz;
    let mut faults = Vec::new();
    for (joint, (q, dq)) in log.q.iter().zip(&log.dq).enumerate() {
        let channel = format!("dq{}", joint + 1);
        let blocks = q.len().saturating_sub(1) / block;
        // Over the same samples: the way from first to last, and the mean with both ends half.
        let slope = |k: usize| (q[(k + 1) * block] - q[k * block]) / step;
        let mean = |k: usize| {
            let part = &dq[k * block..=(k + 1) * block];
            let ends = 0.5 * (part[0] + part[block]);
            (part.iter().sum::<f64>() - ends) / block as f64
        };
        let slope: Vec<f64> = (0..blocks).map(slope).collect();
        let mean: Vec<f64> = (0..blocks).map(mean).collect();
        let high = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = q.iter().copied().fold(f64::INFINITY, f64::min);
        if high - low <= LEAST.max(MOVES * Steps::of(q).quantum) {
            continue;
        }
        let most = whole_steps((LONGEST / step).min(blocks as f64 / 4.0));
        let Some(found) = Match::new(&slope, &mean, most) else {
            continue;
        };
        let delay = found.delay * step;
        let differs = 1.0 - found.now;
        let is_better = differs > DIFFERS && 1.0 - found.alike < BETTER * differs;
        if delay.abs() > (SAMPLES / rate_hz).max(SECONDS) && is_better && found.factor > 0.0 {
            faults.push(Fault::VelocityLate {
                channel: channel.clone(),
                delay,
            });
        }
        if (found.factor - 1.0).abs() > FACTOR {
            faults.push(Fault::VelocityScale {
                channel,
                factor: found.factor,
            });
        }
    }
    faults
}

/// Where two series are alike.
struct Match {
    /// By how many samples the second is late.
    delay: f64,
    /// Correlation there, and without a delay.
    alike: f64,
    now: f64,
    /// Second over first; below zero where one is the other backwards.
    factor: f64,
}

impl Match {
    /// The middle of both, so that all delays are over the same samples of the first. `None` where they are alike at no delay.
    fn new(first: &[f64], second: &[f64], most: usize) -> Option<Self> {
        let inner = most..first.len().checked_sub(most)?;
        let x = &first[inner];
        let power: f64 = x.iter().map(|x| x * x).sum();
        let part = |shift: usize| &second[shift..shift + x.len()];
        let size = |shift: usize| -> f64 { part(shift).iter().map(|y| y * y).sum() };
        let alike = |shift: usize| {
            let product: f64 = x.iter().zip(part(shift)).map(|(x, y)| x * y).sum();
            let size = (power * size(shift)).sqrt();
            if size > 0.0 { product / size } else { 0.0 }
        };
        let alikes: Vec<f64> = (0..=2 * most).map(alike).collect();
        let best = alikes.iter().copied().fold(0.0, f64::max);
        let now = alikes[most];
        let ratio = |shift: usize| (size(shift) / power).sqrt();
        let nearly = 1.0 - NEARLY * (1.0 - best) - LITTLE;
        if -now > ALIKE.max(nearly) {
            return Some(Self {
                delay: 0.0,
                alike: -now,
                now: -now,
                factor: -ratio(most),
            });
        }
        if best < ALIKE {
            return None;
        }
        // Tops of the correlation: the first at which the velocity is not early, or else the nearest.
        let at = |k: usize| alikes[k];
        let good = (0..alikes.len()).filter(|&k| {
            let lower = k == 0 || alikes[k - 1] <= at(k);
            let upper = k + 1 == alikes.len() || alikes[k + 1] <= at(k);
            lower && upper && at(k) > nearly
        });
        let early = |k: usize| k + 1 < most;
        let top = good.min_by_key(|&k| (early(k), k.abs_diff(most)))?;
        // The top of the parabola through it and both beside it.
        let beside = |k: Option<usize>| k.and_then(|k| alikes.get(k)).copied().unwrap_or(at(top));
        let (low, high) = (beside(top.checked_sub(1)), beside(Some(top + 1)));
        let bend = low - 2.0 * at(top) + high;
        let part = if bend < 0.0 {
            0.5 * (low - high) / bend
        } else {
            0.0
        };
        Some(Self {
            delay: top as f64 - most as f64 + part.clamp(-0.5, 0.5),
            alike: at(top),
            now,
            factor: ratio(top),
        })
    }
}

/// What a factor looks like.
pub(super) fn unit(factor: f64) -> &'static str {
    const NAMED: [(f64, &str); 4] = [
        (57.29578, ", as degrees are to radians"),
        (0.017_453_29, ", as radians are to degrees"),
        (9.549_297, ", as rpm are to rad/s"),
        (0.166_667, ", as rpm are to degrees per second"),
    ];
    if (factor + 1.0).abs() < 0.1 {
        return ", with the opposite sign";
    }
    let named = NAMED
        .iter()
        .find(|(value, _)| (factor.abs() / value - 1.0).abs() < 0.05);
    named.map_or("", |(_, name)| name)
}
