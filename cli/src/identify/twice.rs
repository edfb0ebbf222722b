//! Logs that are given more than once: what they say counts as often, and deviations come out too small.

use std::fs::{self, File};
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

/// Bytes that are compared at once.
const CHUNK: usize = 1 << 16;

/// Sentences about logs that are fitted twice, and about one that is fitted and judged.
pub(crate) fn doubts(fitted: &[PathBuf], validate: Option<&Path>) -> Vec<String> {
    let mut found = Vec::new();
    for (k, path) in fitted.iter().enumerate() {
        if let Some(first) = fitted[..k].iter().find(|first| is_same(first, path)) {
            found.push(format!(
                "the fitted log {} is the same log as {}: it counts twice, and standard deviations are too small",
                path.display(),
                first.display()
            ));
        }
    }
    let both = validate.and_then(|path| {
        let fitted = fitted.iter().find(|fitted| is_same(fitted, path))?;
        Some(format!(
            "the validation log {} is the same log as {}, which is fitted: its errors do not validate the model",
            path.display(),
            fitted.display()
        ))
    });
    found.extend(both);
    found
}

/// A log that is to be one with a payload and is one without it.
pub(super) fn with_and_without<'a>(
    unloaded: &'a [PathBuf],
    loaded: &'a [PathBuf],
) -> Option<[&'a Path; 2]> {
    loaded.iter().find_map(|loaded| {
        let same = unloaded.iter().find(|unloaded| is_same(unloaded, loaded))?;
        Some([loaded.as_path(), same.as_path()])
    })
}

/// Whether two paths lead to the same file, or to the same content. What cannot be read is told by who reads it.
fn is_same(one: &Path, other: &Path) -> bool {
    let real = |path: &Path| fs::canonicalize(path).ok();
    if real(one).is_some_and(|path| Some(path) == real(other)) {
        return true;
    }
    let length = |path: &Path| fs::metadata(path).ok().map(|about| about.len());
    length(one).is_some_and(|bytes| bytes > 0 && Some(bytes) == length(other))
        && has_same_content(one, other).unwrap_or(false)
}

fn has_same_content(one: &Path, other: &Path) -> std::io::Result<bool> {
    let mut files = [
        BufReader::new(File::open(one)?),
        BufReader::new(File::open(other)?),
    ];
    loop {
        let [left, right] = &mut files;
        let (mut here, mut there) = (Vec::new(), Vec::new());
        left.take(CHUNK as u64).read_to_end(&mut here)?;
        right.take(CHUNK as u64).read_to_end(&mut there)?;
        if here != there {
            return Ok(false);
        }
        if here.is_empty() {
            return Ok(true);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_file_and_the_same_content_are_told_another_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            fs::write(&path, text).expect("a file");
            path
        };
        let [one, copy, other] = [("one", "0,1\n"), ("copy", "0,1\n"), ("other", "0,2\n")]
            .map(|(name, text)| write(name, text));
        let again = folder.path().join(".").join("one");
        let count = |fitted: &[&PathBuf], validate: Option<&PathBuf>| {
            let fitted: Vec<PathBuf> = fitted.iter().map(|path| (*path).clone()).collect();
            doubts(&fitted, validate.map(PathBuf::as_path)).len()
        };
        assert_eq!(count(&[&one, &other], None), 0);
        assert_eq!(count(&[&one, &again], None), 1);
        assert_eq!(count(&[&one, &other, &copy], None), 1);
        assert_eq!(count(&[&one, &other], Some(&copy)), 1);
        assert_eq!(count(&[&one], Some(&other)), 0);
        assert_eq!(count(&[&folder.path().join("none")], Some(&one)), 0);
        let payload = |loaded: &PathBuf| {
            with_and_without(std::slice::from_ref(&one), std::slice::from_ref(loaded)).is_some()
        };
        assert!(payload(&copy) && !payload(&other));
    }
}
