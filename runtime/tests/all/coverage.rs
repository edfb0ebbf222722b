//! Intervals of two deviations against the truth, over many experiments whose noise is slow or fast.

use super::plant::{Pendulums, Plant, TRUTH};
use robot_model::identify::{Beyond, Estimate, Factor, Identify, Method};
use robot_model::log::Log;
use robot_model::signal::Bands;

const EXPERIMENTS: u64 = 200;

type Fit<'a> = &'a dyn Fn(&Pendulums, Log) -> Estimate;

/// How often blocks are drawn.
const DRAWS: usize = 200;

#[test]
fn intervals_cover_the_truth_as_often_as_they_say() {
    cover("wls", &[0.005, 0.2, 1.0], &|arm, log| {
        fit(arm, log, Method::Wls)
    });
}

#[test]
fn intervals_of_total_least_squares_do() {
    cover("tls", &[0.005, 0.2], &|arm, log| {
        fit(arm, log, Method::Total)
    });
}

#[test]
fn intervals_of_ordinary_and_of_robust_least_squares_do() {
    cover("ls", &[0.2], &|arm, log| fit(arm, log, Method::Ls));
    cover("robust", &[0.2], &|arm, log| fit(arm, log, Method::Robust));
}

/// What blocks that are drawn say, in place of a formula.
#[test]
fn intervals_of_blocks_do() {
    cover("bootstrap", &[0.2], &|arm, log| {
        let identify = Identify {
            bootstrap: DRAWS,
            ..of_method(Method::Wls)
        };
        identify.fit(arm, &[log]).expect("the log is long enough")
    });
}

#[test]
fn intervals_of_merged_factors_do() {
    cover("merge", &[0.005, 0.2], &|arm, log| {
        let mut factor = Factor::new(arm, Bands::DEFAULT).expect("bands");
        factor.push(arm, &log).expect("the log is sound");
        let estimate = factor.estimate(arm, &Identify::default());
        estimate.expect("excited")
    });
}

fn of_method(method: Method) -> Identify {
    Identify {
        method,
        bands: Some(Bands::DEFAULT),
        beyond: Beyond::Deviations,
        ..Identify::default()
    }
}

fn fit(arm: &Pendulums, log: Log, method: Method) -> Estimate {
    of_method(method)
        .fit(arm, &[log])
        .expect("the log is sound")
}

/// The intervals of an estimate: those of its blocks, where they were drawn.
fn intervals(estimate: &Estimate) -> Vec<[f64; 2]> {
    if let Some(drawn) = &estimate.bootstrap {
        let told = drawn.intervals.iter();
        return told.map(|own| own.expect("all is told")).collect();
    }
    let parameters = estimate.parameters.iter();
    parameters
        .map(|own| [-1.96, 1.96].map(|times| own.value + times * own.std))
        .collect()
}

fn cover(name: &str, times: &[f64], fit: Fit) {
    let arm = Pendulums::new();
    let quiet = Plant {
        white: 0.0,
        ..Plant::default()
    };
    let log = quiet.log();
    for &correlated_s in times {
        let (mut hits, mut errors, mut claimed) = ([0; 8], [0.0; 8], [0.0; 8]);
        for seed in 100..100 + EXPERIMENTS {
            // The motion's seed is part of the log's; only the noise may differ between experiments.
            let still = Plant { seed, ..quiet }.log();
            let noisy = Plant {
                white: 0.05,
                colored: 0.3,
                correlated_s,
                ..Plant { seed, ..quiet }
            };
            let noisy = noisy.log();
            let mut log = log.clone();
            for (joint, tau) in log.tau.iter_mut().enumerate() {
                let noise = noisy.tau[joint].iter().zip(&still.tau[joint]);
                tau.iter_mut()
                    .zip(noise)
                    .for_each(|(tau, (x, y))| *tau += x - y);
            }
            let estimate = fit(&arm, log);
            let values = estimate.values();
            for (k, [low, high]) in intervals(&estimate).into_iter().enumerate() {
                hits[k] += u32::from(low < TRUTH[k] && TRUTH[k] < high);
                errors[k] += (values[k] - TRUTH[k]).powi(2);
                claimed[k] += ((high - low) / (2.0 * 1.96)).powi(2);
            }
        }
        let all = f64::from(hits.iter().sum::<u32>()) / (8.0 * EXPERIMENTS as f64);
        assert!(
            (0.90..0.98).contains(&all),
            "{name}, {correlated_s} s: {all} {hits:?}"
        );
        for (claimed, error) in claimed.iter().zip(errors) {
            let ratio = (claimed / error).sqrt();
            assert!(
                (0.8..1.6).contains(&ratio),
                "{name}, {correlated_s} s: {ratio}"
            );
        }
    }
}
