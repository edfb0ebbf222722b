//! A contender: a program that computes functions of one arm and times itself.
//!
//! It is started with the file of states (positions, velocities, accelerations of each, little-endian doubles) and asked line by
//! line: `values NAME COUNT` is answered by `COUNT` lines, the entries of the function's result row by row at the first states;
//! `pass NAME` by one line, the mean nanoseconds of a call in each block of states.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use crate::{Error, failed};

/// A running contender. It ends when it is dropped.
#[derive(Debug)]
pub struct Program {
    name: String,
    child: Child,
    asking: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Program {
    /// Starts `executable` with a file of states.
    ///
    /// # Errors
    /// It cannot be started.
    pub fn start(executable: &Path, states: &Path) -> Result<Self, Error> {
        let mut child = Command::new(executable)
            .arg(states)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| failed("start", executable, error))?;
        let pipes = child.stdin.take().zip(child.stdout.take());
        let (asking, answers) = pipes.ok_or_else(|| failed("talk to", executable, "no pipes"))?;
        Ok(Self {
            name: executable.display().to_string(),
            child,
            asking: Some(asking),
            answers: BufReader::new(answers),
        })
    }

    /// What a case returns at the first `count` states; `None` where the program has no such case.
    ///
    /// # Errors
    /// The program has ended, or answers something else.
    pub fn values(&mut self, case: &str, count: usize) -> Result<Option<Vec<Vec<f64>>>, Error> {
        self.ask(&format!("values {case} {count}"))?;
        let mut rows = Vec::new();
        for _ in 0..count {
            let line = self.line(case)?;
            if line.starts_with("no case") {
                return Ok(None);
            }
            rows.push(self.numbers(case, &line)?);
        }
        Ok(Some(rows))
    }

    /// Nanoseconds of a call, block by block.
    ///
    /// # Errors
    /// The program has ended or does not know the case.
    pub fn pass(&mut self, case: &str) -> Result<Vec<f64>, Error> {
        self.ask(&format!("pass {case}"))?;
        let line = self.line(case)?;
        self.numbers(case, &line)
    }

    fn ask(&mut self, line: &str) -> Result<(), Error> {
        let asking = self.asking.as_mut().expect("open until it is dropped");
        writeln!(asking, "{line}")
            .and_then(|()| asking.flush())
            .map_err(|error| {
                Error::new(format!(
                    "`{}` does not listen to `{line}`: {error}",
                    self.name
                ))
            })
    }

    fn line(&mut self, case: &str) -> Result<String, Error> {
        let mut line = String::new();
        match self.answers.read_line(&mut line) {
            Ok(1..) => Ok(line),
            _ => Err(Error::new(format!("`{}` ended at `{case}`", self.name))),
        }
    }

    fn numbers(&self, case: &str, line: &str) -> Result<Vec<f64>, Error> {
        let numbers = line.split_whitespace().map(str::parse);
        numbers.collect::<Result<_, _>>().map_err(|_| {
            let line = line.trim_end();
            Error::new(format!("`{}` answers to `{case}`: {line}", self.name))
        })
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // Nobody asks any more, so it ends by itself.
        self.asking = None;
        let _ = self.child.wait();
    }
}
