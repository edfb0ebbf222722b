//! Logged velocities against the slopes of positions.

use super::Fault;
use crate::log::Log;

/// Delays that are looked for, s.
const LONGEST: f64 = 0.5;

/// How alike both have to be at their best to be compared at all.
const ALIKE: f64 = 0.8;

/// What is told: delays from so many samples and seconds on, factors from this far off one.
const SAMPLES: f64 = 1.5;
const SECONDS: f64 = 2e-3;
const FACTOR: f64 = 0.1;

/// By which share a delay has to lessen what differs.
const BETTER: f64 = 0.5;

pub(super) fn find(log: &Log) -> Vec<Fault> {
    let step = 1.0 / log.rate_hz();
    let most =
        crate::signal::resample::whole_steps((LONGEST / step).min(log.time.len() as f64 / 4.0));
    let mut faults = Vec::new();
    for (joint, (q, dq)) in log.q.iter().zip(&log.dq).enumerate() {
        let channel = format!("dq{}", joint + 1);
        let slope: Vec<f64> = (0..q.len())
            .map(|k| {
                let (before, behind) = (k.saturating_sub(1), (k + 1).min(q.len() - 1));
                (q[behind] - q[before]) / (step * (behind - before) as f64)
            })
            .collect();
        let Some(found) = Match::new(&slope, dq, most) else {
            continue;
        };
        let delay = found.delay * step;
        let is_better = 1.0 - found.alike.abs() < BETTER * (1.0 - found.now.abs());
        if delay.abs() > (SAMPLES * step).max(SECONDS) && is_better {
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

/// Where two series are most alike.
struct Match {
    /// By how many samples the second is late.
    delay: f64,
    /// Correlation there, and without a delay.
    alike: f64,
    now: f64,
    /// Second over first.
    factor: f64,
}

impl Match {
    /// The middle of both, so that all delays are over the same samples of the first.
    fn new(first: &[f64], second: &[f64], most: usize) -> Option<Self> {
        let inner = most..first.len().checked_sub(most)?;
        let x = &first[inner.clone()];
        let power: f64 = x.iter().map(|x| x * x).sum();
        let at = |shift: usize| -> (f64, f64) {
            let y = &second[shift..shift + x.len()];
            let product: f64 = x.iter().zip(y).map(|(x, y)| x * y).sum();
            (product, y.iter().map(|y| y * y).sum())
        };
        let products: Vec<(f64, f64)> = (0..=2 * most).map(at).collect();
        let alike = |&(product, other): &(f64, f64)| {
            let size = (power * other).sqrt();
            if size > 0.0 { product / size } else { 0.0 }
        };
        let alikes: Vec<f64> = products.iter().map(alike).collect();
        let best =
            (0..alikes.len()).max_by(|&a, &b| alikes[a].abs().total_cmp(&alikes[b].abs()))?;
        if alikes[best].abs() < ALIKE {
            return None;
        }
        // The top of the parabola through the best and both beside it.
        let beside = |k: Option<usize>| k.and_then(|k| alikes.get(k)).map_or(0.0, |x| x.abs());
        let (low, top, high) = (
            beside(best.checked_sub(1)),
            alikes[best].abs(),
            beside(Some(best + 1)),
        );
        let bend = low - 2.0 * top + high;
        let part = if bend < 0.0 {
            0.5 * (low - high) / bend
        } else {
            0.0
        };
        let (product, other) = products[best];
        Some(Self {
            delay: best as f64 - most as f64 + part.clamp(-0.5, 0.5),
            alike: alikes[best],
            now: alikes[most],
            // Noise is in the slope of a position, less in a logged velocity.
            factor: other / product,
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
        return ", the other way round";
    }
    let named = NAMED
        .iter()
        .find(|(value, _)| (factor.abs() / value - 1.0).abs() < 0.05);
    named.map_or("", |(_, name)| name)
}
