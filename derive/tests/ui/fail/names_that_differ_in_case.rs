use robot_model::RobotModel;
use robot_model::effects::ViscousFriction;

#[derive(RobotModel)]
#[robot(file = "specs/cases.robot")]
struct Arm {
    m: f64,
    x: ViscousFriction,
}

fn main() {}
