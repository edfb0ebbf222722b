use robot_model::effects::{CoulombFriction, GearCoupling, ViscousFriction};
use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(file = "specs/pendulum.robot")]
struct Arm {
    pivot: Link<(ViscousFriction, CoulombFriction)>,
    tip: Link,
    #[on(pivot, tip)]
    coupling: GearCoupling,
    elbow: Link,
}

fn main() {}
