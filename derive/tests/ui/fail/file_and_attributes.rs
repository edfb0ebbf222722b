use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(file = "specs/pendulum.robot", gravity = [0, 0, 0])]
struct Arm {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pivot: Link,
}

fn main() {}
