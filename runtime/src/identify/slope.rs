//! What torques change by with a shape: central differences.

/// The step of a difference is this share of the value, or of a thousandth of its range.
const STEP: f64 = 1e-4;
const SHARE_OF_RANGE: f64 = 1e-3;

/// Where the torque jumps, a step is so many times wider than the one before, so often at most, until its slope differs by this share of it from
/// the one before.
const WIDER: f64 = 4.0;
const WIDENINGS: i32 = 5;
const AGREES: f64 = 0.2;

/// Torques of all joints, `[joint][row]`, of a value of a shape.
pub(crate) type Torques<'a> = &'a dyn Fn(f64) -> Vec<Vec<f64>>;

/// Slopes of torques that are smooth in a shape at a value in its range, `[joint][row]`.
pub(crate) fn smooth(value: f64, grid: &[f64], torques: Torques) -> Vec<Vec<f64>> {
    central(value, grid, torques, 1.0)
}

/// The same of torques that may jump: an edge in time goes from sample to sample, so that a difference over less than one says that the torque
/// hardly changes, or by many times what it does. Steps are as wide as it takes for slopes to agree.
pub(crate) fn across_jumps(value: f64, grid: &[f64], torques: Torques) -> Vec<Vec<f64>> {
    let mut slopes = smooth(value, grid, torques);
    for widening in 1..=WIDENINGS {
        let wider = central(value, grid, torques, WIDER.powi(widening));
        let pairs = || slopes.iter().flatten().zip(wider.iter().flatten());
        let apart: f64 = pairs().map(|(a, b)| (a - b).powi(2)).sum();
        let all: f64 = pairs().map(|(_, b)| b * b).sum();
        let agree = all > 0.0 && apart <= AGREES.powi(2) * all;
        slopes = wider;
        if agree {
            break;
        }
    }
    slopes
}

fn central(value: f64, grid: &[f64], torques: Torques, times: f64) -> Vec<Vec<f64>> {
    let (low, high) = (grid[0], grid[grid.len() - 1]);
    let step = times * STEP * value.abs().max(SHARE_OF_RANGE * (high - low));
    let ends = [value - step, value + step].map(|end| end.clamp(low, high));
    let [mut slopes, above] = ends.map(torques);
    for (slopes, above) in slopes.iter_mut().zip(&above) {
        for (slope, above) in slopes.iter_mut().zip(above) {
            *slope = (above - *slope) / (ends[1] - ends[0]);
        }
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::{across_jumps, smooth};

    const GRID: [f64; 2] = [0.0, 60.0];

    #[test]
    fn a_smooth_torque_has_the_slope_of_its_formula() {
        let torques = |shape: f64| vec![vec![(3.0 * shape).sin(), shape], vec![shape * shape]];
        for slopes in [
            smooth(0.7, &GRID, &torques),
            across_jumps(0.7, &GRID, &torques),
        ] {
            let wanted = [3.0 * 2.1_f64.cos(), 1.0, 1.4];
            for (slope, wanted) in slopes.iter().flatten().zip(wanted) {
                assert!((slope - wanted).abs() < 1e-6, "{slopes:?}");
            }
        }
    }

    /// A force of 2 from `start` on, sampled every 5 ms: all samples together change by 2 / 5 ms.
    #[test]
    fn an_edge_has_the_slope_of_its_force_wherever_it_is_between_samples() {
        let torques = |start: f64| {
            let force = (0..8000).map(|k| f64::from(u8::from(0.005 * f64::from(k) >= start)));
            vec![force.map(|there| 2.0 * there).collect()]
        };
        for k in 0..40 {
            let start = 9.0 + 0.000_37 * f64::from(k);
            let slopes = across_jumps(start, &GRID, &torques);
            let sum: f64 = slopes[0].iter().sum();
            assert!((sum + 400.0).abs() < 0.25 * 400.0, "{start}: {sum}");
        }
    }

    #[test]
    fn a_shape_that_does_nothing_has_no_slope() {
        let slopes = across_jumps(1.0, &GRID, &|_| vec![vec![3.0; 4]]);
        assert_eq!(slopes, [[0.0; 4]]);
    }
}
