use robot_model::effects::ViscousFriction;
use robot_model::{Link, RobotModel};

robot_model::effects!("specs/nearly.robot");

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0], effects = "specs/nearly.robot")]
struct Arm {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pivot: Link<(ViscousFriction, NearlyViscous)>,
}

fn main() {}
