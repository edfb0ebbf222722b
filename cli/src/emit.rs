//! `robot-model emit`: an arm's equations as source code.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use robot_model_codegen::Origin;
use robot_model_codegen::emit::c::{Prefix, PrefixError};
use robot_model_codegen::emit::{self, Extent};

use crate::Error;
use crate::hinted::{Hinted, Hints};
use crate::output::{self, Files, OutFile};
use crate::parameters;
use crate::spec::compile_instantaneous;

/// Write an arm's equations as source code.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model emit arm.robot --lang rust --out src
  robot-model emit arm.robot --lang c --out src --name left_arm
  robot-model emit arm.robot --lang rust --out src --functions torque --parameters fit.json")]
pub(crate) struct Emit {
    /// The `.robot` file.
    spec: PathBuf,
    /// Language of the code.
    #[arg(long, ignore_case = true, value_parser = Hinted::<Language>::new(LANGUAGE_HINTS))]
    lang: Language,
    /// Folder to write to, created if missing. A Rust file is named after the spec, C files after the robot or `--name`.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// C only: name of the files and prefix of C names, instead of the robot's name. Arms in one program need different names.
    #[arg(long, value_parser = prefix)]
    name: Option<Prefix>,
    /// Functions to write.
    #[arg(long, value_enum, default_value_t)]
    functions: Functions,
    /// Values by name, or what `identify --json` writes: numbers in the equations instead of arguments.
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
    /// C99, a header and a source that need only libm; also for C++.
    C,
}

fn prefix(text: &str) -> Result<Prefix, String> {
    Prefix::new(text).map_err(|reason| match reason {
        PrefixError::Spelling { .. } => reason.to_string(),
        _ => format!("{reason}; write `{}`, say", Prefix::of_robot(text).as_str()),
    })
}

/// Words for a language that the code of another one serves.
const LANGUAGE_HINTS: Hints = &[(
    &["c++", "cpp", "cxx", "cc"],
    "write `c`: the C code compiles as C++ too",
)];

impl Emit {
    pub(crate) fn run(&self) -> Result<(), Error> {
        if let (Language::Rust, Some(name)) = (self.lang, &self.name) {
            return Err(Error::Argument(format!(
                "`--name` belongs to `--lang c`; Rust code is named by the module that includes it: `mod {} {{ include!(..) }}`",
                name.as_str()
            )));
        }
        let compiled = compile_instantaneous(&self.spec)?;
        let compiled = match &self.parameters {
            Some(file) => {
                let values = parameters::resolve(&compiled, Some(file))?;
                let mut arm = compiled
                    .baked(&values.beta, &values.shapes)
                    .map_err(|error| Error::json(file, &error))?;
                arm.origin = Some(Origin {
                    file: file.display().to_string(),
                    given: values.given,
                    from_spec: values.from_spec.len(),
                });
                arm
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
                let name = self.name.clone();
                let name = name.unwrap_or_else(|| Prefix::of_robot(&compiled.model.name));
                if let Some(reason) = name.refused() {
                    output::say(&format!(
                        "note: C names start with `{}`, as {reason}; `--name NAME` chooses others",
                        name.as_str()
                    ));
                }
                let code = emit::c::code_named(&compiled, extent, name);
                let name = code.name.as_str();
                let file = |extension: &str| PathBuf::from(format!("{name}.{extension}"));
                vec![(file("h"), code.header), (file("c"), code.source)]
            }
        };
        self.write(&code)
    }

    /// The folder to write to.
    fn make_folder(&self) -> Result<(), Error> {
        fs::create_dir_all(&self.out).map_err(|error| {
            let file = self.out.ancestors().find(|path| path.is_file());
            let reason = match file {
                Some(file) => {
                    let it = if file == self.out {
                        "it".to_owned()
                    } else {
                        format!("`{}`", file.display())
                    };
                    format!(
                        "{it} is a file, but `--out` takes a folder; files in it are named after the robot or the spec"
                    )
                }
                None => error.to_string(),
            };
            Error::Write {
                path: self.out.clone(),
                reason,
            }
        })
    }

    /// All files, or none where one of them cannot be written.
    fn write(&self, code: &[(PathBuf, String)]) -> Result<(), Error> {
        let inputs = std::iter::once(&self.spec).chain(&self.parameters);
        let mut files = Files::reading(inputs.map(PathBuf::as_path));
        let mut claimed = Vec::new();
        for (name, text) in code {
            let path = self.out.join(name);
            self.make_folder()?;
            let file = files.claim(&path)?;
            refuse_what_others_wrote(&path)?;
            claimed.push((file, text, path));
        }
        let mut told = String::new();
        for (_, _, path) in &claimed {
            writeln!(told, "{}", path.display()).expect("a string takes all");
        }
        let files = claimed
            .into_iter()
            .map(|(file, text, _)| (file, text.as_bytes()));
        OutFile::commit_all(files.collect())?;
        output::print(&told)
    }
}

/// A page may take the place of a page, and of nothing else.
fn refuse_what_others_wrote(path: &Path) -> Result<(), Error> {
    match fs::read(path) {
        Ok(bytes) if !bytes.is_empty() && !bytes.starts_with(emit::MARK.as_bytes()) => {
            Err(Error::Write {
                path: path.to_owned(),
                reason: "it exists and was not generated: give another `--out`, or remove it"
                    .to_owned(),
            })
        }
        _ => Ok(()),
    }
}

/// `arm.rs` for `arm.robot`.
fn file_name(spec: &Path) -> PathBuf {
    Path::new(spec.file_name().unwrap_or(spec.as_os_str())).with_extension("rs")
}
