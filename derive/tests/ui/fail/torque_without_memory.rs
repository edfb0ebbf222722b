use robot_model::effects::Dahl;
use robot_model::{Link, RobotModel, Vector};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, 0, 0])]
struct Arm {
    #[joint(revolute, a = 0, alpha = 0, d = 0)]
    pivot: Link<Dahl>,
}

fn torque(arm: &Arm, q: Vector<1>) -> Vector<1> {
    arm.inverse_dynamics(&q, &q, &q)
}

fn main() {}
