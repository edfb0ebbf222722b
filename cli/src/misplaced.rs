//! Files in the place of a spec or of JSON that are none: logs, URDFs, specs.

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
    let start = start(bytes);
    let is_urdf = path
        .extension()
        .is_some_and(|end| end.eq_ignore_ascii_case("urdf"));
    if is_urdf || (is_markup(&start) && start.contains("<robot")) {
        return Some(format!(
            "it looks like a URDF, but a spec is expected here; convert it: `robot-model import {name} -o arm.robot`"
        ));
    }
    if start.starts_with(['{', '[']) {
        return Some(format!(
            "it looks like JSON, but a spec is expected here; name the spec first and the file of parameters after `--parameters`, as in \
             `robot-model audit arm.robot --parameters {name}`"
        ));
    }
    let is_called_log = ENDS.iter().any(|end| lower.ends_with(end));
    let is_log = is_log(bytes) || (!is_empty && is_called_log);
    is_log.then(|| {
        format!(
            "it looks like a log, but a spec is expected here; name the spec first and the logs after it, as in `robot-model identify \
             arm.robot {name}`"
        )
    })
}

/// The same for what stands where a URDF should.
pub(crate) fn instead_of_a_urdf(path: &Path, text: &str) -> Option<String> {
    let name = path.display();
    is_spec(text).then(|| {
        format!(
            "it looks like a spec, but a URDF is expected here; a spec needs no import: `robot-model check {name}`"
        )
    })
}

/// The same for what stands where JSON should and is none.
pub(crate) fn instead_of_json(path: &Path, text: &str) -> Option<String> {
    let start = start(text.as_bytes());
    let header = start.lines().next().unwrap_or_default();
    let is_table = header.contains([',', ';', '\t']) && !header.contains(['{', '[', '"', ':']);
    let lower = path.display().to_string().to_lowercase();
    let is_called_table = ENDS.iter().any(|end| lower.ends_with(end));
    let what = if is_markup(&start) {
        "XML, as URDFs are"
    } else if !start.starts_with(['{', '[']) && (is_table || is_called_table) {
        "a table (CSV)"
    } else if is_spec(text) {
        "a spec"
    } else {
        return None;
    };
    Some(format!(
        "it looks like {what}, but JSON is expected here; parameters are written `{{\"NAME\": VALUE, ..}}`, or by `robot-model identify .. \
         --json FILE`"
    ))
}

/// Whether bytes are those of a log: names of columns, or what packed and binary ones begin with.
fn is_log(bytes: &[u8]) -> bool {
    let start = start(bytes);
    let header = start.lines().next().unwrap_or_default();
    let columns = header.split([',', ';', '\t']).count();
    let is_header = columns > 2 || (columns == 2 && header.starts_with("time"));
    MAGICS.iter().any(|magic| bytes.starts_with(magic))
        || (is_header && !header.contains(['{', '/', '<']))
}

/// Whether a text is a spec, whatever its mistakes.
pub(crate) fn is_spec(text: &str) -> bool {
    robot_of(text).is_some()
}

/// The robot of a spec, whatever its mistakes: `robot NAME {` behind comments and effects.
pub(crate) fn robot_of(text: &str) -> Option<String> {
    let code = without_comments(text);
    let mut rest = code.trim_start_matches('\u{feff}');
    while let Some((head, body)) = rest.split_once('{') {
        let words: Vec<&str> = head.split_whitespace().collect();
        match words.as_slice() {
            ["robot", name] => {
                let is_name =
                    !name.contains(|c: char| c.is_ascii_punctuation() && c != '_' && c != '-');
                return is_name.then(|| (*name).to_owned());
            }
            ["effect", ..] => rest = behind(body),
            _ => return None,
        }
    }
    None
}

/// What comes behind the bracket that ends a body.
fn behind(body: &str) -> &str {
    let mut open = 1;
    let end = body.find(|c: char| {
        open += i32::from(c == '{') - i32::from(c == '}');
        open == 0
    });
    end.map_or("", |end| &body[end + 1..])
}

/// A text of the language without its comments; those in `/* .. */` may stand in each other.
fn without_comments(text: &str) -> String {
    let (mut code, mut rest, mut open) = (String::new(), text, 0_u32);
    while let Some(next) = rest.chars().next() {
        let mut taken = 2;
        if rest.starts_with("/*") {
            open += 1;
        } else if open > 0 && rest.starts_with("*/") {
            open -= 1;
        } else if open == 0 && rest.starts_with("//") {
            taken = rest.find('\n').unwrap_or(rest.len());
        } else {
            taken = next.len_utf8();
            if open == 0 {
                code.push(next);
            }
        }
        rest = &rest[taken..];
    }
    code
}

/// Whether a text is XML or HTML.
pub(crate) fn is_markup(start: &str) -> bool {
    start.starts_with('<')
}

/// The beginning of a text, without what stands before its first letter.
fn start(bytes: &[u8]) -> String {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
    let start = start.trim_start_matches('\u{feff}').trim_start();
    start.to_owned()
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
        for (name, text) in [("fit.json", " {\"a.m\": 3}"), ("fit", "[1, 2, 3]")] {
            let said = told(name, text.as_bytes()).expect("JSON");
            let command = format!("audit arm.robot --parameters {name}`");
            assert!(
                said.starts_with("it looks like JSON") && said.contains(&command),
                "{said}"
            );
        }
        let told_of_urdf = |text: &str| instead_of_a_urdf(Path::new("arm.robot"), text);
        assert_eq!(told_of_urdf("<robot name=\"a\"/>"), None);
        let said = told_of_urdf("// mine\nrobot A { }").expect("a spec");
        assert!(said.contains("`robot-model check arm.robot`"), "{said}");
        for text in [
            "robot A { gravity = [0, 0, -9.81]; }",
            "// a, b, c\nrobot A {}",
            "",
        ] {
            assert_eq!(told("arm.robot", text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn specs_are_told_by_their_robot() {
        for text in [
            "robot A { gravity = [0, 0, -9.81]; }",
            "\u{feff}// by {us}\n/* of /* old */ robot */\nrobot A\n{",
            "/// A law.\neffect e(j) { linear c; torque(j) = c * { dq(j) }; }\nrobot UR-5 {",
        ] {
            assert!(is_spec(text), "{text}");
        }
        for text in [
            "",
            "# robot UR5, Monday\ntime,q1\n",
            "// fit of robot X\n{\"m1\": 1}",
            "notes on robot A {",
            "robot",
            "robot: UR5 {",
            "effect e(j) {}",
            "effect e(j) { robot A {",
            "time [s],q1 [rad]\n0,1\n",
            "\x7fELF\x02\x01",
        ] {
            assert!(!is_spec(text), "{text}");
        }
    }
}
