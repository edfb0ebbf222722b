//! What the derive says of mistakes, word for word: one mistake a file, named by it. `TRYBUILD=overwrite` rewrites the goldens.
//!
//! rustc has nothing to add to most of them, since the derive leaves a stub where it fails.

use std::fs;
use std::path::Path;

#[test]
fn mistakes_are_told_where_they_were_made() {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .parent()
        .expect("a folder of the target directory");
    // Files that attributes name are looked for in the crate's folder; this is that of trybuild's crate.
    let specs = target
        .join("tests/trybuild")
        .join(env!("CARGO_PKG_NAME"))
        .join("specs");
    fs::create_dir_all(&specs).expect("the target directory takes files");
    for entry in fs::read_dir("tests/ui/specs").expect("the folder is in the repository") {
        let path = entry.expect("a readable folder").path();
        let name = path.file_name().expect("a file has a name");
        fs::copy(&path, specs.join(name)).expect("the target directory takes files");
    }
    let cases = trybuild::TestCases::new();
    cases.pass("tests/ui/pass/*.rs");
    cases.compile_fail("tests/ui/fail/*.rs");
}
