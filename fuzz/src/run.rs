//! One file under watch: panics are caught, time is measured.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use crate::answer::Answer;
use crate::kind::Kind;

/// How a file went wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Failure {
    /// The reader panicked with this message, or broke what it promises.
    Panic(String),
    /// No answer in time. The thread that looks for one is still running.
    Slow(Duration),
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Panic(message) => write!(f, "panic: {message}"),
            Self::Slow(limit) => write!(f, "no answer within {limit:?}"),
        }
    }
}

/// The answer to a file, and how long it took.
///
/// # Errors
/// [`Failure`]
pub fn watched(kind: Kind, file: &[u8], limit: Duration) -> Result<(Answer, Duration), Failure> {
    let (sender, receiver) = mpsc::channel();
    let copy = file.to_vec();
    let start = Instant::now();
    let worker = thread::Builder::new()
        // As small as the main thread's stack on the systems that have the smallest: recursion is to be bounded.
        .stack_size(1 << 20)
        .spawn(move || {
            let result = catch_unwind(AssertUnwindSafe(|| kind.answer(&copy)));
            // Nobody waits any more after the limit.
            let _ = sender.send(result);
        });
    if let Err(error) = worker {
        return Err(Failure::Panic(format!("no thread: {error}")));
    }
    match receiver.recv_timeout(limit) {
        Ok(Ok(answer)) => Ok((answer, start.elapsed())),
        Ok(Err(panic)) => Err(Failure::Panic(message(panic.as_ref()))),
        Err(_) => Err(Failure::Slow(limit)),
    }
}

fn message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("without a message")
        .to_owned()
}
