use robot_model::RobotModel;

#[derive(RobotModel)]
#[robot(file = 12)]
struct Arm {}

fn main() {}
