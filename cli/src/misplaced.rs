//! Files in the place of a spec that are none: logs and URDFs.

use std::path::Path;

/// First bytes of logs that are no text, and of packed ones.
const MAGICS: [&[u8]; 3] = [b"PAR1", b"\x89MCAP", &[0x1f, 0x8b]];

/// Ends of names of logs.
const ENDS: [&str; 7] = [
    ".csv", ".csv.gz", ".tsv", ".txt.gz", ".parquet", ".mcap", ".bag",
];

/// What a file looks like that stands where a spec should, and what to do; none where it may be a spec.
pub(crate) fn instead_of_a_spec(path: &Path, bytes: &[u8]) -> Option<String> {
    let name = path.display().to_string();
    let lower = name.to_lowercase();
    let is_empty = bytes.trim_ascii().is_empty();
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
    let start = start.trim_start_matches('\u{feff}').trim_start();
    let is_urdf = path
        .extension()
        .is_some_and(|end| end.eq_ignore_ascii_case("urdf"));
    if is_urdf || (start.starts_with('<') && start.contains("<robot")) {
        return Some(format!(
            "it looks like a URDF, and a spec has to stand here; write one from it: `robot-model import {name} -o arm.robot`"
        ));
    }
    let header = start.lines().next().unwrap_or_default();
    let is_header = header.split([',', ';', '\t']).count() > 2 && !header.contains(['{', '/']);
    let is_log = MAGICS.iter().any(|magic| bytes.starts_with(magic))
        || (!is_empty && (is_header || ENDS.iter().any(|end| lower.ends_with(end))));
    is_log.then(|| {
        format!(
            "it looks like a log, and a spec has to stand here; name the spec first and logs behind it, as in `robot-model identify arm.robot {name}`"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logs_and_urdfs_are_told_from_specs() {
        let told = |name: &str, bytes: &[u8]| instead_of_a_spec(Path::new(name), bytes);
        for (name, bytes) in [
            ("a.csv", b"x".as_slice()),
            ("a.csv.gz", b"\x1f\x8b\x08"),
            ("log", b"time,q1,tau1\n0,1,2\n"),
            ("log", b"time;q1;tau1\n"),
            ("log", b"PAR1\0"),
        ] {
            let said = told(name, bytes).expect("a log");
            assert!(
                said.contains(&format!("robot-model identify arm.robot {name}`")),
                "{said}"
            );
        }
        for (name, bytes) in [
            ("a.urdf", b"".as_slice()),
            (
                "a.xml",
                b"\xef\xbb\xbf<?xml version=\"1.0\"?>\n<robot name=\"a\"/>",
            ),
        ] {
            let said = told(name, bytes).expect("a URDF");
            assert!(
                said.contains(&format!("robot-model import {name} -o")),
                "{said}"
            );
        }
        for text in [
            "robot A { gravity = [0, 0, -9.81]; }",
            "// a, b, c\nrobot A {}",
            "",
        ] {
            assert_eq!(told("arm.robot", text.as_bytes()), None, "{text}");
        }
    }
}
