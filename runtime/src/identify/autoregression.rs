//! Series as autoregressions: what they add up to, and others like them.
//!
//! Burg's recursion follows slow noise over hundreds of samples and the noise of differences, that cancels from sample to sample, alike.
//! Source: Burg 1975, Maximum entropy spectral analysis.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::signal::resample::whole_steps;

/// Orders of an autoregression are up to this many times `log10(n)`, and up to one for so many samples.
const ORDERS: f64 = 10.0;
const SAMPLES_AN_ORDER: f64 = 8.0;

/// Weights whose sums are followed at once.
const ABREAST: usize = 8;

/// Samples that are drawn before those that count, at least.
const BEFORE: usize = 500;

/// Variance of the sum of a series, `n` times its spectral density at frequency zero: that of the autoregression which fits it best,
/// `sigma_e^2 / (1 - sum phi)^2`.
pub(crate) fn long_run_sum(series: &[f64]) -> f64 {
    let fitted = Autoregression::through(series);
    let gain = fitted.filter.iter().sum::<f64>();
    series.len() as f64 * fitted.error / (gain * gain)
}

/// `x_k - phi_1 x_(k-1) - .. = e_k`.
pub(crate) struct Autoregression {
    /// `1, -phi_1, ..`
    filter: Vec<f64>,
    /// Mean square of `e`.
    error: f64,
}

impl Autoregression {
    /// What a series adds to what it had before, `x_k - phi_1 x_(k-1) - ..`: of a series like that which was fitted a white one.
    pub fn whitened(&self, series: &[f64]) -> Vec<f64> {
        let order = self.filter.len() - 1;
        let terms = |window: &[f64]| -> f64 {
            let latest = window.iter().rev();
            self.filter.iter().zip(latest).map(|(phi, x)| phi * x).sum()
        };
        series.windows(order + 1).map(terms).collect()
    }

    /// Highest order through so many samples.
    pub fn orders(samples: usize) -> f64 {
        let n = samples as f64;
        (ORDERS * n.log10()).min(n / SAMPLES_AN_ORDER).max(0.0)
    }

    /// The one that fits a series best, by Burg's recursion with the order of least AIC.
    pub fn through(series: &[f64]) -> Self {
        let n = series.len() as f64;
        let mut error = series.iter().map(|x| x * x).sum::<f64>() / n.max(1.0);
        let mut filter = vec![1.0];
        let mut best = Self {
            filter: filter.clone(),
            error,
        };
        if error == 0.0 {
            return best;
        }
        let orders = Self::orders(series.len());
        // Prediction errors forward and backward.
        let (mut forward, mut backward) = (series.to_vec(), series.to_vec());
        let mut least = n * error.ln();
        for order in 1..=whole_steps(orders) {
            let pairs = forward[order..].iter().zip(&backward[order - 1..]);
            let (product, power) = pairs.fold((0.0, 0.0), |(product, power), (f, b)| {
                (product + f * b, power + f * f + b * b)
            });
            if power == 0.0 {
                break;
            }
            let reflection = -2.0 * product / power;
            for k in (order..series.len()).rev() {
                let (f, b) = (forward[k], backward[k - 1]);
                forward[k] = f + reflection * b;
                backward[k] = b + reflection * f;
            }
            filter.push(0.0);
            let reversed: Vec<f64> = filter.iter().rev().copied().collect();
            for (x, y) in filter.iter_mut().zip(reversed) {
                *x += reflection * y;
            }
            error *= 1.0 - reflection * reflection;
            if error <= 0.0 {
                break;
            }
            let criterion = n * error.ln() + 2.0 * order as f64;
            if criterion < least {
                least = criterion;
                best = Self {
                    filter: filter.clone(),
                    error,
                };
            }
        }
        best
    }

    /// Variance of `sum_k w_k x_k`.
    pub fn variance_of_sum(&self, weights: &[f64]) -> f64 {
        self.variances_of_sums(&[weights])[0]
    }

    /// Variance of `sum_k w_k x_k` for each of several weights of one length.
    pub fn variances_of_sums(&self, weights: &[&[f64]]) -> Vec<f64> {
        let groups = weights.chunks(ABREAST);
        groups.flat_map(|group| self.variances(group)).collect()
    }

    /// The same of a few: one sample waits for those behind it, so several weights go abreast.
    fn variances(&self, weights: &[&[f64]]) -> Vec<f64> {
        let samples = weights.iter().map(|weights| weights.len()).max();
        let mut carried = vec![[0.0; ABREAST]; samples.unwrap_or(0)];
        let mut squares = [0.0; ABREAST];
        for k in (0..carried.len()).rev() {
            let mut own = [0.0; ABREAST];
            for (own, weights) in own.iter_mut().zip(weights) {
                *own = weights[k];
            }
            for (later, a) in carried[k + 1..].iter().zip(&self.filter[1..]) {
                for (own, later) in own.iter_mut().zip(later) {
                    *own -= a * later;
                }
            }
            for (square, own) in squares.iter_mut().zip(&own) {
                *square += own * own;
            }
            carried[k] = own;
        }
        let squares = squares[..weights.len()].iter();
        squares.map(|square| self.error * square).collect()
    }

    /// Noise of it: so many samples, long after whatever it began with.
    pub fn drawn(&self, count: usize, random: &mut ChaCha8Rng) -> Vec<f64> {
        let before = BEFORE.max(count);
        let size = self.error.sqrt();
        let mut noise: Vec<f64> = Vec::with_capacity(before + count);
        for _ in 0..before + count {
            let fresh: f64 = StandardNormal.sample(random);
            let carried = noise.iter().rev().zip(&self.filter[1..]);
            let carried: f64 = carried.map(|(x, a)| x * a).sum();
            noise.push(size * fresh - carried);
        }
        noise.split_off(before)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    /// Mean of what is told over what is so, deviations of sums of a filtered white series.
    fn told(filter: &dyn Fn(&[f64]) -> Vec<f64>) -> f64 {
        const DRAWS: u32 = 200;
        let (mut told, mut so) = (0.0, 0.0);
        for seed in 0..DRAWS {
            let mut random = ChaCha8Rng::seed_from_u64(u64::from(seed));
            let white: Vec<f64> = (0..3000)
                .map(|_| StandardNormal.sample(&mut random))
                .collect();
            let series = filter(&white);
            told += long_run_sum(&series);
            so += series.iter().sum::<f64>().powi(2);
        }
        (told / so).sqrt()
    }

    #[test]
    fn white_and_slow_series_add_up_to_what_is_told() {
        let white = told(&<[f64]>::to_vec);
        assert!((white - 1.0).abs() < 0.12, "{white}");
        for share in [0.5, 0.9, 0.97] {
            let slow = told(&|white| {
                let mut state = 0.0;
                let next = |x: &f64| {
                    state = share * state + x;
                    state
                };
                white.iter().map(next).collect()
            });
            assert!((slow - 1.0).abs() < 0.15, "{share}: {slow}");
        }
        let wave = told(&|white| {
            let slow = white.windows(5).map(|near| near.iter().sum::<f64>());
            slow.enumerate()
                .map(|(k, x)| x * (0.3 * k as f64).sin())
                .collect()
        });
        assert!((wave - 1.0).abs() < 0.15, "{wave}");
    }

    /// Weights that swing against slow noise: their sum varies as the autoregression through the noise says.
    #[test]
    fn weighed_sums_of_noise_vary_as_it_says() {
        const DRAWS: u32 = 200;
        const SHARE: f64 = 0.9;
        let weights: Vec<f64> = (0..800).map(|k| (0.4 * f64::from(k)).sin()).collect();
        let (mut told, mut so, mut products) = (Vec::new(), 0.0, Vec::new());
        for seed in 0..DRAWS {
            let mut random = ChaCha8Rng::seed_from_u64(u64::from(seed));
            let mut state = 0.0;
            let noise: Vec<f64> = (0..1000)
                .map(|_| {
                    let white: f64 = StandardNormal.sample(&mut random);
                    state = SHARE * state + white;
                    state
                })
                .skip(200)
                .collect();
            let series: Vec<f64> = noise.iter().zip(&weights).map(|(x, w)| x * w).collect();
            so += series.iter().sum::<f64>().powi(2) / f64::from(DRAWS);
            told.push(Autoregression::through(&noise).variance_of_sum(&weights));
            products.push(long_run_sum(&series));
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let scatter = |values: &[f64]| {
            let center = mean(values);
            let squares: Vec<f64> = values.iter().map(|x| (x / center - 1.0).powi(2)).collect();
            mean(&squares).sqrt()
        };
        let ratio = (mean(&told) / so).sqrt();
        assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
        // That is what it is for.
        let (steady, of_products) = (scatter(&told), scatter(&products));
        assert!(steady < 0.5 * of_products, "{steady} {of_products}");
    }

    /// More of them than go abreast.
    #[test]
    fn sums_together_are_those_of_each_alone() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut series = |count: usize| -> Vec<f64> {
            (0..count)
                .map(|_| StandardNormal.sample(&mut random))
                .collect()
        };
        let law = Autoregression::through(
            &series(500)
                .windows(3)
                .map(|x| x.iter().sum())
                .collect::<Vec<f64>>(),
        );
        assert!(law.filter.len() > 2);
        let weights: Vec<Vec<f64>> = (0..ABREAST + 3).map(|_| series(200)).collect();
        let all: Vec<&[f64]> = weights.iter().map(Vec::as_slice).collect();
        let together = law.variances_of_sums(&all);
        assert_eq!(together.len(), all.len());
        for (weights, together) in weights.iter().zip(together) {
            // `phi(B^-1) u = w`, one sample after the other from the last.
            let mut u = weights.clone();
            for k in (0..u.len()).rev() {
                for (lag, phi) in law.filter.iter().enumerate().skip(1) {
                    u[k] -= phi * u.get(k + lag).copied().unwrap_or(0.0);
                }
            }
            let alone = law.error * u.iter().map(|u| u * u).sum::<f64>();
            assert!((together / alone - 1.0).abs() < 1e-12);
        }
    }

    /// Noise of a position in a velocity and an acceleration: sums of it cancel but for the ends.
    #[test]
    fn differences_cancel() {
        let white = |seed: u64| -> Vec<f64> {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            (0..3000)
                .map(|_| StandardNormal.sample(&mut random))
                .collect()
        };
        for seed in 0..20 {
            let first: Vec<f64> = white(seed).windows(2).map(|x| x[1] - x[0]).collect();
            let second: Vec<f64> = first.windows(2).map(|x| x[1] - x[0]).collect();
            for series in [first, second] {
                let power: f64 = series.iter().map(|x| x * x).sum();
                let told = (long_run_sum(&series) / power).sqrt();
                assert!(told < 0.12, "{told}");
            }
        }
    }
}
