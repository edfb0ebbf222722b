//! Torques that stand and jump, as commands that hold do.

use robot_model::log::Log;

use crate::output::names;

/// Half the change from sample to sample, over the torque, roots of mean squares, from where on half a sample matters.
const LARGE: f64 = 0.08;

/// The middle change from sample to sample, over their root mean square, below which a torque stands and jumps: that of a wave is 1.
const STANDS: f64 = 0.2;

/// A shorter sample, s, is nothing to an arm; what goes from one to the next is a controller's chatter.
const SHORTEST: f64 = 0.004;

/// What is said of joints whose torques go in steps in all logs.
pub(super) fn doubt(joints: &[String], logs: &[Log]) -> Option<String> {
    if logs.iter().any(|log| log.rate_hz() * SHORTEST > 1.0) {
        return None;
    }
    let stepping = joints.iter().enumerate().filter(|(joint, _)| {
        logs.iter()
            .all(|log| stands(&log.tau[*joint]) && steps(&log.tau[*joint]) > LARGE)
    });
    let stepping: Vec<&str> = stepping.map(|(_, name)| name.as_str()).collect();
    (!stepping.is_empty()).then(|| {
        format!(
            "torques of {} are constant, then jump from one sample to the next: if each is a command held until the next sample, the arm \
             felt it half a sample later, and inertias and friction are biased without a larger error; use `--method output-error`, which \
             tries held torques, or log at a higher rate",
            names(&stepping)
        )
    })
}

/// Whether most changes from sample to sample are next to none beside the others.
fn stands(tau: &[f64]) -> bool {
    let mut changes: Vec<f64> = tau
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .collect();
    changes.sort_by(f64::total_cmp);
    let square: f64 = changes.iter().map(|x| x * x).sum();
    let middle = changes.get(changes.len() / 2).copied().unwrap_or_default();
    middle < STANDS * (square / changes.len().max(1) as f64).sqrt()
}

/// Half the change from sample to sample over the spread of the torque, without what white noise has of it: that is as large over two samples
/// as over one, and changes of a smooth torque are twice as large there.
fn steps(tau: &[f64]) -> f64 {
    let over = |lag: usize| {
        let pairs = tau.iter().zip(tau.iter().skip(lag));
        pairs.map(|(x, y)| (y - x).powi(2)).sum::<f64>()
    };
    let mean = tau.iter().sum::<f64>() / tau.len().max(1) as f64;
    let level: f64 = tau.iter().map(|x| (x - mean).powi(2)).sum();
    if level > 0.0 {
        0.5 * ((over(2) - over(1)).max(0.0) / 3.0 / level).sqrt()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(f: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..1000).map(|k| f(f64::from(k))).collect()
    }

    #[test]
    fn commands_that_jump_are_told_from_waves_and_from_noise() {
        let square = |k: f64| if (k / 9.0).sin() > 0.0 { 1.6 } else { -1.6 };
        for bias in [0.0, 3.0] {
            let torque = series(|k| square(k) + bias);
            assert!(steps(&torque) > LARGE && stands(&torque));
        }
        // 2 Hz at 50 Hz are steps as large, and none that stand.
        let fast = series(|k| (0.251 * k).sin());
        assert!(steps(&fast) > LARGE && !stands(&fast));
        // Half a Hz at 100 Hz, smooth and with a tenth of white noise.
        let wave = |k: f64| (0.03 * k).sin();
        let noisy = |k: f64| wave(k) + 0.1 * (12.9898 * k * k).sin();
        for torque in [series(wave), series(noisy), vec![0.0; 1000]] {
            assert!(steps(&torque) < 0.5 * LARGE, "{}", steps(&torque));
        }
    }
}
