use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(file = "specs/energies.robot")]
struct Rod {
    m: f32,
    c: Link,
}

#[derive(RobotModel)]
#[robot(file = "specs/energies.robot")]
struct Other {
    m: f64,
    c: Link,
    length: Link,
}

fn main() {}
