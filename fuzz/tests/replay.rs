//! What the fuzzer has found, again: every file of `corpus` has an answer, in time and within bounded memory.

use std::alloc::System;
use std::fs;
use std::path::Path;
use std::time::Duration;

use cap::Cap;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use robot_model_fuzz::kind::Kind;
use robot_model_fuzz::run::watched;

/// What is asked for beyond this is not given, which ends the test.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, 6 << 30);

/// The slowest takes a second without optimization on a slow machine; a minute is no answer.
const LIMIT: Duration = Duration::from_mins(1);

/// Kinds that are read by libraries; what the program alone reads is replayed by its tests.
const KINDS: [Kind; 5] = [Kind::Spec, Kind::Csv, Kind::Parquet, Kind::Mcap, Kind::Urdf];

#[test]
fn every_file_of_the_corpus_has_an_answer() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let mut counts = [0; KINDS.len()];
    for entry in fs::read_dir(folder).expect("the corpus is in the repository") {
        let path = entry.expect("a readable folder").path();
        let kind = Kind::of(&path).expect("a file of some kind");
        let Some(place) = KINDS.iter().position(|known| *known == kind) else {
            assert_eq!(kind, Kind::Json, "{}", path.display());
            continue;
        };
        let file = fs::read(&path).expect("a readable file");
        if let Err(failure) = watched(kind, &file, LIMIT) {
            panic!("{}: {failure}", path.display());
        }
        counts[place] += 1;
    }
    assert!(counts[0] > 0, "the corpus has no specs: {counts:?}");
}

/// Sound files are read as such, and their damaged copies have an answer: a little of what the fuzzer does for hours.
#[test]
fn damaged_files_have_an_answer() {
    for kind in KINDS.into_iter().filter(|kind| *kind != Kind::Spec) {
        let seeds = kind.seeds();
        for (k, file) in seeds.iter().enumerate() {
            let answer = watched(kind, file, LIMIT).map(|(answer, _)| answer);
            let is_read = matches!(answer, Ok(robot_model_fuzz::answer::Answer::Read { .. }));
            assert!(is_read, "{kind:?} {k}: {answer:?}");
        }
        let mut dice = ChaCha8Rng::seed_from_u64(5);
        for (k, file) in seeds.iter().cycle().enumerate().take(400) {
            let damaged = kind.mutate(file, &seeds[0], &mut dice);
            if let Err(failure) = watched(kind, &damaged, LIMIT) {
                panic!("{kind:?} {k}: {failure}");
            }
        }
    }
}
