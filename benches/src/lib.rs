//! What emitted code costs, in operations and nanoseconds, beside other programs that compute the same arm in the same run.
//!
//! ```text
//! spec -compile-> Arm -pages-> a crate of our functions -cargo-> Program (plain, native)
//!                     -pages-> our functions in C -C compiler-> Program
//!                     -json-> peers' generators -C, C++ compilers-> Program
//! Programs -rounds of passes-> Times -rows-> table, JSON
//! ```
//!
//! Every contender is a program of its own that holds the states and the clock and answers two questions about a function:
//! its values at some states, and the nanoseconds of one pass over all blocks. So ours and the peers' are timed in the same
//! way and in turns, and none is in the address space of another.
//!
//! Beside that, [`baselines`] are what the tracer's study compares it with, and [`interval`] what its shares say.

pub mod arm;
pub mod baselines;
pub mod build;
pub mod docs;
pub mod generation;
mod given;
pub mod interval;
pub mod machine;
pub mod options;
pub mod ours;
pub mod ours_c;
pub mod out_file;
pub mod peers;
pub mod program;
pub mod report;
pub mod rounds;
mod rows;
mod run;
pub mod table;

pub use run::run;

use std::io::Write;
use std::process::ExitCode;

/// What the benchmark says where it cannot go on: what, where and the way out.
#[derive(Debug)]
pub struct Error(String);

impl Error {
    /// This message.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

/// The end of a program: what went wrong, if anything did, to standard error.
pub fn ended(done: Result<(), impl std::fmt::Display>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "{error}");
            ExitCode::FAILURE
        }
    }
}

/// A file or folder that the system does not give, in words.
pub(crate) fn failed(what: &str, path: &std::path::Path, reason: impl std::fmt::Display) -> Error {
    Error::new(format!("cannot {what} `{}`: {reason}", path.display()))
}
