//! `robot-model new`: a spec to start from.

mod text;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_model_codegen::emit::c::Prefix;
use robot_model_spec::model::Convention;

use crate::output::OutFile;
use crate::{Error, output};

/// Write a spec to start from, with comments that explain each line.
///
/// It passes `check` as it is. Its numbers are placeholders: replace them with those of your arm. To start from a URDF, use `import`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model new Picker --joints 6 --convention modified_dh
  robot-model new Picker --joints 6 --convention origin -o arms/picker.robot --force
  robot-model new Swing --energies --joints 2")]
pub(crate) struct New {
    /// The robot's name, such as `Picker`.
    #[arg(value_parser = name)]
    name: Name,
    /// The spec to write; default: the robot's name with `.robot` appended.
    #[arg(short, long, value_name = "SPEC")]
    output: Option<PathBuf>,
    /// Number of joints.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=40))]
    joints: u8,
    /// Convention of the frames.
    #[arg(long, value_enum, default_value_t, conflicts_with = "energies")]
    convention: ConventionArgument,
    /// Kinetic and potential energy instead of joints and links, for arms that are not serial chains. At most 6 coordinates.
    #[arg(long)]
    energies: bool,
    /// Replace an existing file.
    #[arg(long)]
    force: bool,
}

/// Most coordinates of a spec of energies: more of this planar chain say nothing new.
const MOST_COORDINATES: u8 = 6;

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum ConventionArgument {
    /// Standard Denavit-Hartenberg.
    #[default]
    #[value(name = Convention::StandardDh.name())]
    StandardDh,
    /// Modified Denavit-Hartenberg (Craig).
    #[value(name = Convention::ModifiedDh.name())]
    ModifiedDh,
    /// Frames placed by `xyz` and `rpy`, as in a URDF.
    #[value(name = Convention::Origin.name())]
    Origin,
}

impl From<ConventionArgument> for Convention {
    fn from(convention: ConventionArgument) -> Self {
        match convention {
            ConventionArgument::StandardDh => Self::StandardDh,
            ConventionArgument::ModifiedDh => Self::ModifiedDh,
            ConventionArgument::Origin => Self::Origin,
        }
    }
}

/// A robot's name, as it was asked for and as the language has it.
#[derive(Debug, Clone)]
struct Name {
    asked: String,
    taken: String,
}

impl Name {
    /// That it is another one than was asked for; a first letter that is a capital now needs no word.
    fn note(&self) -> Option<String> {
        let Self { asked, taken } = self;
        let is_same = taken.eq_ignore_ascii_case(asked);
        (!is_same).then(|| {
            format!(
                "note: the robot is called `{taken}` instead of `{asked}`: names begin with a capital letter and contain only letters and digits"
            )
        })
    }
}

/// A name, not a file.
fn name(text: &str) -> Result<Name, String> {
    let is_path = text.contains(['/', '\\']) || text.contains('.');
    if is_path || !text.contains(|c: char| c.is_ascii_alphabetic()) {
        return Err("write the robot's name, such as `Picker`, and its file after `-o`".to_owned());
    }
    Ok(Name {
        asked: text.to_owned(),
        taken: robot_model_spec::upper_camel(text),
    })
}

impl New {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let name = &self.name.taken;
        if self.energies && self.joints > MOST_COORDINATES {
            return Err(Error::Argument(format!(
                "--energies --joints {}: a spec to start from has at most {MOST_COORDINATES} coordinates; write more of them yourself, up to 24",
                self.joints
            )));
        }
        let path = self
            .output
            .clone()
            .unwrap_or_else(|| PathBuf::from(format!("{}.robot", Prefix::of_robot(name).as_str())));
        let file = if self.force {
            OutFile::create(&path)?
        } else {
            OutFile::create_new(&path)?
        };
        let shown = path.display().to_string();
        let joints = usize::from(self.joints);
        let text = if self.energies {
            text::of_energies(name, &shown, joints)
        } else {
            text::of_chain(name, &shown, joints, self.convention.into())
        };
        // A name may be one that the language does not take.
        robot_model_spec::load(&shown, &text)?;
        file.commit(text.as_bytes())?;
        if let Some(note) = self.name.note() {
            output::say(&note);
        }
        output::print(&format!(
            "wrote {shown}: fill in the arm's numbers, then run `robot-model check {shown}`\n"
        ))
    }
}
