//! How a page comes about again: the command, the program's version, and which files it read.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::Page;
use crate::Error;
use crate::output::quoted;

/// Bytes that are read at once.
const PIECE: usize = 1 << 16;

/// The section of a page that was made of these files.
///
/// # Errors
/// A file that cannot be read any more.
pub(crate) fn again(page: &mut Page, inputs: &[PathBuf]) -> Result<(), Error> {
    page.section("How to reproduce");
    page.text(&format!(
        "To make this page again from the same files, with robot-model {}:",
        env!("CARGO_PKG_VERSION")
    ));
    page.commands(&invocation());
    let row = |path: &PathBuf| -> Result<Vec<String>, Error> {
        let name = path.display().to_string();
        Ok(match fingerprint(path)? {
            Some((bytes, crc)) => vec![name, bytes.to_string(), format!("{crc:08x}")],
            None => vec![name, "-".to_owned(), "not a regular file".to_owned()],
        })
    };
    let rows = inputs.iter().map(row).collect::<Result<Vec<_>, Error>>()?;
    page.table(
        "Input files; the CRC-32 checksum (as in zip and gzip) identifies their content.",
        &["file", "bytes", "CRC-32"],
        &rows,
    );
    Ok(())
}

/// Size and CRC-32 of a file; none of a pipe, whose content is gone.
fn fingerprint(path: &Path) -> Result<Option<(usize, u32)>, Error> {
    if !path.is_file() {
        return Ok(None);
    }
    let failed = |error: std::io::Error| Error::read(path, &error);
    let mut file = File::open(path).map_err(failed)?;
    let mut piece = vec![0; PIECE];
    let (mut bytes, mut crc) = (0, crc32fast::Hasher::new());
    loop {
        let count = file.read(&mut piece).map_err(failed)?;
        if count == 0 {
            return Ok(Some((bytes, crc.finalize())));
        }
        crc.update(&piece[..count]);
        bytes += count;
    }
}

/// How the program was called, as a shell takes it.
fn invocation() -> String {
    let arguments = std::env::args_os().skip(1);
    let arguments = arguments.map(|one| quoted(&one.to_string_lossy()));
    let words = std::iter::once("robot-model".to_owned()).chain(arguments);
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_told_by_its_bytes() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("nine");
        std::fs::write(&file, "123456789").expect("a writable folder");
        // The check value of CRC-32.
        let found = fingerprint(&file).expect("a file");
        assert_eq!(found, Some((9, 0xcbf4_3926)));
        assert_eq!(fingerprint(folder.path()).expect("no file"), None);
    }
}
