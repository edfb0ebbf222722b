use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(file = "specs/nowhere.robot")]
struct Arm {
    pivot: Link,
}

fn main() {}
