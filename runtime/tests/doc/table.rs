// The arm of the documentation's examples of effects with a memory, which include this file.

use robot_model::effects::Dahl;
use robot_model::{Link, RobotModel, State, Vector};

/// A turntable on bristles.
#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, 0, 0])]
pub struct Table {
    #[joint(revolute, a = 0, alpha = 0, d = 0)]
    pub turn: Link<Dahl>,
}

/// `tau = 2 z` with `dz/dt = (dq - abs(dq) z) / 0.01`
pub fn table() -> Table {
    Table { turn: Link::default().with(Dahl { fc: 2.0, d: 0.01 }) }
}

/// At 0.02 rad/s, with bristles bent by half.
pub fn sliding() -> State<1, 1, 0> {
    State::new(Vector::zeros(), Vector::from([0.02]), Vector::zeros()).with_memory(Vector::from([0.5]))
}
