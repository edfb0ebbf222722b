//! `#[derive(RobotModel)]`: one call into `robot-model-codegen`, where the attributes are described.

use proc_macro::TokenStream;

/// Implements `robot_model::RobotModel` for a struct whose fields are the joints of an arm.
#[proc_macro_derive(RobotModel, attributes(robot, joint, inertial, effects))]
pub fn derive_robot_model(input: TokenStream) -> TokenStream {
    robot_model_codegen::derive_input::derive(input.into()).into()
}
