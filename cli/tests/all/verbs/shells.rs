//! What shells and the manual know of the program.

use std::process::Command;

use crate::verbs::common::Folder;

const VERBS: [&str; 19] = [
    "new",
    "import",
    "check",
    "show",
    "emit",
    "export",
    "eval",
    "excite",
    "simulate",
    "identify",
    "merge",
    "friction",
    "trace",
    "dissect",
    "audit",
    "calibrate",
    "demo",
    "completions",
    "man",
];

#[test]
fn every_shell_gets_its_completions() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let text = folder.succeed(&["completions", shell]);
        for verb in VERBS {
            assert!(text.contains(verb), "{shell}: {verb}");
        }
        assert!(text.contains("log-settings"), "{shell}: options, too");
    }
    assert_eq!(folder.run(&["completions", "csh"]).code, Some(2));
}

#[test]
fn bash_understands_its_completions() {
    let folder = Folder::new();
    folder.write("completions", &folder.succeed(&["completions", "bash"]));
    // What bash calls with the words so far, of which the last is completed.
    let script = "source ./completions; set -- $(complete -p robot-model) \"$@\"; while [ \"$1\" != -F ]; do shift; done; call=$2; \
                  while [ \"$1\" != robot-model ]; do shift; done; shift; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); \
                  $call robot-model \"${COMP_WORDS[COMP_CWORD]}\" \"${COMP_WORDS[COMP_CWORD - 1]}\"; echo ${COMPREPLY[@]}";
    let of = |words: &'static [&'static str]| {
        let first = ["-c", script, "bash"];
        [&first[..], words].concat()
    };
    for (arguments, told) in [
        (vec!["-n", "completions"], ""),
        (of(&["robot-model", "ident"]), "identify"),
        (of(&["robot-model", "identify", "--meth"]), "--method"),
        (
            of(&["robot-model", "identify", "--method", "phys"]),
            "physical",
        ),
        (of(&["robot-model", "export", "--as", "mj"]), "mjcf"),
        (of(&["robot-model", "calibrate", "stat"]), "static"),
    ] {
        let bash = Command::new("bash")
            .current_dir(folder.path("."))
            .args(&arguments)
            .output();
        let Ok(bash) = bash else {
            eprintln!("no bash on this machine: its syntax is not looked at");
            return;
        };
        let said = String::from_utf8_lossy(&bash.stderr);
        assert!(bash.status.success(), "{arguments:?}: {said}");
        let completed = String::from_utf8_lossy(&bash.stdout);
        assert_eq!(completed.trim(), told, "{arguments:?}");
    }
}

#[test]
fn the_manual_has_a_page_of_every_verb() {
    let folder = Folder::new();
    let page = folder.succeed(&["man"]);
    assert!(page.contains(".TH robot-model 1"), "{page}");
    for verb in VERBS {
        assert!(
            page.contains(&format!("robot\\-model\\-{verb}(1)")),
            "{verb}: {page}"
        );
    }
    let said = folder.succeed(&["man", "--out", "man1"]);
    let pages = std::fs::read_dir(folder.path("man1")).unwrap().count();
    assert!(pages > VERBS.len(), "{pages} pages");
    assert_eq!(said, format!("wrote {pages} pages to man1\n"));
    for verb in VERBS {
        let page = folder.read(&format!("man1/robot-model-{verb}.1"));
        assert!(
            page.contains(&format!(".TH robot-model-{verb} 1")),
            "{page}"
        );
        // As it is typed, a command a line.
        let (_, examples) = page.split_once(".SH EXAMPLES\n.nf\n").expect("examples");
        let command = format!("\\&  robot\\-model {verb}");
        assert!(examples.contains(&command), "{verb}: {examples}");
        assert!(!page.contains("EXTRA"), "{verb}");
    }
    assert!(folder.read("man1/robot-model.1") == page);
    // What may be repeated is in the synopsis.
    let usage = ".SH SYNOPSIS\n.nf\n\\&robot\\-model trace [OPTIONS] <SPEC> <LOG>...\n.fi\n.SH";
    let trace = folder.read("man1/robot-model-trace.1");
    assert!(trace.contains(usage), "{trace}");
    assert!(
        folder
            .read("man1/robot-model-calibrate-static.1")
            .contains("robot\\-model calibrate static")
    );
    folder.write("file", "");
    assert!(
        folder
            .refuse(&["man", "--out", "file"])
            .contains("`file` is not a folder")
    );
    assert!(
        folder
            .refuse(&["man", "--out", "file/man1"])
            .contains("cannot be created")
    );
    // With the folders around it, as the README's command wants them.
    folder.succeed(&["man", "--out", "share/man/man1"]);
    assert!(folder.path("share/man/man1/robot-model.1").is_file());
}
