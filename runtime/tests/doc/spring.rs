// The rows of the documentation's examples of least squares, which include this file.

use robot_model::columns::Unknown;
use robot_model::identify::{JointRows, Stack};

pub fn unknown(name: &str) -> Unknown {
    Unknown {
        name: name.to_owned(),
        nonnegative: true,
    }
}

/// `tau = k q + fc sign(dq)` at `q = 0.25`, on the way there and back: 3 N m and 2 N m, so `k = 10` and `fc = 0.5`.
pub fn spring() -> Stack {
    let tau = vec![3.0, 2.0];
    let columns = vec![(0, vec![0.25, 0.25]), (1, vec![1.0, -1.0])];
    Stack {
        unknowns: vec![unknown("k"), unknown("fc")],
        joints: vec![JointRows {
            target: tau.clone(),
            tau,
            columns,
        }],
        ..Stack::default()
    }
}
