use robot_model::effects::ViscousFriction;
use robot_model::{RobotModel, Vector};

#[derive(RobotModel)]
#[robot(file = "specs/energies.robot")]
struct Rod {
    m: f64,
    c: f64,
    th: ViscousFriction,
}

fn main() {
    let rod = Rod { m: 2.0, c: 0.5, th: ViscousFriction { fv: 0.1 } };
    let quarter = Vector::from([std::f64::consts::FRAC_PI_2]);
    assert!((rod.gravity(&quarter)[0] - 9.81).abs() < 1e-12);
}
