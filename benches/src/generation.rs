//! How long the compiler takes, and rustc with what it writes; and how both grow with the number of joints.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use robot_model_codegen::emit::rust;
use robot_model_codegen::{Compiled, compile_model};
use syn::{GenericParam, Item};

use crate::arm::{Arm, workspace};
use crate::report::{Generation, Growth};
use crate::{Error, failed, ours};

/// Joints of the chains.
const CHAINS: [usize; 4] = [5, 10, 20, 40];

/// Generation and compilation of all functions of an arm, its effects among them.
///
/// # Errors
/// A spec that cannot be read or does not pass, a crate that cannot be written or built.
pub fn of_arm(folder: &Path, name: &str) -> Result<Generation, Error> {
    let path = Arm::spec(name);
    let text = fs::read_to_string(&path).map_err(|error| failed("read", &path, error))?;
    let (page, _, seconds) = generated(name, &text)?;
    Ok(Generation {
        robot: name.to_owned(),
        seconds,
        rustc_seconds: rustc(folder, &page)?,
    })
}

/// Chains of several lengths.
///
/// # Errors
/// None, as long as the language takes such chains.
pub fn growth() -> Result<Vec<Growth>, Error> {
    let grown = CHAINS.map(|joints| {
        let (_, compiled, seconds) = generated("chain", &chain(joints))?;
        let cost = Arm::cost(&compiled, "inverse_dynamics")?;
        Ok(Growth {
            joints,
            inverse_dynamics: cost.mul + cost.add,
            seconds,
        })
    });
    grown.into_iter().collect()
}

/// From text to the page of all functions, and the seconds that it took.
fn generated(name: &str, text: &str) -> Result<(String, Compiled, f64), Error> {
    let start = Instant::now();
    let model =
        robot_model_spec::load(name, text).map_err(|errors| Error::new(errors.to_string()))?;
    let compiled = compile_model(&model);
    let page = rust::module(&compiled);
    Ok((page, compiled, start.elapsed().as_secs_f64()))
}

/// An arm with axes that are turned by quarters and arms between them, as industrial ones are.
fn chain(joints: usize) -> String {
    let mut text = String::from(
        "robot Chain {\n    gravity = [0, 0, -9.81];\n    convention = standard_dh;\n",
    );
    for joint in 1..=joints {
        let (a, alpha, d) = if joint % 2 == 0 {
            (0.4, "90 deg", 0.0)
        } else {
            (0.0, "-90 deg", 0.3)
        };
        writeln!(
            text,
            "    joint j{joint}: revolute {{ a = {a}; alpha = {alpha}; d = {d}; }}"
        )
        .expect("a string takes text");
    }
    text.push_str("}\n");
    text
}

/// Seconds that rustc takes for the page alone, in release, with all functions compiled for `f64`.
fn rustc(folder: &Path, page: &str) -> Result<f64, Error> {
    let root = folder.join("generation");
    let source = root.join("src/lib.rs");
    let text = format!("#![allow(clippy::all, unused)]\n{page}\n{}", used(page)?);
    let write = |path: &Path, text: &str| {
        fs::write(path, text).map_err(|error| failed("write", path, error))
    };
    fs::create_dir_all(root.join("src")).map_err(|error| failed("make", &root, error))?;
    write(&root.join("Cargo.toml"), &ours::manifest("generation"))?;
    crate::build::lock(&workspace().join("Cargo.lock"), &root)?;
    let build = || {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        command.args(["build", "--release", "--offline", "--quiet", "--target-dir"]);
        // Where the plain build of ours has its dependencies.
        command
            .arg(folder.join(ours::Flags::Plain.name()))
            .current_dir(&root)
            .env("RUSTFLAGS", "")
            .env_remove("CARGO_ENCODED_RUSTFLAGS");
        crate::build::run(&mut command)
    };
    // What the page depends on is built with another text in its place.
    write(&source, "")?;
    build()?;
    write(&source, &text)?;
    let start = Instant::now();
    build()?;
    Ok(start.elapsed().as_secs_f64())
}

/// Rust that has all free functions of a page compiled for `f64`: generic functions are not until somebody uses them, and who does
/// is not either, where it may be inlined elsewhere.
fn used(page: &str) -> Result<String, Error> {
    let file = syn::parse_file(page)
        .map_err(|error| Error::new(format!("an emitted page does not parse: {error}")))?;
    let functions = file.items.iter().filter_map(|item| match item {
        Item::Fn(function) => Some(function),
        _ => None,
    });
    let mut names = Vec::new();
    for function in functions {
        let parameters = function.sig.generics.params.iter();
        let types = parameters.filter(|it| matches!(it, GenericParam::Type(_)));
        let name = &function.sig.ident;
        names.push(match types.count() {
            0 => format!("{name} as *const ()"),
            1 => format!("{name}::<f64> as *const ()"),
            _ => {
                return Err(Error::new(format!(
                    "`{name}` has several types: teach `benches/src/generation.rs` which"
                )));
            }
        });
    }
    let (count, names) = (names.len(), names.join(", "));
    Ok(format!(
        "#[inline(never)]\npub fn used() -> [*const (); {count}] {{\n    [{names}]\n}}\n"
    ))
}

#[cfg(test)]
mod tests {
    use super::{Arm, chain, generated, used};

    #[test]
    fn all_functions_are_used() {
        let page = "fn a<S: Scalar>(q: &[S; 2]) -> S { q[0] } pub fn b() {} struct Arm;";
        let text = used(page).expect("both are known");
        assert!(
            text.contains("#[inline(never)]\npub fn used() -> [*const (); 2]"),
            "{text}"
        );
        assert!(
            text.contains("[a::<f64> as *const (), b as *const ()]"),
            "{text}"
        );
        let error = used("fn c<S, T>() {}").expect_err("two types").to_string();
        assert!(error.contains("`c`"), "{error}");
    }

    #[test]
    fn chains_are_robots() {
        let (page, compiled, _) = generated("chain", &chain(2)).expect("a spec");
        assert_eq!(compiled.dof(), 2);
        let error = Arm::cost(&compiled, "nothing").expect_err("no such function");
        assert!(error.to_string().contains("`nothing`"), "{error}");
        assert!(
            used(&page)
                .expect("emitted")
                .contains("inverse_dynamics::<f64>")
        );
    }
}
