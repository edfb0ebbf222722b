//! An arm whose effects remember and read channels.

use robot_model::effects::{LugrePresliding, TemperatureViscous};
use robot_model::{Link, Memory, RobotModel, State, Vector};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, 0, 0])]
struct Arm {
    #[joint(revolute, a = 0, alpha = 0, d = 0)]
    pivot: Link<(LugrePresliding, TemperatureViscous)>,
}

fn main() {
    let arm = Arm {
        pivot: Link::default().with((LugrePresliding::default(), TemperatureViscous::default())),
    };
    assert_eq!(Arm::STATES, ["pivot.lugre_presliding.z"]);
    assert_eq!(Arm::INPUTS, ["temperature"]);
    let state = State::at_rest(Vector::from([0.1]))
        .with_memory(Vector::zeros())
        .with_inputs(Vector::from([35.0]));
    assert_eq!(arm.memory_after(&state, 1e-3), Vector::from([0.0]));
    assert_eq!(arm.inverse_dynamics_at(&state), Vector::from([0.0]));
}
