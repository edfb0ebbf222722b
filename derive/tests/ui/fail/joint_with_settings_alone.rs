use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct Arm {
    #[joint(a = 0.5, alpha = 0, d = 0)]
    pivot: Link,
}

fn main() {}
