use robot_model::effects::Stribeck;
use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct Arm {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    #[effects(Stribeck(vs = 0.1))]
    pivot: Link<Stribeck>,
}

fn main() {}
