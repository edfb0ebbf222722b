//! `robot-model export`: an arm with its parameters as a URDF or MJCF.

mod passive;
mod said;
mod standard;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_model_codegen::Compiled;
use robot_model_spec::export::{
    ExportError, LinkNumbers, NO_LIMIT, NO_RANGE, Numbers, made_up_limits, mjcf, urdf,
};
use robot_model_spec::parameter::{InertialElement, Owner};
use robot_model_spec::urdf::{ASSUMED_GRAVITY, write_back};

use crate::Error;
use crate::hinted::{Hinted, Hints};
use crate::output::{Content, Files, MARK, say};
use crate::parameters;
use crate::spec::{compile, read_text};
use passive::{bodies, joints};
use standard::{Standard, is_body, standard};

/// Write an arm with its parameters as a URDF or MJCF.
///
/// The file has the identified base parameters and physically possible links; values that logs do not determine are nearest to the spec's
/// nominal ones. Notes and comments in the file list values that are not identifiable alone, and effects that the format cannot hold.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model export arm.robot --as urdf --parameters fit.json --urdf arm.urdf -o identified.urdf
  robot-model export arm.robot --as mjcf --parameters fit.json -o arm.xml")]
pub(crate) struct Export {
    /// The `.robot` file.
    spec: PathBuf,
    /// Format to write.
    #[arg(long = "as", value_parser = Hinted::<Format>::new(FORMAT_HINTS))]
    format: Format,
    /// Parameter values by name, or what `identify --json` writes; without it the spec's own values.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
    /// The URDF that the spec was imported from: only identified inertials, damping and friction change. Without it a URDF is made from the
    /// spec's frames.
    #[arg(long, value_name = "ORIGINAL.urdf")]
    urdf: Option<PathBuf>,
    /// How to write rotor inertia, which a URDF cannot hold. With `apart`, links are those of an MJCF model of the same parameters.
    #[arg(long, value_enum, default_value_t = Rotors::Apart)]
    rotors: Rotors,
    /// The file to write.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// Inertia of rotors in a URDF.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Rotors {
    /// Not written; a note lists each value, to set as armature in a simulator.
    Apart,
    /// Added to the inertia of their links where the dynamics are the same; links then differ from CAD.
    InLinks,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Links, joints, damping and friction.
    Urdf,
    /// A `MuJoCo` model, which also has rotors, springs, gravity and motors.
    Mjcf,
}

/// Words for what other commands write.
const FORMAT_HINTS: Hints = &[
    (
        &["json"],
        "for parameter values as JSON, use `robot-model identify --json FILE`",
    ),
    (
        &["c", "c++", "cpp", "rust"],
        "for source code, use `robot-model emit --lang c` or `--lang rust`",
    ),
    (&["xml", "mujoco"], "write `mjcf`"),
    (
        &["robot", "spec"],
        "for a spec with an effect added, use `robot-model trace --amend FILE`; for one from a URDF, `robot-model import`",
    ),
];

impl Format {
    const fn content(self) -> Content {
        match self {
            Self::Urdf => Content::Urdf,
            Self::Mjcf => Content::Mjcf,
        }
    }
}

impl Export {
    pub(crate) fn run(&self) -> Result<(), Error> {
        if self.urdf.is_some() && self.format != Format::Urdf {
            let reason =
                "`--urdf` belongs to `--as urdf`; an MJCF model is made from the spec's frames";
            return Err(Error::Argument(reason.to_owned()));
        }
        if self.rotors == Rotors::InLinks && self.format != Format::Urdf {
            let reason =
                "`--rotors in-links` is of `--as urdf`; an MJCF model has a place for rotors";
            return Err(Error::Argument(reason.to_owned()));
        }
        let inputs = [
            Some(&self.spec),
            self.parameters.as_ref(),
            self.urdf.as_ref(),
        ];
        let inputs = inputs.into_iter().flatten().map(PathBuf::as_path);
        let out = Files::reading(inputs).claim_for(&self.output, self.format.content())?;
        let compiled = compile(&self.spec)?;
        let source = &compiled.model.source;
        if compiled.model.chain().is_none() {
            let none = ExportError::NoChain(compiled.model.name.clone());
            return Err(Error::Argument(format!("{source}: {none}")));
        }
        let file = self.parameters.as_deref();
        let (values, _, origin) = parameters::values(&compiled, file)?;
        let standard = standard(&compiled, &values, file, self.has_rotors_apart())?;
        let (numbers, told) = self.numbers(&compiled, &standard, &values.shapes);
        let (text, remarks) = self.text(&compiled, &numbers)?;
        if let Some(moved) = said::moved(&standard) {
            say(&format!("warning: {origin}: {moved}"));
        }
        for note in told
            .iter()
            .map(|note| format!("{source}: {note}"))
            .chain(remarks)
        {
            say(&format!("note: {note}"));
        }
        out.commit(marked(&text).as_bytes())
    }

    /// Whether rotors are no part of links: an MJCF model says them, and a URDF leaves them out.
    fn has_rotors_apart(&self) -> bool {
        self.rotors == Rotors::Apart
    }

    /// What is written, and what is told of it.
    fn numbers(
        &self,
        compiled: &Compiled,
        standard: &Standard,
        shapes: &[f64],
    ) -> (Numbers, Vec<String>) {
        let model = &compiled.model;
        let value = |effect: usize, parameter: usize| {
            let own = Owner::Effect { effect, parameter };
            let mut all = compiled.standard.iter().zip(&standard.values);
            all.find(|(other, _)| other.owner == own)
                .map_or(0.0, |(_, value)| *value)
        };
        let mut told = Vec::new();
        let count = InertialElement::ALL.len();
        let tens = standard.values.chunks_exact(count).take(model.joints.len());
        let mut links: Vec<LinkNumbers> = tens
            .enumerate()
            .map(|(link, ten)| LinkNumbers {
                inertial: std::array::from_fn(|k| ten[k]),
                remark: said::remark(compiled, standard, link),
            })
            .collect();
        let remarks: Vec<String> = links.iter().map(|link| link.remark.clone()).collect();
        told.extend(said::not_alone(compiled, &remarks));
        told.extend(said::masses(standard));
        told.extend(said::inertias(compiled, &standard.values));
        for (joint, ten) in bodies(model, shapes, &value) {
            for (sum, more) in links[joint].inertial.iter_mut().zip(ten) {
                *sum += more;
            }
            let link = &model.chain().expect("checked at the start").links[joint].name;
            if !is_body(links[joint].inertial) {
                told.push(format!(
                    "link `{link}` with the body that an effect adds is physically impossible; other programs may refuse it"
                ));
            }
        }
        let left_out = said::not_written(compiled, &standard.values, shapes, self.format);
        let mut notes = Vec::new();
        if !left_out.is_empty() {
            notes.push(format!(
                "effects that {} cannot express are not written: {}",
                self.format.name(),
                left_out.join(", ")
            ));
        }
        if self.format == Format::Urdf {
            notes.extend(said::rotors(model, &value));
        }
        told.extend(notes.iter().cloned());
        let numbers = Numbers {
            links,
            joints: joints(model, self.format, &value),
            notes,
        };
        (numbers, told)
    }

    /// What is written, and what is remarkable about it.
    fn text(&self, compiled: &Compiled, numbers: &Numbers) -> Result<(String, Vec<String>), Error> {
        let model = &compiled.model;
        let source = &model.source;
        let refused = |error: ExportError| Error::Argument(format!("{source}: {error}"));
        match (self.format, &self.urdf) {
            (Format::Mjcf, _) => Ok((mjcf(model, numbers).map_err(refused)?, Vec::new())),
            (Format::Urdf, Some(path)) => {
                let original = read_text(path)?;
                let written =
                    write_back(&original, model, numbers).map_err(|error| match error {
                        ExportError::Parse(fault) => Error::Urdf {
                            path: path.clone(),
                            fault,
                        },
                        other => Error::Argument(format!("{}: {other}", path.display())),
                    })?;
                let path = path.display();
                let notes = written.notes.iter().map(|note| format!("{path}: {note}"));
                Ok((written.urdf, notes.collect()))
            }
            (Format::Urdf, None) => {
                let mut notes = Vec::new();
                let gravity = model.chain().map(|chain| chain.gravity);
                if let Some([x, y, z]) = gravity.filter(|gravity| *gravity != ASSUMED_GRAVITY) {
                    notes.push(format!(
                        "{source}: a URDF cannot hold gravity: [{x}, {y}, {z}] m/s^2 in the frame of its base (`import --gravity {x},{y},{z}`)"
                    ));
                }
                let made_up = made_up_limits(model);
                if !made_up.is_empty() {
                    notes.push(format!(
                        "{source}: a URDF requires limits, which the spec lacks at {}; written are {NO_LIMIT:e} for torque and velocity and \
                         {NO_RANGE} m for ranges",
                        made_up.join(", ")
                    ));
                }
                Ok((urdf(model, numbers).map_err(refused)?, notes))
            }
        }
    }
}

/// The text with a comment of who wrote it, in front of its first element.
fn marked(text: &str) -> String {
    if text.contains(MARK) {
        return text.to_owned();
    }
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let declaration = text.find("?>").filter(|_| text.starts_with("<?xml"));
    let (before, behind) = text.split_at(declaration.map_or(0, |at| at + "?>".len()));
    let line = if before.is_empty() { "" } else { "\n" };
    format!(
        "{before}{line}{MARK}\n{}",
        behind.trim_start_matches(['\r', '\n'])
    )
}

impl Format {
    const fn name(self) -> &'static str {
        match self {
            Self::Urdf => "a URDF",
            Self::Mjcf => "MJCF",
        }
    }
}
