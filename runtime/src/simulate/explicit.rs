//! Steps for motions that are not stiff: Dormand and Prince's pair of orders five and four.
//!
//! Source: Hairer, Norsett, Wanner 1993, Solving Ordinary Differential Equations I, table 5.2 of section II.5.

use nalgebra::DVector;

/// Stages, rows of Butcher's table below the first; the last row is the step itself.
pub(super) const STAGES: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[
        19_372.0 / 6_561.0,
        -25_360.0 / 2_187.0,
        64_448.0 / 6_561.0,
        -212.0 / 729.0,
    ],
    &[
        9_017.0 / 3_168.0,
        -355.0 / 33.0,
        46_732.0 / 5_247.0,
        49.0 / 176.0,
        -5_103.0 / 18_656.0,
    ],
    &[
        35.0 / 384.0,
        0.0,
        500.0 / 1_113.0,
        125.0 / 192.0,
        -2_187.0 / 6_784.0,
        11.0 / 84.0,
    ],
];

/// When the stages are, as shares of the step.
pub(super) const INSTANTS: [f64; 6] = [0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];

/// Weights of the error: order five less order four.
const ERROR: [f64; 7] = [
    71.0 / 57_600.0,
    0.0,
    -71.0 / 16_695.0,
    71.0 / 1_920.0,
    -17_253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// A step and what is known of it.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub end: DVector<f64>,
    pub error: DVector<f64>,
    /// Rate at the end.
    pub rate: DVector<f64>,
    /// Step times the rate's slope along the last two stages: beyond the region of stability the motion is stiff.
    pub stiffness: f64,
}

/// A step of `h` from `x`, where the rate is `first`.
pub(super) fn step<E>(
    mut rate: impl FnMut(f64, &DVector<f64>) -> Result<DVector<f64>, E>,
    time: f64,
    x: &DVector<f64>,
    first: &DVector<f64>,
    h: f64,
) -> Result<Step, E> {
    let mut rates = vec![first.clone()];
    let (mut before, mut end) = (x.clone(), x.clone());
    for (weights, instant) in STAGES.iter().zip(INSTANTS) {
        before = std::mem::replace(&mut end, x.clone());
        for (weight, rate) in weights.iter().zip(&rates) {
            if *weight != 0.0 {
                end.axpy(h * weight, rate, 1.0);
            }
        }
        rates.push(rate(time + instant * h, &end)?);
    }
    let mut error = DVector::zeros(x.len());
    for (weight, rate) in ERROR.iter().zip(&rates) {
        error.axpy(h * weight, rate, 1.0);
    }
    let way = (&end - before).norm();
    let turn = (&rates[6] - &rates[5]).norm();
    Ok(Step {
        end,
        error,
        stiffness: if way > 0.0 { h * turn / way } else { 0.0 },
        rate: rates.swap_remove(6),
    })
}
