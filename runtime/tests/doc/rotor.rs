// What the documentation's examples of excitation, which include this file, ask for: a motion of one rotor with a spring.

use robot_model::excite::{Criterion, Ends, Function, Limits, Regressor, Request, Scaling};
use robot_model::motion::Kinematics;

/// Columns of `tau = ia ddq + k q`.
struct Columns;

impl Function for Columns {
    fn outputs(&self) -> usize {
        2
    }
    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>> {
        vec![motion.ddq[0].clone(), motion.q[0].clone()]
    }
    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics {
        Kinematics {
            q: vec![weights[1].clone()],
            dq: vec![vec![0.0; motion.dq[0].len()]],
            ddq: vec![weights[0].clone()],
        }
    }
}

/// 4 s with three harmonics, within 0.5 rad, 2 rad/s and 20 rad/s^2.
pub fn request() -> Request {
    let mut limits = Limits::none(1);
    limits.position[0] = (-0.5, 0.5);
    limits.velocity[0] = 2.0;
    limits.acceleration[0] = 20.0;
    Request {
        joints: vec!["joint".to_owned()],
        regressor: Regressor {
            columns: vec!["ia".to_owned(), "k".to_owned()],
            entries: vec![(0, 0), (0, 1)],
            function: Box::new(Columns),
            exact: Box::new(Columns),
        },
        limits,
        clearances: Vec::new(),
        criterion: Criterion::DOptimal,
        basis: None,
        scaling: Scaling::Raw,
        noise: vec![1.0],
        period: 4.0,
        harmonics: 3,
        ends: Ends::Free,
        starts: 1,
        seed: 1,
    }
}
