//! An arm that falls whatever its start.

use super::*;
use crate::simulate::SimulateError;

/// A rod that stands upright, `ddq = k q + tau`: it stays there, and by no start that is near.
#[derive(Debug, Clone)]
struct Upright([f64; 1]);

impl Plant for Upright {
    fn dof(&self) -> usize {
        1
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        torque[0] = at.ddq[0] - self.0[0] * at.q[0];
        inertia[(0, 0)] = 1.0;
    }

    fn slopes(&mut self, _: &Instant<'_>, slopes: &mut Slopes) {
        slopes.torque[0][(0, 0)] = -self.0[0];
        slopes.torque[1][(0, 0)] = 0.0;
    }
}

impl Adjustable for Upright {
    fn values(&self) -> Vec<f64> {
        self.0.to_vec()
    }

    fn adjust(&mut self, values: &[f64]) {
        self.0.copy_from_slice(values);
    }

    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
        slopes.torque[(0, 0)] = -at.q[0];
    }
}

#[test]
fn what_the_least_change_moves_without_bounds_has_run_away() {
    let mut still = log(4.0);
    still.q[0].fill(0.0);
    still.tau[0].fill(0.0);
    // A log in which nothing moves is refused as such.
    *still.q[0].last_mut().expect("samples") = 1e-6;
    let recording = || [Recording::new(&still, &[1.0], 0.0, Vec::new())];
    let found = |settings: &OutputError| {
        let (start, names) = ([400.0], ["k".to_owned()]);
        settings.fit(&Upright(start), &names, &start, &recording(), &mut |_| ())
    };
    let error = found(&HELD).expect_err("it falls");
    let OutputErrorError::Start { error, .. } = error else {
        panic!("{error}");
    };
    assert!(
        matches!(error, SimulateError::Sensitive { joint: 1, .. }),
        "{error}"
    );
}
