//! What deviations lack of logs that are short beside their noise.
//!
//! An estimate takes some of the noise for parameters, the slow part above all, so residuals have too little of it, and an autoregression through
//! a few independent samples is itself unsure. Both are seen where the truth is known: noise is drawn from the autoregressions that were
//! found, the estimate takes its share, and what is told of the rest is compared with what is so. A parameter's variance is larger than what is
//! told by the mean of `so / told`, as the square of an error over its told deviation is. Noise that is drawn from what was found is the parametric
//! bootstrap of Efron, Tibshirani 1993, chapter 6.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::autoregression::Autoregression;
use crate::signal::resample::whole_steps;

/// Draws of noise, at least and at most, and operations that they may take together.
const DRAWS: [usize; 2] = [4, 16];
const WORK: f64 = 1e9;

/// Of what variances lack: with one or two independent samples the mean has no end, and a single draw would say how much.
const MOST: f64 = 10.0;

/// Logs with more independent samples of each joint for a parameter lack nothing.
const ENOUGH: f64 = 100.0;

/// The noise of a joint.
pub(super) struct Noise {
    /// What a unit of noise moves the estimate by, parameter by parameter, none where nothing does.
    weights: Vec<Vec<f64>>,
    law: Autoregression,
    samples: usize,
    /// Independent ones of them.
    independent: f64,
}

impl Noise {
    /// Of residuals, with what a unit of noise in place of each moves the estimate by.
    pub fn new(mut weights: Vec<Vec<f64>>, residuals: &[f64]) -> Self {
        for weights in &mut weights {
            if weights.iter().all(|weight| *weight == 0.0) {
                weights.clear();
            }
        }
        let law = Autoregression::through(residuals);
        let samples = residuals.len();
        let power: f64 = residuals.iter().map(|r| r * r).sum();
        let sum = law.variance_of_sum(&vec![1.0; samples]);
        Self {
            weights,
            // Noise that cancels has no more of them than it has samples.
            independent: samples as f64 * (power / sum.max(f64::MIN_POSITIVE)).min(1.0),
            samples,
            law,
        }
    }

    /// What noise moves the estimate by, added to what that of other joints does.
    pub fn add_step(&self, noise: &[f64], step: &mut [f64]) {
        for (step, weights) in step.iter_mut().zip(&self.weights) {
            let products = weights.iter().zip(noise);
            *step += products.map(|(weight, x)| weight * x).sum::<f64>();
        }
    }

    /// Of parameters, as far as noise of a law makes it.
    fn variances(&self, law: &Autoregression) -> Vec<f64> {
        let mut variances = vec![0.0; self.weights.len()];
        let some = self.weights.iter().enumerate();
        let some = some.filter(|(_, weights)| !weights.is_empty());
        let (places, some): (Vec<usize>, Vec<&[f64]>) =
            some.map(|(k, weights)| (k, weights.as_slice())).unzip();
        for (k, variance) in places.into_iter().zip(law.variances_of_sums(&some)) {
            variances[k] = variance;
        }
        variances
    }
}

/// Variances of what noise makes of an estimate, parameter by parameter.
pub(super) fn variances(noise: &[Noise], parameters: usize) -> Vec<f64> {
    let laws = noise.iter().map(|noise| (noise, &noise.law));
    sums(laws, parameters)
}

/// Sums over joints, whose noise each is of a law.
fn sums<'a>(
    laws: impl Iterator<Item = (&'a Noise, &'a Autoregression)>,
    parameters: usize,
) -> Vec<f64> {
    let mut sums = vec![0.0; parameters];
    for (noise, law) in laws {
        let variances = noise.variances(law);
        sums.iter_mut()
            .zip(variances)
            .for_each(|(sum, x)| *sum += x);
    }
    sums
}

/// By how much more variances are than what noise says of them, parameter by parameter; 1 where logs are long. `so` are those of that
/// noise, and `freedom` by how much larger they are told for the unknowns that were fitted. `rest` is what an estimate leaves of noise of the
/// joints.
pub(super) fn shortfalls(
    noise: &[Noise],
    so: &[f64],
    freedom: f64,
    rest: impl Fn(&[Vec<f64>]) -> Vec<Vec<f64>>,
) -> Vec<f64> {
    let count = so.len();
    let joints = noise.iter().filter(|noise| noise.samples > 0);
    let joints: Vec<f64> = joints.map(|noise| noise.independent).collect();
    let few = joints.iter().copied().fold(f64::INFINITY, f64::min);
    if few * joints.len() as f64 > ENOUGH * count as f64 {
        return vec![1.0; count];
    }
    let work = |noise: &Noise| {
        let weights: usize = noise.weights.iter().map(Vec::len).sum();
        weights as f64 * Autoregression::orders(noise.samples)
    };
    let work: f64 = noise.iter().map(work).sum();
    let draws = whole_steps((WORK / work.max(1.0)).min(DRAWS[1] as f64)).max(DRAWS[0]);
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut lack = vec![Vec::with_capacity(draws); count];
    for _ in 0..draws {
        let drawn: Vec<Vec<f64>> = noise
            .iter()
            .map(|noise| noise.law.drawn(noise.samples, &mut random))
            .collect();
        let told: Vec<Autoregression> = rest(&drawn)
            .iter()
            .map(|rest| Autoregression::through(rest))
            .collect();
        let told = sums(noise.iter().zip(&told), count);
        for ((lack, told), so) in lack.iter_mut().zip(told).zip(so) {
            lack.push(if told > 0.0 {
                so / (freedom * told)
            } else {
                1.0
            });
        }
    }
    let mean = |lack: Vec<f64>| {
        let mean = lack.iter().sum::<f64>() / draws as f64;
        mean.clamp(1.0, MOST)
    };
    lack.into_iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::columns::Unknown;
    use crate::identify::{Identify, JointRows, Segment, Stack};

    const ROWS: u32 = 400;
    const SHARE: f64 = 0.95;
    const UNKNOWNS: usize = 6;

    /// Slow waves, and noise that is alike over 40 samples: ten independent ones for six unknowns.
    fn stack(seed: u64) -> Stack {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut state = 0.0;
        let mut noise = || {
            let fresh: f64 = StandardNormal.sample(&mut random);
            state = SHARE * state + fresh;
            state
        };
        for _ in 0..200 {
            noise();
        }
        let target: Vec<f64> = (0..ROWS).map(|_| noise()).collect();
        let wave = |c: usize| -> Vec<f64> {
            let (rate, phase) = (0.02 * (c / 2 + 1) as f64, (c % 2) as f64 * 1.6);
            (0..ROWS)
                .map(|k| (rate * f64::from(k) + phase).sin())
                .collect()
        };
        Stack {
            unknowns: (0..UNKNOWNS)
                .map(|c| Unknown {
                    name: format!("p{c}"),
                    nonnegative: false,
                })
                .collect(),
            joints: vec![JointRows {
                tau: target.clone(),
                target,
                columns: (0..UNKNOWNS).map(|c| (c, wave(c))).collect(),
            }],
            segments: vec![Segment {
                start: 0,
                time: Vec::new(),
            }],
            ..Stack::default()
        }
    }

    #[test]
    fn intervals_hold_the_truth_where_noise_is_alike_for_a_tenth_of_a_log() {
        const DRAWS: u32 = 150;
        let identify = Identify::default();
        let mut held = [0.0; 2];
        for seed in 0..DRAWS {
            let stack = stack(u64::from(seed));
            let solution = identify.solve_stack(&stack).expect("samples enough");
            let std = identify.deviations(&stack, &solution);
            // The truth is zero.
            let products = identify.deviations_of_products(&stack, &solution);
            for (held, std) in held.iter_mut().zip([std, products]) {
                let pairs = solution.estimate.iter().zip(&std);
                *held += pairs.filter(|(x, std)| x.abs() < 1.96 * **std).count() as f64;
            }
        }
        let [with, without] = held.map(|held| held / f64::from(DRAWS) / UNKNOWNS as f64);
        assert!((0.9..=0.98).contains(&with), "{with}");
        // That is what it is for.
        assert!(without < 0.8, "{without}");
    }

    /// Thirty unknowns in a hundred rows of white noise: what they took counts once.
    #[test]
    fn what_many_unknowns_take_of_white_noise_counts_once() {
        const DRAWS: u32 = 40;
        let identify = Identify::default();
        let (mut told, mut so) = (0.0, 0.0);
        for seed in 0..DRAWS {
            let mut random = ChaCha8Rng::seed_from_u64(u64::from(seed));
            let mut series = || -> Vec<f64> {
                (0..100)
                    .map(|_| StandardNormal.sample(&mut random))
                    .collect()
            };
            let columns: Vec<(usize, Vec<f64>)> = (0..30).map(|c| (c, series())).collect();
            let mut white = stack(0);
            let unknown = white.unknowns[0].clone();
            white.unknowns = vec![unknown; columns.len()];
            let target = series();
            white.joints = vec![JointRows {
                tau: target.clone(),
                target,
                columns,
            }];
            let solution = identify.solve_stack(&white).expect("samples enough");
            let std = identify.deviations(&white, &solution);
            told += std.iter().map(|std| std * std).sum::<f64>();
            so += solution.estimate.iter().map(|x| x * x).sum::<f64>();
        }
        // The larger of two variances, of which one is off by a third; with what was taken counted twice it would be 1.4.
        let ratio = (told / so).sqrt();
        assert!((0.95..1.3).contains(&ratio), "{ratio}");
    }
}
