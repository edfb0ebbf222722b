//! `robot-model emit`: an arm's equations as source code.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use robot_model_codegen::emit::{self, Extent};

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
    /// Folder to write to, made where it is missing. A Rust file is called as the spec is, C files as the robot is.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Which functions.
    #[arg(long, value_enum, default_value_t)]
    functions: Functions,
    /// Values by name, or what `identify --json` writes: numbers in the equations, in place of arguments.
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
    /// C99, a header and a source, which need nothing but libm; for C++ too.
    C,
}

impl Emit {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let compiled = compile_instantaneous(&self.spec)?;
        let compiled = match &self.parameters {
            Some(file) => {
                let values = parameters::resolve(&compiled, Some(file))?;
                let kept = compiled.base.kept.iter();
                let beta: Vec<f64> = kept.map(|&k| values.parameters[k]).collect();
                compiled.baked(&beta, &values.shapes)
            }
            None => compiled,
        };
        let extent = self.functions.into();
        let code = match self.lang {
            Language::Rust => vec![(
                file_name(&self.spec),
                emit::rust::module_of(&compiled, extent),
            )],
            Language::C => {
                let code = emit::c::code_of(&compiled, extent);
                let file = |extension: &str| PathBuf::from(format!("{}.{extension}", code.name));
                vec![(file("h"), code.header), (file("c"), code.source)]
            }
        };
        self.write(&code)
    }

    /// All files, or none where one of them cannot be written.
    fn write(&self, code: &[(PathBuf, String)]) -> Result<(), Error> {
        let inputs = std::iter::once(&self.spec).chain(&self.parameters);
        let mut files = Files::reading(inputs.map(PathBuf::as_path));
        let mut claimed = Vec::new();
        for (name, text) in code {
            let path = self.out.join(name);
            fs::create_dir_all(&self.out).map_err(|error| Error::write(&path, &error))?;
            claimed.push((files.claim(&path)?, text, path));
        }
        for (file, text, path) in claimed {
            file.commit(text.as_bytes())?;
            output::print(&format!("{}\n", path.display()))?;
        }
        Ok(())
    }
}

/// `arm.rs` for `arm.robot`.
fn file_name(spec: &Path) -> PathBuf {
    Path::new(spec.file_name().unwrap_or(spec.as_os_str())).with_extension("rs")
}
