use robot_model::RobotModel;

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct Arm<T> {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pivot: T,
}

fn main() {}
