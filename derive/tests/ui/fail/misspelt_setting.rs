use robot_model::{Link, RobotModel, Vector};

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct Arm {
    #[joint(revolute, b = 0.5, alpha = 0, d = 0)]
    pivot: Link,
}

fn main() {
    // The stub answers: rustc adds nothing.
    let q = Vector::from([0.0]);
    let arm = Arm { pivot: Link::new(1.0, [0.0; 3], [0.0; 6]) };
    let _ = arm.inverse_dynamics(&q, &q, &q);
}
