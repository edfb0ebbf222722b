//! Steps for stiff motions: the linearly implicit method RODAS, of order four with an estimate of order three, L-stable.
//!
//! Each of its six stages solves with one matrix, `1/(h gamma) - J`, so that exact slopes are all it takes: nothing iterates.
//!
//! Source: Hairer, Wanner 1996, Solving Ordinary Differential Equations II, section IV.7.

use nalgebra::{DMatrix, DVector};

const GAMMA: f64 = 0.25;

/// When the stages are, as shares of the step, and how much of `h df/dt` they have.
const INSTANTS: [f64; 6] = [0.0, 0.386, 0.21, 0.63, 1.0, 1.0];
const BY_TIME: [f64; 6] = [0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0];

/// Where the rate of each stage is taken; the sixth adds the fifth's step to the fifth's place.
const PLACES: [&[f64]; 5] = [
    &[],
    &[1.544],
    &[0.946_678_528_081_582_6, 0.255_701_169_898_328_4],
    &[
        3.314_825_187_068_521,
        2.896_124_015_972_201,
        0.998_641_913_997_781_7,
    ],
    &[
        1.221_224_509_226_641,
        6.019_134_481_288_629,
        12.537_083_329_320_87,
        -0.687_886_036_105_895,
    ],
];

/// What earlier stages add to the right side, over `h`.
const SHARES: [&[f64]; 6] = [
    &[],
    &[-5.6688],
    &[-2.430_093_356_833_875, -0.206_359_915_709_191_5],
    &[
        -0.107_352_905_815_137_5,
        -9.594_562_251_023_355,
        -20.470_286_148_096_16,
    ],
    &[
        7.496_443_313_967_647,
        -10.246_804_314_643_52,
        -33.999_903_528_199_05,
        11.708_908_932_061_6,
    ],
    &[
        8.083_246_795_921_522,
        -7.981_132_988_064_893,
        -31.521_594_328_743_71,
        16.319_305_431_231_36,
        -6.058_818_238_834_054,
    ],
];

/// The end of a step, and its error.
type Step = (DVector<f64>, DVector<f64>);

/// A step of `h` from `x` with slope `jacobian`, where the rate is `first` and `by_time` its slope by time: the end and the error.
/// `None` where the matrix is singular.
pub(super) fn step<E>(
    mut rate: impl FnMut(f64, &DVector<f64>) -> Result<DVector<f64>, E>,
    time: f64,
    x: &DVector<f64>,
    (first, jacobian, by_time): (&DVector<f64>, &DMatrix<f64>, &DVector<f64>),
    h: f64,
) -> Result<Option<Step>, E> {
    let mut matrix = -jacobian.clone();
    for k in 0..x.len() {
        matrix[(k, k)] += 1.0 / (h * GAMMA);
    }
    let lu = matrix.lu();
    let mut stages: Vec<DVector<f64>> = Vec::with_capacity(6);
    let mut place = x.clone();
    for stage in 0..6 {
        if stage == 5 {
            place += &stages[4];
        } else {
            place.copy_from(x);
            for (weight, step) in PLACES[stage].iter().zip(&stages) {
                place.axpy(*weight, step, 1.0);
            }
        }
        let mut right = if stage == 0 {
            first.clone()
        } else {
            rate(time + INSTANTS[stage] * h, &place)?
        };
        for (weight, step) in SHARES[stage].iter().zip(&stages) {
            right.axpy(weight / h, step, 1.0);
        }
        right.axpy(h * BY_TIME[stage], by_time, 1.0);
        if !lu.solve_mut(&mut right) {
            return Ok(None);
        }
        stages.push(right);
    }
    let error = stages.swap_remove(5);
    Ok(Some((place + &error, error)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// A pendulum that a wave drives and friction damps: the error of `count` steps over two seconds.
    fn error(count: u32) -> f64 {
        let rate = |t: f64, x: &DVector<f64>| -> Result<DVector<f64>, Infallible> {
            let drive = (3.0 * t).sin();
            Ok(DVector::from_vec(vec![
                x[1],
                drive - x[0].sin() - 0.4 * x[1] * x[1] * x[1],
            ]))
        };
        let run = |count: u32| {
            let h = 2.0 / f64::from(count);
            let mut x = DVector::from_vec(vec![1.0, 0.3]);
            for k in 0..count {
                let t = h * f64::from(k);
                let first = rate(t, &x).expect("always");
                let slopes = [0.0, 1.0, -x[0].cos(), -1.2 * x[1] * x[1]];
                let jacobian = DMatrix::from_row_slice(2, 2, &slopes);
                let by_time = DVector::from_vec(vec![0.0, 3.0 * (3.0 * t).cos()]);
                let step = step(rate, t, &x, (&first, &jacobian, &by_time), h);
                x = step.expect("always").expect("regular").0;
            }
            x
        };
        (run(count) - run(4000)).norm()
    }

    #[test]
    fn the_order_is_four() {
        let order = (error(40) / error(80)).log2();
        assert!((order - 4.0).abs() < 0.25, "{order}");
        assert!(error(80) < 1e-7, "{}", error(80));
    }

    #[test]
    fn what_is_endlessly_stiff_comes_to_rest_in_a_step() {
        let rate = |_: f64, x: &DVector<f64>| -> Result<DVector<f64>, Infallible> {
            Ok(x.map(|x| -1e12 * (x - 2.0)))
        };
        let x = DVector::from_vec(vec![7.0]);
        let jacobian = DMatrix::from_element(1, 1, -1e12);
        let first = rate(0.0, &x).expect("always");
        let still = DVector::zeros(1);
        let step = step(rate, 0.0, &x, (&first, &jacobian, &still), 1.0);
        let end = step.expect("always").expect("regular").0;
        assert!((end[0] - 2.0).abs() < 1e-9, "{end}");
    }
}
