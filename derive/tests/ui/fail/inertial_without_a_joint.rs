use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct Arm {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pivot: Link,
    #[inertial(fixed, mass = 1, com = [0, 0, 0], inertia = [0, 0, 0, 0, 0, 0.01])]
    tip: Link,
}

fn main() {}
