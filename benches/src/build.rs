//! Running the tools that make a peer's program, and not running them again for the same input.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::{Error, failed};

/// Runs a tool; its words are the error's where it fails.
///
/// # Errors
/// It cannot be started, or it fails.
pub fn run(command: &mut Command) -> Result<String, Error> {
    let tool = command.get_program().display().to_string();
    let output = command
        .output()
        .map_err(|error| Error::new(format!("cannot run `{tool}`: {error}")))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let lines: Vec<&str> = said.lines().collect();
    let last = lines[lines.len().saturating_sub(12)..].join("\n");
    Err(Error::new(format!("`{tool}` fails:\n{last}")))
}

/// Makes what `input` says and remembers it beside `product`: what is there already for the same input is kept.
///
/// # Errors
/// Those of `make`, and a folder that cannot be written.
pub fn made(
    product: &Path,
    input: &str,
    make: impl FnOnce() -> Result<(), Error>,
) -> Result<(), Error> {
    let mut stamp = product.as_os_str().to_owned();
    stamp.push(".input");
    let stamp = Path::new(&stamp);
    if product.exists() && fs::read_to_string(stamp).is_ok_and(|old| old == input) {
        return Ok(());
    }
    let _ = fs::remove_file(stamp);
    make()?;
    fs::write(stamp, input).map_err(|error| failed("write", stamp, error))
}

/// Gives a crate of its own the versions in `lock`, the workspace's `Cargo.lock`. Cargo leaves out what the crate does not need,
/// so its own file is not compared but what it was made from.
///
/// # Errors
/// A file that cannot be read or written.
pub fn lock(lock: &Path, root: &Path) -> Result<(), Error> {
    let text = fs::read_to_string(lock).map_err(|error| failed("read", lock, error))?;
    let own = root.join("Cargo.lock");
    made(&own, &text, || {
        fs::write(&own, &text).map_err(|error| failed("write", &own, error))
    })
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::process::Command;

    use super::{lock, made, run};
    use crate::Error;

    #[test]
    fn the_same_input_is_made_once() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let product = folder.path().join("program");
        let mut times = 0;
        for input in ["a", "a", "b"] {
            let make = || {
                times += 1;
                std::fs::write(&product, input).map_err(|error| Error::new(error.to_string()))
            };
            made(&product, input, make).expect("a writable folder");
        }
        assert_eq!(times, 2);
    }

    #[test]
    fn versions_are_those_of_the_workspace_also_when_they_change() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (workspace, own) = (folder.path().join("lock"), folder.path().join("Cargo.lock"));
        let read = || fs::read_to_string(&own).expect("it is there");
        for text in ["one", "two"] {
            fs::write(&workspace, text).expect("a writable folder");
            lock(&workspace, folder.path()).expect("a writable folder");
            assert_eq!(read(), text);
            // As cargo does.
            fs::write(&own, "less").expect("a writable folder");
            lock(&workspace, folder.path()).expect("a writable folder");
            assert_eq!(read(), "less");
        }
    }

    #[test]
    fn a_tool_that_is_not_there_is_told() {
        let error = run(&mut Command::new("no-such-compiler"))
            .expect_err("none")
            .to_string();
        assert!(error.contains("`no-such-compiler`"), "{error}");
    }
}
