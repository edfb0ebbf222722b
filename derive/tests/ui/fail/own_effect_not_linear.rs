use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, 0, 0], effects = "specs/not_linear.robot")]
struct Arm {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pivot: Link,
}

fn main() {}
