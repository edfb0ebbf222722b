//! What a header declares.

/// A function of a header.
#[derive(Debug, Clone)]
pub struct Declaration {
    /// Its name behind the robot's.
    pub name: String,
    /// Type of what it returns.
    pub kind: String,
    /// Names and numbers of entries; `None` for a number.
    pub arguments: Vec<(String, Option<usize>)>,
    /// Sizes of the array that it writes.
    pub result: Option<Vec<usize>>,
}

/// All functions, in their order.
pub fn declarations(header: &str, robot: &str) -> Vec<Declaration> {
    let is_code = |line: &&str| {
        let other = ["//", "#", "extern", "}"];
        !other.iter().any(|start| line.starts_with(start))
    };
    let lines: Vec<&str> = header.lines().filter(is_code).map(str::trim).collect();
    let text = lines.join(" ");
    let (before, rest) = text.rsplit_once(';').expect("it declares functions");
    assert_eq!(rest.trim(), "", "nothing behind the last function");
    before
        .split(';')
        .map(|text| declaration(text.trim(), robot))
        .collect()
}

fn declaration(text: &str, robot: &str) -> Declaration {
    let (head, rest) = text.split_once('(').expect("a function");
    let (kind, name) = head.split_once(' ').expect("a type and a name");
    let prefix = format!("{robot}_");
    let name = name.strip_prefix(&prefix).expect("the robot's name");
    let mut declaration = Declaration {
        name: name.to_owned(),
        kind: kind.to_owned(),
        arguments: Vec::new(),
        result: None,
    };
    let list = rest.strip_suffix(')').expect("a list of parameters");
    for parameter in list.split(", ").filter(|&parameter| parameter != "void") {
        let (declared, sizes) = match parameter.split_once('[') {
            Some((declared, sizes)) => (declared, Some(sizes)),
            None => (parameter, None),
        };
        let sizes: Option<Vec<usize>> = sizes.map(|sizes| {
            let sizes = sizes.trim_end_matches(']').split("][");
            sizes.map(|size| size.parse().expect("a number")).collect()
        });
        let (kind, name) = declared.rsplit_once(' ').expect("a type and a name");
        match (kind, sizes) {
            ("const double", Some(sizes)) => {
                let [length] = sizes[..] else {
                    panic!("{parameter}")
                };
                declaration.arguments.push((name.to_owned(), Some(length)));
            }
            ("double", None) => declaration.arguments.push((name.to_owned(), None)),
            ("double", Some(sizes)) => declaration.result = Some(sizes),
            _ => panic!("{parameter}"),
        }
    }
    declaration
}
