//! Our contender of an arm: emitted functions in a crate of its own, built by cargo as a user builds them.
//!
//! A crate of its own because flags are the crate's: once with those of a plain `cargo build --release`, once with
//! `-C target-cpu=native`, which is what the peers' compilers get.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use robot_model_codegen::Compiled;
use robot_model_codegen::emit::{Extent, rust};

use crate::arm::{Arm, FUNCTIONS, workspace};
use crate::given;
use crate::{Error, failed};

/// Flags of the compiler.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flags {
    /// What a user gets without asking.
    Plain,
    /// For this machine.
    Native,
}

impl Flags {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Plain, Self::Native];

    /// Name of the folder that cargo builds in.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Native => "native",
        }
    }

    fn rustflags(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Native => "-C target-cpu=native",
        }
    }
}

/// Scalars that a function is called with: name of the form, type.
const SCALARS: [(&str, &str); 3] = [("", "f64"), ("lanes4", "Lanes4"), ("lanes8", "Lanes8")];

/// Name of a case: `inverse_dynamics/baked`, `gravity/lanes8/given`.
#[must_use]
pub fn case(function: &str, form: &str, given: bool) -> String {
    let given = if given { "/given" } else { "" };
    format!("{function}/{form}{given}")
}

/// Writes the crate with one program an arm and builds it; `[plain, native]` folders of executables.
///
/// # Errors
/// A folder that cannot be written, an emitted page that cannot be rewritten, a build that fails.
pub fn build(folder: &Path, arms: &[Arm]) -> Result<[PathBuf; 2], Error> {
    let root = folder.join("ours");
    let write = |name: &str, text: &str| {
        let path = root.join(name);
        if fs::read_to_string(&path).is_ok_and(|old| old == text) {
            return Ok(());
        }
        let made = path.parent().map_or(Ok(()), fs::create_dir_all);
        made.and_then(|()| fs::write(&path, text))
            .map_err(|error| failed("write", &path, error))
    };
    write("Cargo.toml", &manifest("ours"))?;
    write("src/lib.rs", include_str!("../ours/src/contender.rs"))?;
    for arm in arms {
        write(&format!("src/bin/{}.rs", arm.name), &program(arm)?)?;
    }
    crate::build::lock(&workspace().join("Cargo.lock"), &root)?;
    let mut targets = Flags::ALL.map(|flags| folder.join(flags.name()));
    for (flags, target) in Flags::ALL.into_iter().zip(&mut targets) {
        compile(&root, target, flags)?;
        target.push("release");
    }
    Ok(targets)
}

fn compile(root: &Path, target: &Path, flags: Flags) -> Result<(), Error> {
    let status = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args([
            "build",
            "--release",
            "--offline",
            "--quiet",
            "--bins",
            "--target-dir",
        ])
        .arg(target)
        .current_dir(root)
        .env("RUSTFLAGS", flags.rustflags())
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .status()
        .map_err(|error| failed("run cargo in", root, error))?;
    if status.success() {
        return Ok(());
    }
    Err(failed("build", root, "cargo says why above"))
}

/// Of a crate that depends on the runtime, and on nothing else.
pub(crate) fn manifest(name: &str) -> String {
    format!(
        "[package]
name = \"{name}\"
version = \"0.0.0\"
edition = \"2024\"

[dependencies]
robot-model = {{ path = '{}', default-features = false, features = ['std'] }}

[workspace]
",
        workspace().join("runtime").display()
    )
}

/// Source of the program for an arm.
fn program(arm: &Arm) -> Result<String, Error> {
    let page = |compiled: &Compiled| {
        given::functions(&rust::module_of(compiled, Extent::Torque), &FUNCTIONS)
    };
    let (runtime, baked) = (page(&arm.runtime)?, page(&arm.baked)?);
    let mut text = String::from(
        "#![allow(clippy::all, unused)]
use std::marker::PhantomData;

use ours::{Case, Maker, Number};
use robot_model::Scalar;
use robot_model::scalar::{Lanes4, Lanes8};

",
    );
    let put = "a string takes text";
    for (name, page) in [("runtime", &runtime), ("baked", &baked)] {
        writeln!(
            text,
            "mod {name} {{\nuse robot_model::Scalar;\n{}}}\n",
            page.text
        )
        .expect(put);
    }
    let (count, beta) = (arm.beta.len(), &arm.beta);
    writeln!(
        text,
        "const BETA: [f64; {count}] = {beta:?};\n\nfn beta<S: Scalar>() -> [S; {count}] {{\n    BETA.map(S::of)\n}}\n"
    )
    .expect(put);
    writeln!(text, "fn main() {{\n    let makers: &[Maker] = &[").expect(put);
    for (form, scalar) in SCALARS {
        for function in &baked.functions {
            let form = if form.is_empty() { "baked" } else { form };
            text.push_str(&cases(arm, "baked", function, form, scalar));
        }
    }
    for function in &runtime.functions {
        // A regressor has no parameters: both forms are one function, which is timed once.
        if !function.1.iter().any(|argument| argument == "beta") {
            continue;
        }
        text.push_str(&cases(arm, "runtime", function, "runtime", "f64"));
    }
    text.push_str("    ];\n    ours::serve(makers);\n}\n");
    Ok(text)
}

/// A function with its sines, and with them given.
fn cases(
    arm: &Arm,
    module: &str,
    (function, arguments): &(String, Vec<String>),
    form: &str,
    scalar: &str,
) -> String {
    let has_beta = arguments.iter().any(|argument| argument == "beta");
    let list = |beta: &str| {
        let words = arguments.iter().map(|argument| match argument.as_str() {
            "beta" => beta.to_owned(),
            motion => format!("&x.{motion}"),
        });
        words.collect::<Vec<String>>().join(", ")
    };
    let (name, given) = (case(function, form, false), case(function, form, true));
    let (dof, beta) = (arm.dof(), if has_beta { "beta()" } else { "()" });
    let rest = format!("parameters: {beta}, scalar: PhantomData::<{scalar}>");
    let (inside, outside) = (list("p"), list("&beta()"));
    format!(
        "        ({name:?}, |states| {{
            let states = states.of::<{dof}, {scalar}>();
            let given = vec![(); states.len()];
            Box::new(Case {{ states, given, call: |x, (), p| {module}::{function}({inside}), {rest} }})
        }}),
        ({given:?}, |states| {{
            let states = states.of::<{dof}, {scalar}>();
            let given = states.iter().map(|x| {scalar}::sines_cosines({module}::{function}_angles({outside}))).collect();
            Box::new(Case {{ states, given, call: |x, given, p| {module}::{function}_given({inside}, given), {rest} }})
        }}),
"
    )
}
