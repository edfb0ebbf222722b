use robot_model::excite::{Clearance, Function, Tell};
use robot_model::motion::Kinematics;

/// Height of the tip of an arm of 0.5 m, `0.5 sin(q)`, m.
#[derive(Debug)]
pub struct Height;

impl Function for Height {
    fn outputs(&self) -> usize {
        1
    }
    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>> {
        vec![motion.q[0].iter().map(|q| 0.5 * q.sin()).collect()]
    }
    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics {
        let pairs = motion.q[0].iter().zip(&weights[0]);
        let still = vec![vec![0.0; motion.q[0].len()]];
        Kinematics {
            q: vec![pairs.map(|(q, weight)| 0.5 * q.cos() * weight).collect()],
            dq: still.clone(),
            ddq: still,
        }
    }
}

/// At 0 and at 1 rad.
pub fn raised() -> Kinematics {
    let still = vec![vec![0.0; 2]];
    Kinematics {
        q: vec![vec![0.0, 1.0]],
        dq: still.clone(),
        ddq: still,
    }
}

/// The tip stays above a table, which is at -0.2 m.
#[derive(Debug)]
pub struct AboveTable;

impl Clearance for AboveTable {
    fn function(&self) -> &dyn Function {
        &Height
    }
    fn slacks(&self, values: &[f64], tell: Tell<'_>) {
        tell(0, values[0] + 0.2, &[(0, 1.0)]);
    }
    fn name(&self, _which: usize) -> String {
        "height above the table".to_owned()
    }
    fn amount(&self, slack: f64) -> String {
        format!("{:.0} mm", -1000.0 * slack)
    }
}
