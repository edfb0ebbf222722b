use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct Arm {
    #[joint()]
    pivot: Link,
}

fn main() {}
