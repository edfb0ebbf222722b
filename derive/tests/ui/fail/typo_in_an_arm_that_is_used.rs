use robot_model::effects::LugrePresliding;
use robot_model::{Kinematics, Link, Mechanics, Memory, RobotModel, State, Vector};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravty = [0, 0, 0])]
struct Arm {
    #[joint(revolute, a = 0, alpha = 0, d = 0)]
    pivot: Link<LugrePresliding>,
}

fn main() {
    let arm = Arm { pivot: Link::default().with(LugrePresliding::default()) };
    let state = State::at_rest(Vector::from([0.1])).with_memory(Vector::from([0.0]));
    let tau = arm.inverse_dynamics_at(&state);
    let ddq = arm.forward_dynamics_at(&state, &tau);
    println!("{:?} {tau} {ddq:?} {} {}", Arm::STATES, arm.memory_after(&state, 1e-3), arm.jacobian(&state.q));
}
