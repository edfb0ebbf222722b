//! `robot-model demo`: the whole loop on a built-in arm, twice.
//!
//! The same spec meets two plants. One is the arm as its builder wrote it down. The other's elbow has a Stribeck effect that the spec
//! does not declare. The tracer sees logs only; what the plant is made of is said at the end, to compare.

mod plant;

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use robot_model_spec::amend::{Amendment, amend};

use crate::Error;
use crate::close_the_loop::{self, Loop};
use crate::output::{self, Content, Files, Record};
use crate::progress::Progress;
use crate::trace;

use plant::Plant;

/// The arm that both plants start from.
const ARM: &str = include_str!("arm.robot");
const NAME: &str = "elbow_arm.robot";

/// What the plants' effects are worth.
const EFFECTS: [(&str, f64); 9] = [
    ("base.motor_inertia.ia", 0.9),
    ("shoulder.motor_inertia.ia", 1.1),
    ("elbow.motor_inertia.ia", 0.35),
    ("base.viscous_friction.fv", 6.0),
    ("shoulder.viscous_friction.fv", 8.0),
    ("elbow.viscous_friction.fv", 2.4),
    ("base.coulomb_friction.fc", 7.0),
    ("shoulder.coulomb_friction.fc", 9.0),
    ("elbow.coulomb_friction.fc", 3.0),
];

/// What the spec does not say of the second plant.
const WORN: (&str, f64) = ("elbow.stribeck.fs", 2.2);
const WORN_SPEED: f64 = 0.15;

/// How one's own arm goes the same way.
const NEXT: &str = "
Next, with your own arm and logs (docs/tutorial.md goes through it):
  robot-model import arm.urdf --effects \"all:viscous_friction,coulomb_friction\" -o arm.robot    # without a URDF: robot-model new Arm -o arm.robot
  robot-model identify arm.robot log.csv --validate other.csv
  robot-model trace arm.robot log.csv --validate other.csv --report report
";

/// Run the whole loop on a built-in arm, without files: identify, trace, amend, recompile, compare.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model demo
  robot-model demo --json demo.json")]
pub(crate) struct Demo {
    /// Write both results as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

impl Demo {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let json = Files::default().claim_if(self.json.as_deref(), Content::Json(Record::Demo))?;
        let progress = Progress::new();
        let stribeck = Amendment {
            effect: "stribeck".to_owned(),
            joints: vec!["elbow".to_owned()],
            shapes: vec![("vs".to_owned(), WORN_SPEED)],
        };
        let worn_spec = amend(NAME, ARM, &[stribeck])?;
        let clean = Plant::new(NAME, ARM, &EFFECTS)?;
        let worn = Plant::new(NAME, &worn_spec, &[&EFFECTS[..], &[WORN]].concat())?;
        let close = |plant: &Plant, seed: u64| -> Result<Loop, Error> {
            let logs = [plant.log("identification", seed)?];
            close_the_loop::close(
                NAME,
                ARM,
                &logs,
                Some(&plant.log("validation", seed + 1)?),
                &progress,
            )
        };
        progress.step("an arm that is as its spec says");
        let clean = close(&clean, 1)?;
        progress.step("an arm with something that its spec does not say");
        let worn = close(&worn, 3)?;
        drop(progress);

        let text = story(&clean, &worn);
        if let Some(file) = json {
            let both = serde_json::json!({ "clean": trace::Report::new(&clean), "worn": trace::Report::new(&worn) });
            file.commit(output::json(&both).as_bytes())?;
        }
        output::print(&text)
    }
}

fn story(clean: &Loop, worn: &Loop) -> String {
    let mut text = String::new();
    let mut add = |part: &str| text.push_str(part);
    add(
        "The spec: a base, shoulder and elbow arm with motor inertia, viscous and dry friction on every joint.\n",
    );
    add(
        "Two machines were built from it. Each moved for 30 s along a motion to fit and another to judge.\n",
    );
    add("\n== Machine 1 ==\n");
    add(&trace::summary(NAME, clean, ARM));
    add("\n== Machine 2 ==\n");
    add(&trace::summary(NAME, worn, ARM));
    write!(
        text,
        "\nThe truth: machine 1 is as its spec says; machine 2 has a Stribeck effect on its elbow, {} = {} N m, vs = {WORN_SPEED} rad/s.\n",
        WORN.0, WORN.1
    )
    .expect("a string takes all");
    text.push_str(NEXT);
    text
}
