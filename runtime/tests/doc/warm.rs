// The arm of the documentation's examples of effects that read a channel, which include this file.

use core::f64::consts::{FRAC_PI_2, LN_2};

use robot_model::effects::TemperatureViscous;
use robot_model::{Link, RobotModel, State, Vector};

/// A pendulum in a vertical plane, with a gear in oil.
#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
pub struct Warm {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pub pivot: Link<TemperatureViscous>,
}

/// `tau = 0.5 ddq + 0.4 2^(-(T - 20) / 20) dq + 9.81 cos(q)`: 2 kg at the tip, and friction that halves every 20 K.
pub fn warm() -> Warm {
    let oil = TemperatureViscous { fv: 0.4, beta: 0.05 * LN_2 };
    Warm { pivot: Link::new(2.0, [0.0; 3], [0.0; 6]).with(oil) }
}

/// Upright at 40 degrees Celsius, with `dq = 3` and `ddq = 2`.
pub fn moving() -> State<1, 0, 1> {
    State::new(Vector::from([FRAC_PI_2]), Vector::from([3.0]), Vector::from([2.0])).with_inputs(Vector::from([40.0]))
}
