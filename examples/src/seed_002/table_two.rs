//! Table II: two friction models by two ways to weigh joints.

use robot_model::identify::{Beyond, Estimate, Identify, Method, Stack, Weights};
use robot_model::log::Log;
use robot_model::signal::{Bands, prepare};
use robot_model_cli::interpreted::InterpretedArm;

use crate::paper::Error;

/// How the joints are weighed.
pub const WEIGHTS: [(&str, Method, Weights); 4] = [
    ("none (LS)", Method::Ls, Weights::Residual),
    ("torque norm (WLS)", Method::Wls, Weights::TorqueNorm),
    ("residual", Method::Wls, Weights::Residual),
    ("max torque", Method::Wls, Weights::MaxTorque),
];

/// An estimate with its errors on the run that was not fitted, N m.
#[derive(Debug, Clone)]
pub struct Fit {
    /// What was identified.
    pub estimate: Estimate,
    /// Root mean square error, a joint (equation 23).
    pub rmse: Vec<f64>,
    /// Sum of squares over all joints on the run that was fitted, N^2 m^2.
    pub trained: f64,
}

/// How a fit is made, by its place in [`WEIGHTS`].
fn identify(weights: usize) -> Identify {
    let (_, method, weights) = WEIGHTS[weights];
    Identify {
        method,
        weights,
        bands: Some(Bands::DEFAULT),
        // No channel of a simulated log is late.
        beyond: Beyond::Deviations,
        ..Identify::default()
    }
}

/// Identifies from one run and tests on another.
///
/// # Errors
/// Those of the libraries.
pub fn fit(arm: &InterpretedArm, [train, test]: [&Log; 2], weights: usize) -> Result<Fit, Error> {
    let identify = identify(weights);
    let estimate = identify.fit(arm, std::slice::from_ref(train))?;
    let stack = Stack::new(arm, &[prepare(train, &Bands::DEFAULT)?], &[]);
    let solution = identify.solve_stack(&stack)?;
    let residuals = stack.residuals(&solution.estimate);
    Ok(Fit {
        rmse: estimate.errors(arm, test)?.rmse,
        trained: residuals.iter().flatten().map(|x| x * x).sum(),
        estimate,
    })
}

/// By how much a mean is smaller, in percent.
#[must_use]
pub fn drop(before: f64, after: f64) -> f64 {
    100.0 * (1.0 - after / before)
}

/// Mean of some numbers.
#[must_use]
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Mean over the joints of the drop of each.
#[must_use]
pub fn mean_drop(before: &[f64], after: &[f64]) -> f64 {
    let drops: Vec<f64> = before
        .iter()
        .zip(after)
        .map(|(b, a)| drop(*b, *a))
        .collect();
    mean(&drops)
}

/// Sum of squares.
#[must_use]
pub fn squares(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum()
}
