//! First values to try of shape parameters.

use robot_model_spec::model::ShapeParameter;

/// First values to try of a shape parameter whose definition gives no step.
const GRID_POINTS: usize = 12;

/// No definition with more steps than this passes the check.
const MOST_GRID_POINTS: u32 = 10_000;

/// First values to try: at the definition's step, else evenly spaced in the logarithm, or evenly where the range has none.
pub(super) fn grid(shape: &ShapeParameter) -> Vec<f64> {
    let (low, high) = (shape.low, shape.high);
    let points: Vec<f64> = match shape.step {
        Some(step) => (0..MOST_GRID_POINTS)
            .map(|k| low + step * f64::from(k))
            .take_while(|value| *value < high - 1e-9 * step)
            .collect(),
        None => (0..GRID_POINTS - 1)
            .map(|k| {
                let share = k as f64 / (GRID_POINTS - 1) as f64;
                if low > 0.0 {
                    low * (high / low).powf(share)
                } else {
                    low + share * (high - low)
                }
            })
            .collect(),
    };
    points.into_iter().chain([high]).collect()
}
