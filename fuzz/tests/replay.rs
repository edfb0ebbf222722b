//! What the fuzzer has found, again: every text of `corpus` has an answer, in time.

use std::fs;
use std::path::Path;
use std::time::Duration;

use robot_model_fuzz::run::watched;

/// The slowest takes a second without optimization on a slow machine; a minute is no answer.
const LIMIT: Duration = Duration::from_mins(1);

#[test]
fn every_text_of_the_corpus_has_an_answer() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let mut count = 0;
    for entry in fs::read_dir(folder).expect("the corpus is in the repository") {
        let path = entry.expect("a readable folder").path();
        let text = fs::read_to_string(&path).expect("a readable spec");
        if let Err(failure) = watched(&text, LIMIT) {
            panic!("{}: {failure}", path.display());
        }
        count += 1;
    }
    assert!(count > 0, "the corpus is empty");
}
