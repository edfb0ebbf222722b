use robot_model::RobotModel;

#[derive(RobotModel)]
#[robot(file = "/robots/arm.robot")]
struct Arm {}

fn main() {}
