use robot_model::RobotModel;

#[derive(RobotModel)]
#[robot(file = "specs/pendulum.robot")]
struct Arm {}

fn main() {}
