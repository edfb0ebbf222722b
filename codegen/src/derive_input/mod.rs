//! `#[derive(RobotModel)]`: a struct whose fields hold the unknowns of a robot.
//!
//! In: the struct, and the files that it names. Out: `impl RobotModel` for it, `impl FromParameters` where a vector of
//! parameters determines the fields, `impl Memory` where effects have states. Attributes are put together to the text of a spec, token by token, so a mistake is told
//! where it was written, in the words of the language. After a mistake the implementation is a stub: rustc has nothing to
//! add.
//!
//! ```text
//! #[derive(RobotModel)]
//! #[robot(convention = standard_dh, gravity = [0, -9.81, 0], effects = "own.robot")]
//! struct Arm {
//!     #[joint(revolute, a = 0.5, alpha = 0, d = 0, position = -2 .. 2)]
//!     #[inertial(nominal, mass = 1.2, com = [0, 0, 0], inertia = [..])]
//!     #[effects(stribeck(vs = 0.1))]                         // first values of shape parameters
//!     shoulder: Link<(ViscousFriction, Stribeck)>,           // ten inertial parameters, and the effects on the joint
//!     #[joint(revolute, a = 0.4, alpha = 0, d = 0)]
//!     #[inertial(fixed, mass = 1.2, com = [0, 0, 0], inertia = [..])]
//!     elbow: ViscousFriction,                                // the inertial is known: effects only
//!     #[on(shoulder, elbow)]
//!     coupling: GearCoupling,                                // an effect of two joints
//!     #[on()]
//!     base_tilt: BaseTilt,                                   // an effect on the arm as a whole
//! }
//!
//! #[derive(RobotModel)]
//! #[robot(file = "phantom.robot")]                           // chains and energies alike
//! struct Phantom { m1: f64, m2: f64, th1: ViscousFriction }  // unknown constants, and effects on a coordinate
//! ```

mod bind;
mod fields;
#[cfg(test)]
mod goldens;
mod holds;
mod mistake;
mod source;
mod stub;
#[cfg(test)]
mod tests;
pub mod types;
mod value;

use std::io;

use proc_macro2::TokenStream;
use quote::quote;
use robot_model_spec::Model;
use syn::DeriveInput;

use crate::base::shape_values;
use crate::compiled::compile_model;
use crate::emit;
use crate::measured::NotInstantaneous;
use fields::Robot;
use mistake::mistake;

/// Reads a file that an attribute names, relative to the crate's folder.
pub type ReadFile<'a> = &'a dyn Fn(&str) -> io::Result<String>;

/// What the derive writes; mistakes become `compile_error!` where they were made.
#[must_use]
pub fn derive(input: TokenStream, read: ReadFile<'_>) -> TokenStream {
    let input: DeriveInput = match syn::parse2(input) {
        Ok(input) => input,
        Err(error) => return error.to_compile_error(),
    };
    match implementation(&input, read) {
        Ok(tokens) => tokens,
        Err(error) => {
            let error = error.to_compile_error();
            let stub = stub::implementation(&input, read);
            // rustc would say of a file that is not there what we have said already.
            let tracked = fields::files(&input)
                .filter(|file| read(file).is_ok())
                .map(|file| track(&file));
            quote!(#error #stub #(#tracked)*)
        }
    }
}

fn implementation(input: &DeriveInput, read: ReadFile<'_>) -> syn::Result<TokenStream> {
    let robot = Robot::new(input)?;
    let mut model = source::model(&robot, read)?;
    check_reach(&robot, &model)?;
    // The value holds every shape parameter; what the spec says of one is where it starts.
    let nominal = shape_values(&model);
    for effect in &mut model.effects {
        effect.shapes.fill(None);
    }
    let places = bind::bind(&robot, &model)?;
    let compiled = compile_model(&model);
    if !compiled.base.rank.is_clear() {
        return Err(mistake(robot.name.span(), &compiled.base.rank));
    }
    let parameters = value::parameters(&robot, &compiled, &places);
    let implementation =
        emit::rust::implementation_for(&compiled, robot.name, &parameters, &nominal);
    let tracked = fields::files(input).map(|file| track(&file));
    Ok(quote!(#implementation #(#tracked)*))
}

/// What has no equation of one instant has no function. Said before anything about fields, which would be of no use.
fn check_reach(robot: &Robot, model: &Model) -> syn::Result<()> {
    let mut effects = model.effects.iter();
    match effects.position(|effect| effect.definition.moves_links()) {
        Some(index) => {
            let effect = &model.effects[index].definition.name;
            let types = robot.fields.iter().flat_map(|field| field.holds.effects());
            let place = types
                .filter(|one| one.effect == effect)
                .map(|one| one.effect.span())
                .next();
            let reason = NotInstantaneous::new(model, index).reason();
            Err(mistake(place.unwrap_or(robot.name.span()), reason))
        }
        None => Ok(()),
    }
}

/// Cargo rebuilds when a file changes that the source includes.
fn track(file: &str) -> TokenStream {
    quote! {
        const _: &[u8] = ::core::include_bytes!(::core::concat!(::core::env!("CARGO_MANIFEST_DIR"), "/", #file));
    }
}
