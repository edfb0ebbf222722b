use robot_model::effects::Stribeck;
use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(file = "specs/pendulum.robot", effects = "specs/drag.robot")]
struct Arm {
    #[inertial(fixed, mass = 1, com = [0, 0, 0], inertia = [0, 0, 0, 0, 0, 0.01])]
    #[effects(stribeck(vs = 0.1))]
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pivot: Link<Stribeck>,
}

fn main() {}
