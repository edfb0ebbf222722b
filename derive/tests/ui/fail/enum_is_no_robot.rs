use robot_model::RobotModel;

#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
enum Arm {
    Left,
    Right,
}

fn main() {}
