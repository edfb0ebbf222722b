//! `robot-model import`: a URDF to a spec.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_model_spec::urdf::{ASSUMED_GRAVITY, ImportError, ImportOptions, Inertials, import};

use crate::Error;
use crate::misplaced::instead_of_a_urdf;
use crate::output::{self, Files};
use crate::spec::read_text;

/// Turn a URDF into a spec.
///
/// The chain of moving joints from `--base` to `--tip` becomes the robot; fixed joints are merged, and links beside the chain are held
/// still. A joint of the chain that mimics another becomes an independent joint: a warning and a comment in the spec give the
/// constraint, and the sum of torques on the leading joint.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model import arm.urdf -o arm.robot --effects 'all:viscous_friction,coulomb_friction;(5,6):gear_coupling'
  robot-model import dual.urdf -o left.robot --base torso --tip left_hand --inertials fixed
  robot-model import arm.urdf -o arm.robot --gravity 0,0,9.81 --force")]
pub(crate) struct Import {
    /// The URDF file.
    urdf: PathBuf,
    /// The spec to write.
    #[arg(short, long, value_name = "SPEC")]
    output: PathBuf,
    /// Link that is fixed; default: the root of the tree.
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// Link at the end of the chain; required if the tree has several ends.
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// Effects to declare: joints by number from 1, by name, in pairs for effects of two joints, or `all`, such as
    /// `all:viscous_friction,coulomb_friction;3:motor_inertia;(5,6):gear_coupling`.
    #[arg(long, default_value = "")]
    effects: String,
    /// How to treat the inertials.
    #[arg(long, value_enum, default_value_t)]
    inertials: InertialsArgument,
    /// Acceleration of gravity in the base link's frame, m/s^2; default 0,0,-9.81, since a URDF cannot hold it.
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    gravity: Option<[f64; 3]>,
    /// Replace an existing file.
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum InertialsArgument {
    /// CAD values, to be identified.
    #[default]
    Nominal,
    /// Exact values, not identified.
    Fixed,
    /// Left out, to be identified without start values.
    None,
}

fn parse_vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>())
        .collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|value| value.is_finite()) => Ok([x, y, z]),
        _ => Err("write three numbers, such as `0,0,-9.81`".to_owned()),
    }
}

impl Import {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let urdf = read_text(&self.urdf)?;
        if let Some(reason) = instead_of_a_urdf(&self.urdf, &urdf) {
            return Err(Error::Read {
                path: self.urdf.clone(),
                reason,
            });
        }
        let options = ImportOptions {
            base: self.base.clone(),
            tip: self.tip.clone(),
            effects: self.effects.clone(),
            inertials: match self.inertials {
                InertialsArgument::Nominal => Inertials::Nominal,
                InertialsArgument::Fixed => Inertials::Fixed,
                InertialsArgument::None => Inertials::None,
            },
            gravity: self.gravity,
        };
        let mut files = Files::reading([self.urdf.as_path()]);
        // A spec is edited once it is imported; `new` keeps those, too.
        let file = if self.force {
            files.claim(&self.output)?
        } else {
            files.claim_new(&self.output)?
        };
        let imported = import(&urdf, &options).map_err(|error| self.refused(&urdf, error))?;
        if self.gravity.is_none() {
            let [x, y, z] = ASSUMED_GRAVITY;
            output::say(&format!(
                "note: gravity is taken to be [{x}, {y}, {z}] m/s^2 in the frame of the base: a URDF does not say it (--gravity X,Y,Z)"
            ));
        }
        if self.effects.is_empty() {
            output::say(
                "note: no friction is declared, and real joints have it: --effects \"all:viscous_friction,coulomb_friction\"",
            );
        }
        for warning in &imported.warnings {
            output::say(&format!("warning: {warning}"));
        }
        file.commit(imported.spec.as_bytes())
    }

    fn refused(&self, urdf: &str, error: ImportError) -> Error {
        match error {
            // Its message begins with the argument, which is not in the URDF.
            ImportError::Effects(_) => Error::Argument(error.to_string()),
            ImportError::Parse(fault) => Error::Urdf {
                path: self.urdf.clone(),
                fault,
            },
            other => Error::Import {
                path: self.urdf.clone(),
                place: other.place(urdf),
                reason: other.to_string(),
            },
        }
    }
}
