use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(file = "specs/pendulum.robot", file = "specs/other.robot")]
struct Arm {
    pivot: Link,
}

fn main() {}
