//! Documents of whole models are LaTeX that a TeX accepts, where there is one.

use std::fs;
use std::process::{Command, Stdio};

use robot_model_codegen::show::document;
use robot_model_tests::specs;

/// Programs that compile a document in batch, with their arguments.
const COMPILERS: [(&str, &[&str]); 4] = [
    ("pdflatex", &["-interaction=nonstopmode", "-halt-on-error"]),
    ("lualatex", &["-interaction=nonstopmode", "-halt-on-error"]),
    ("xelatex", &["-interaction=nonstopmode", "-halt-on-error"]),
    ("tectonic", &[]),
];

#[test]
fn documents_compile() {
    let is_there = |program: &str| {
        let version = Command::new(program)
            .arg("--version")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        version.is_ok_and(|status| status.success())
    };
    let Some((program, arguments)) = COMPILERS.iter().find(|(program, _)| is_there(program)) else {
        let names = COMPILERS.map(|(program, _)| program).join(", ");
        eprintln!("absent: none of {names}, so this run does not test that documents compile");
        return;
    };
    for spec in specs::folder("pass") {
        let folder = tempfile::tempdir().expect("a folder for the document");
        let path = folder.path().join("model.tex");
        fs::write(&path, document(&spec.compiled())).expect("the document is written");
        let output = Command::new(program)
            .args(*arguments)
            .arg("model.tex")
            .current_dir(folder.path())
            .output()
            .expect("the program was there before");
        assert!(
            output.status.success(),
            "{program} refuses the document of {}:\n{}{}",
            spec.name,
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr)
        );
    }
}
