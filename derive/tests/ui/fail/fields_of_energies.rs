use robot_model::effects::ViscousFriction;
use robot_model::{Link, RobotModel};

#[derive(RobotModel)]
#[robot(file = "specs/energies.robot")]
struct Rod {
    m: f64,
    length: f64,
    th: Link<ViscousFriction>,
}

fn main() {}
