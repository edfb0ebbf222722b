//! Slopes of a plant by differences.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Plant, Slopes};
use robot_model_cli::interpreted::InterpretedPlant;

/// Positions, velocities, accelerations and the state of all at an instant.
pub type State = [Vec<f64>; 4];

pub fn at<'a>([q, dq, ddq, memory]: &'a State, switches: &'a [f64]) -> Instant<'a> {
    Instant {
        time: 0.0,
        q,
        dq,
        ddq,
        memory,
        switches,
        torque: &[0.0; 4],
        inputs: &[],
    }
}

/// Torque and rates by `q`, `dq`, `ddq` and `z` of all, by differences; those of the plant are to be the same.
pub fn differences(arm: &mut InterpretedPlant, state: &State) -> [DMatrix<f64>; 4] {
    const STEP: f64 = 1e-6;
    let switches = vec![0.6; arm.switches()];
    let (n, p) = (arm.dof(), arm.states());
    // Torque and rates beside each other.
    let value = |arm: &mut InterpretedPlant, state: &State| -> DVector<f64> {
        let (mut torque, mut inertia) = (DVector::zeros(n), DMatrix::zeros(n, n));
        arm.torque(&at(state, &switches), &mut torque, &mut inertia);
        let mut rates = vec![0.0; p];
        arm.rates(&at(state, &switches), &mut rates);
        DVector::from_iterator(n + p, torque.iter().copied().chain(rates))
    };
    let mut difference = |part: usize| -> DMatrix<f64> {
        let columns: Vec<DVector<f64>> = (0..state[part].len())
            .map(|k| {
                let [up, down] = [STEP, -STEP].map(|step| {
                    let mut state = state.clone();
                    state[part][k] += step;
                    value(arm, &state)
                });
                (up - down) / (2.0 * STEP)
            })
            .collect();
        DMatrix::from_columns(&columns)
    };
    let differences = [0, 1, 2, 3].map(&mut difference);
    let mut slopes = Slopes::zeros(arm);
    arm.slopes(&at(state, &switches), &mut slopes);
    let (mut torque, mut inertia) = (DVector::zeros(n), DMatrix::zeros(n, n));
    arm.torque(&at(state, &switches), &mut torque, &mut inertia);
    let Slopes {
        torque: [q, dq, z],
        rates: [rates_q, rates_dq, rates_z],
        rates_by_acceleration,
    } = slopes;
    for (found, (torque, rates)) in differences.iter().zip([
        (q, rates_q),
        (dq, rates_dq),
        (inertia, rates_by_acceleration),
        (z, rates_z),
    ]) {
        let expected = DMatrix::from_fn(n + p, found.ncols(), |i, j| {
            if i < n {
                torque[(i, j)]
            } else {
                rates[(i - n, j)]
            }
        });
        let size = expected.amax().max(1.0);
        assert!(
            (found - &expected).amax() < 1e-6 * size,
            "{found} {expected}"
        );
    }
    differences
}
