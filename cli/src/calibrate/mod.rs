//! `robot-model calibrate`: what stands between a current and a joint's torque.

mod back_emf;
mod figure;
mod static_gain;
mod table;
mod words;

use clap::{Args, Subcommand};

use crate::Error;

use back_emf::BackEmf;
use static_gain::Static;

/// Identify the torque per current of a joint, or the back-EMF of its motor, from measured tables.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model calibrate static blocked.csv --current i --torque tau
  robot-model calibrate back-emf log.csv --current i --velocity w --voltage v")]
pub(crate) struct Calibrate {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Static(Static),
    BackEmf(BackEmf),
}

impl Calibrate {
    pub(crate) fn run(&self) -> Result<(), Error> {
        match &self.what {
            What::Static(what) => what.run(),
            What::BackEmf(what) => what.run(),
        }
    }
}
