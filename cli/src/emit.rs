//! `robot-model emit`: an arm's equations as source code.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use robot_model_codegen::emit::rust::Extent;
use robot_model_codegen::{Compiled, emit};

use crate::Error;
use crate::output::{self, Files};
use crate::parameters;
use crate::spec::compile_instantaneous;

/// Write an arm's equations as source code.
#[derive(Debug, Args)]
pub(crate) struct Emit {
    /// The `.robot` file.
    spec: PathBuf,
    /// Language of the code.
    #[arg(long, value_enum)]
    lang: Language,
    /// Folder to write to, made where it is missing; the file is called as the spec is.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Which functions.
    #[arg(long, value_enum, default_value_t)]
    functions: Functions,
    /// Values by name, or what `identify --json` writes: they become the constant `BETA`.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum Functions {
    /// All of them.
    #[default]
    All,
    /// Torque and its regressors, without energies, momentum, forward dynamics, slopes and kinematics.
    Torque,
}

impl From<Functions> for Extent {
    fn from(functions: Functions) -> Self {
        match functions {
            Functions::All => Self::All,
            Functions::Torque => Self::Torque,
        }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Language {
    /// Rust without `std`, for `include!`; needs the crate `robot-model`.
    Rust,
}

impl Emit {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let compiled = compile_instantaneous(&self.spec)?;
        let mut code = match self.lang {
            Language::Rust => emit::rust::module_of(&compiled, self.functions.into()),
        };
        if let Some(file) = &self.parameters {
            code.push_str(&constants(&compiled, file)?);
        }
        let path = self.out.join(file_name(&self.spec));
        fs::create_dir_all(&self.out).map_err(|error| Error::write(&path, &error))?;
        let inputs = std::iter::once(&self.spec).chain(&self.parameters);
        Files::reading(inputs.map(PathBuf::as_path))
            .claim(&path)?
            .commit(code.as_bytes())?;
        output::print(&format!("{}\n", path.display()))
    }
}

/// `arm.rs` for `arm.robot`.
fn file_name(spec: &Path) -> PathBuf {
    Path::new(spec.file_name().unwrap_or(spec.as_os_str())).with_extension("rs")
}

/// Identified values, one a line with its name.
fn constants(compiled: &Compiled, file: &Path) -> Result<String, Error> {
    let names = compiled.shape_names();
    let free: Vec<&str> = compiled
        .free_shapes()
        .into_iter()
        .map(|k| names[k].as_str())
        .collect();
    if let Some(name) = free.first() {
        let source = &compiled.model.source;
        return Err(Error::Argument(format!(
            "{source}: write the value of `{name}` into the spec: in code it is a constant"
        )));
    }
    let values = parameters::resolve(compiled, Some(file))?;
    let base = &compiled.base;
    let mut code = format!(
        "\n/// Base parameters from {}, SI.\npub const BETA: [f64; {}] = [\n",
        file.file_name().unwrap_or(file.as_os_str()).display(),
        base.kept.len()
    );
    for (&k, name) in base.kept.iter().zip(&base.names) {
        writeln!(code, "    {:?}, // {name}", values.parameters[k]).expect("a string takes all");
    }
    code.push_str("];\n");
    Ok(code)
}
