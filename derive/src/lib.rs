//! `#[derive(RobotModel)]` and its macros: one call each into `robot-model-codegen`, where the attributes are described.

use std::io;
use std::path::Path;

use proc_macro::TokenStream;
use robot_model_codegen::derive_input;

/// Implements `robot_model::RobotModel`, and `robot_model::FromParameters` where a vector of parameters determines the
/// fields, for a struct whose fields hold the unknowns of a robot.
///
/// - `#[robot(convention = standard_dh, gravity = [0, 0, -9.81])]` describes a chain in attributes, in the words of the
///   language; `effects = "own.robot"` reads definitions of own effects from a file.
/// - `#[robot(file = "arm.robot")]` describes the robot in a file, relative to the crate's folder: a chain, or energies.
/// - `#[joint(revolute, a = 0.5, alpha = 90 deg, d = 0)]` makes a field a joint: kind, frame, limits, `link = name`.
/// - `#[inertial(nominal, mass = .., com = [..], inertia = [..])]` gives CAD values; `fixed` gives exact ones.
/// - `#[on(shoulder, elbow)]` says which joints the effect in the field acts on.
/// - `#[effects(stribeck(vs = 0.1))]` gives values from which shape parameters start.
///
/// The type of a field says what it holds: `Link` ten inertial parameters, `Link<ViscousFriction>` or
/// `Link<(ViscousFriction, Stribeck)>` effects on its joint besides, effects alone where the inertial is fixed or the robot
/// is described by energies, `f64` an unknown constant of such a robot.
#[proc_macro_derive(RobotModel, attributes(robot, joint, inertial, effects, on))]
pub fn derive_robot_model(input: TokenStream) -> TokenStream {
    derive_input::derive(input.into(), &read).into()
}

/// Types for the parameters of the effects that a file defines: `robot_model::effects!("own.robot");` writes
/// `pub struct Drag { pub f: f64, .. }` for `effect drag(j) { linear f; .. }`. The path is relative to the crate's folder.
#[proc_macro]
pub fn effects(input: TokenStream) -> TokenStream {
    derive_input::types::of_file(input.into(), &read).into()
}

/// Types for the parameters of the standard effects; `robot_model::effects` is made of it.
#[doc(hidden)]
#[proc_macro]
pub fn standard_effects(_: TokenStream) -> TokenStream {
    derive_input::types::standard().into()
}

/// A file of the crate that is being compiled.
fn read(name: &str) -> io::Result<String> {
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::NotFound,
            "Cargo does not say which crate this is",
        )
    })?;
    std::fs::read_to_string(Path::new(&folder).join(name))
}
