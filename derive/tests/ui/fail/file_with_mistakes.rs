use robot_model::{Link, RobotModel, Vector};

#[derive(RobotModel)]
#[robot(file = "specs/mistaken.robot")]
struct Arm {
    pivot: Link,
}

fn main() {
    let q = Vector::from([0.0]);
    let arm = Arm { pivot: Link::new(1.0, [0.0; 3], [0.0; 6]) };
    let _ = arm.gravity(&q);
}
