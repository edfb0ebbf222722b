use robot_model::RobotModel;

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct Arm {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pivot: [f64; 10],
}

fn main() {}
