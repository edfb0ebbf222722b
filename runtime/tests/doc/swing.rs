use robot_model::RobotModel;

/// Two rods of 0.5 m, y up, with a point at the end of the lower one.
#[derive(Clone, Copy, RobotModel)]
#[robot(file = "tests/doc/swing.robot")]
pub struct Swing {
    pub m: f64,
}

pub const SWING: Swing = Swing { m: 2.0 };
