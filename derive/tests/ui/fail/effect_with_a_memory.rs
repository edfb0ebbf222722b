use robot_model::RobotModel;

#[derive(RobotModel)]
#[robot(file = "specs/memory.robot")]
struct Arm {}

fn main() {}
