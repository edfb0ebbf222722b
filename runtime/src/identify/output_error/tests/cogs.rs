//! A block on cogs, whose force bends within a step: slopes of a step's middle are off by parts of a hundred there.

use super::*;
use crate::simulate::Tangent;

/// `m ddq + c dq + a sin(K q) = tau`.
#[derive(Debug, Clone)]
struct Cogged([f64; 3]);

/// 1/m: at 2 m/s a fifth of a cog goes by from sample to sample.
const K: f64 = 60.0;

impl Plant for Cogged {
    fn dof(&self) -> usize {
        1
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        let [m, c, a] = self.0;
        torque[0] = m * at.ddq[0] + c * at.dq[0] + a * (K * at.q[0]).sin();
        inertia[(0, 0)] = m;
    }

    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        slopes.torque[0][(0, 0)] = K * self.0[2] * (K * at.q[0]).cos();
        slopes.torque[1][(0, 0)] = self.0[1];
    }
}

impl Adjustable for Cogged {
    fn values(&self) -> Vec<f64> {
        self.0.to_vec()
    }

    fn adjust(&mut self, values: &[f64]) {
        self.0.copy_from_slice(values);
    }

    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
        let by = [at.ddq[0], at.dq[0], (K * at.q[0]).sin()];
        slopes.torque.copy_from_slice(&by);
    }
}

/// How where the block ends changes with the height of the cogs, by exact slopes and by those of the middle.
fn slopes(log: &Log, truth: [f64; 3]) -> [f64; 2] {
    let plant = Cogged(truth);
    let exact = Tangent::new(&plant, DMatrix::zeros(2, 3));
    [exact.clone(), exact.coarse()].map(|mut tangent| {
        let mut block =
            Integrator::new(plant.clone(), &[0.2], &[0.5], Tolerances::default()).expect("sound");
        for (t, tau) in log.time.iter().zip(&log.tau[0]) {
            block.drive(Drive {
                torque: vec![*tau],
                ..Drive::default()
            });
            block
                .advance_with(t + STEP, &mut tangent)
                .expect("a motion");
        }
        tangent.state[(0, 2)]
    })
}

#[test]
fn a_search_ends_where_the_cost_is_least() {
    let truth = [2.0, 0.7, 0.5];
    let mut log = log(4.0);
    let mut block =
        Integrator::new(Cogged(truth), &[0.2], &[0.5], Tolerances::default()).expect("sound");
    for (k, &t) in log.time.iter().enumerate() {
        log.q[0][k] = block.q()[0];
        block.drive(Drive {
            torque: vec![log.tau[0][k]],
            ..Drive::default()
        });
        block.advance(t + STEP).expect("a motion");
    }
    let [exact, coarse] = slopes(&log, truth);
    assert!((coarse / exact - 1.0).abs() > 1e-4, "{coarse} of {exact}");
    let log = noisy(log, 1e-3, 7);
    let recordings = [Recording::new(&log, &[1.0], 0.0, Vec::new())];
    let names = ["m", "c", "a"].map(str::to_owned);
    for search in [Search::LevenbergMarquardt, Search::TrustRegion] {
        let settings = OutputError { search, ..HELD };
        let start = [2.01, 0.69, 0.49];
        let found = settings
            .fit(&Cogged(start), &names, &start, &recordings, &mut |_| ())
            .expect("an estimate");
        let cost = |values: [f64; 3]| {
            let near = settings.compare(&Cogged(values), &values, &recordings);
            near.expect("a motion").position[0].rmse.powi(2)
        };
        for k in 0..3 {
            let deviation = found.std[k].expect("each is told");
            // Of a parabola through three places, in deviations.
            let at = |steps: f64| {
                let mut values = [found.values[0], found.values[1], found.values[2]];
                values[k] += steps * deviation;
                cost(values)
            };
            let [low, middle, high] = [-0.5, 0.0, 0.5].map(at);
            let least = 0.25 * (low - high) / (low - 2.0 * middle + high);
            assert!(
                least.abs() < 0.02,
                "{search:?}, {}: {least} deviations further",
                names[k]
            );
        }
        let last = found.iterates.last().expect("iterates");
        assert_eq!(last.values, found.values);
    }
}
